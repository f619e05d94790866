//! The backward error of an answer, proved: a problem near the given one that an answer near the given one solves *exactly*.
//!
//! ```text
//!     (r′, y′) in the law, in rationals;      y′ = (W + R) r′ + u_free + shift + δ ,      δ_k [m/s] per contact
//! ```
//! r′ and y′ are made of the answer, contact by contact, such that the law holds in rationals, without rounding: an open contact has r′ =
//! 0; a sticking one y′ = 0 and r′ inside of the cone; a sliding one lies on the cone with r_t′ = −μ r_n′ t and y_t′ = s t, t a rational
//! point of the unit circle, ((1 − m²), 2m)/(1 + m²); under a polyhedral law the pair stands on a face of its cone (`polyhedral_pair`). δ
//! then follows exactly from the numbers of the problem. What is returned are its sizes, rounded outward. So the answer r, up to |r′ − r|,
//! solves the problem whose u_free differs by at most δ_k at contact k; whether the problem itself has a solution near r is another
//! question.

use super::planted::{Plant, planted};
use super::polyhedral_pair::{Faceted, Polygon};
use crate::problem::{ByRows, Compliance, ContactProblem, Coordinates, Law};
use moreau_exact::scalar::{Rational, Scalar, exact};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// What was proved of an answer; all bounds are rounded outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Backward {
    /// ‖δ_k‖ per contact, at most \[m/s\].
    pub velocity: Vec<f64>,
    /// ‖r′ − r‖ per contact, at most \[N·s\].
    pub impulse: Vec<f64>,
    /// Whether each contact is open, sticks or slides in the exact solution.
    pub states: Vec<HeldAs>,
}

/// In which way the law holds at a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldAs {
    /// No impulse.
    Open,
    /// An impulse inside of the cone, and no velocity; without friction none along the normal.
    Sticking,
    /// An impulse on the boundary of the cone against the slip.
    Sliding,
    /// A bilateral constraint: any impulse, and no velocity.
    Joined,
}

impl Backward {
    /// The contact with the largest δ, and that δ \[m/s\]; none without contacts.
    pub fn worst(&self) -> Option<(usize, f64)> {
        self.velocity.iter().copied().enumerate().reduce(|best, one| if one.1 > best.1 { one } else { best })
    }

    /// The largest ‖r′ − r‖ \[N·s\].
    pub fn moved(&self) -> f64 {
        self.impulse.iter().copied().fold(0.0, f64::max)
    }
}

/// Proves the backward error of impulses r.
///
/// # Errors
/// [`Error::Unsupported`] where a contact has hard edges beside soft ones, or W r is too large for squares; [`Error::Invalid`] if r has
/// another size or a number that is not finite.
/// ```
/// use moreau_contact::certificate::backward::{HeldAs, backward};
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::ContactProblem;
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let proof = backward(&block, &dvector![1.0, -0.5])?;
/// assert_eq!((proof.states[0], proof.velocity[0], proof.impulse[0]), (HeldAs::Sliding, 0.0, 0.0)); // exact as it stands
/// assert!(backward(&block, &dvector![1.0, 0.5])?.velocity[0] >= 0.5); // friction that pushes along the slip solves nothing near
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn backward(problem: &ContactProblem, impulse: &DVector<f64>) -> Result<Backward> {
    of_rows(problem, impulse, None)
}

/// Why nothing is proved of impulses whose W r, or its square, is no number any more.
pub(super) const TOO_FAST: &str = "the impulses move contacts faster than numbers tell; rescale the units of the problem";

/// The same of a problem whose contacts may stand for bilateral rows.
pub(super) fn of_rows(problem: &ContactProblem, impulse: &DVector<f64>, joints: Option<&ByRows>) -> Result<Backward> {
    if impulse.len() != problem.rows() || impulse.iter().any(|r| !r.is_finite()) {
        return Err(Error::invalid("impulse", format!("is not {} finite numbers", problem.rows()), "give one number per row"));
    }
    let velocity = problem.law_velocity(impulse);
    let largest = f64::MAX.sqrt();
    if !velocity.iter().chain(impulse.iter()).all(|number| number.abs() < largest) {
        return Err(Error::Unsupported(format!("not proved: {TOO_FAST}")));
    }
    let rows = problem.rows_per_contact();
    let polygon = problem.law().directions().map(Polygon::new);
    let contact = |k: usize| {
        let [r, y] = [impulse, &velocity].map(|all| &all.as_slice()[k * rows..(k + 1) * rows]);
        match &polygon {
            _ if joints.is_some_and(|joints| joints.is_joined(k) && !planted(Plant::Joined)) => Ok(Near::joined(r)),
            Some(polygon) => on_faces(problem, polygon, k, r, y),
            None => Ok(near(problem, k, r, y)),
        }
    };
    let near: Vec<Near> = (0..problem.contacts()).map(contact).collect::<Result<_>>()?;
    let given: Vec<Rational> = impulse.iter().map(|r| exact(*r)).collect();
    let obeying: Vec<Rational> = near.iter().flat_map(|near| near.impulse.clone()).collect();
    let moved = moved(problem, if planted(Plant::Moved) { &given } else { &obeying });
    let size = |differences: &[Rational]| outward(squares(differences.iter().cloned()));
    let at = |k: usize| k * rows..(k + 1) * rows;
    Ok(Backward {
        velocity: (0..near.len()).map(|k| size(&differences(&near[k].velocity, &moved[at(k)]))).collect(),
        impulse: (0..near.len()).map(|k| size(&differences(&near[k].impulse, &given[at(k)]))).collect(),
        states: near.iter().map(|near| near.state).collect(),
    })
}

/// r′ and y′ of one contact, and how the law holds.
struct Near {
    impulse: Vec<Rational>,
    velocity: Vec<Rational>,
    state: HeldAs,
}

impl Near {
    /// The impulse of a bilateral row as it is, beside which no row has one, and no velocity.
    fn joined(r: &[f64]) -> Self {
        let impulse = r.iter().enumerate().map(|(i, r)| exact(if i == 0 { *r } else { 0.0 })).collect();
        Near { impulse, velocity: vec![Rational::ZERO; r.len()], state: HeldAs::Joined }
    }
}

fn squares(numbers: impl Iterator<Item = Rational>) -> Rational {
    numbers.fold(Rational::ZERO, |sum, x| sum + x.clone() * x)
}

/// √Σ x², rounded outward; infinite if a number is.
pub(super) fn length(numbers: impl Iterator<Item = f64>) -> f64 {
    let numbers: Vec<f64> = numbers.collect();
    match numbers[..] {
        [one] => one,
        _ if numbers.iter().all(|x| x.is_finite()) => outward(squares(numbers.into_iter().map(exact))),
        _ => f64::INFINITY,
    }
}

fn differences(one: &[Rational], other: &[Rational]) -> Vec<Rational> {
    one.iter().zip(other).map(|(a, b)| a.clone() - b.clone()).collect()
}

/// (W + R) r′ + u_free + shift, exactly.
fn moved(problem: &ContactProblem, impulse: &[Rational]) -> Vec<Rational> {
    let mut moved: Vec<Rational> =
        problem.free_velocity().iter().zip(problem.shift()).map(|(free, shift)| exact(*free) + exact(*shift)).collect();
    for (column, r) in impulse.iter().enumerate().filter(|(_, r)| !r.is_zero()) {
        problem.delassus().for_each_in_column(column, |row, w| moved[row] += exact(w) * r.clone());
        moved[column] += exact(problem.row_compliance(column)) * r.clone();
    }
    moved
}

/// ρ \[kg\] of contact k, rows/tr(W_kk + R_kk), or 1 kg.
fn weight(problem: &ContactProblem, k: usize) -> f64 {
    let rows = problem.rows_per_contact();
    let trace: f64 = (k * rows..(k + 1) * rows).map(|row| problem.entry(row, row) + problem.row_compliance(row)).sum();
    if trace > 0.0 { rows as f64 / trace } else { 1.0 }
}

/// An exact pair near (r, y) under a polyhedral law.
fn on_faces(problem: &ContactProblem, polygon: &Polygon, k: usize, r: &[f64], y: &[f64]) -> Result<Near> {
    let (law, friction) = (problem.law(), problem.friction()[k]);
    let d = law.directions().unwrap_or(0);
    let of_edges = |soft: &'_ Compliance| soft.coordinates == Coordinates::Edge;
    let softness = problem.compliance().filter(|soft| of_edges(soft)).map(|soft| &soft.diagonal.as_slice()[k * d..(k + 1) * d]);
    let softness = softness.filter(|softness| softness.iter().any(|soft| *soft > 0.0));
    let associated = matches!(law, Law::PolyhedralAssociated { .. });
    let contact = Faceted { polygon, associated, friction, rho: weight(problem, k), softness };
    let Some(pair) = contact.near(r, y) else {
        return Err(Error::Unsupported(format!("not proved: contact {k} has edges without compliance beside soft ones")));
    };
    let impulse = contact.impulse(&pair);
    let state = match impulse.iter().all(Rational::is_zero) {
        true => HeldAs::Open,
        false if friction > 0.0 && pair.velocity[1..].iter().any(|y| !y.is_zero()) => HeldAs::Sliding,
        false => HeldAs::Sticking,
    };
    Ok(Near { impulse, velocity: pair.velocity, state })
}

/// An exact pair near (r, y), by the point r_n − ρ y_n that Moreau's decomposition would project.
fn near(problem: &ContactProblem, k: usize, r: &[f64], y: &[f64]) -> Near {
    let (rows, mu) = (r.len(), problem.law().cone_friction(problem.friction()[k]));
    let zeros = || vec![Rational::ZERO; rows];
    let rho = weight(problem, k);
    let slip = y.get(1).copied().unwrap_or(0.0).hypot(y.get(2).copied().unwrap_or(0.0));
    let lift = if problem.law() == Law::Associated { mu * slip } else { 0.0 };
    if r[0] <= rho * (y[0] - lift) || r[0] <= 0.0 {
        return Near { impulse: zeros(), velocity: open_velocity(problem.law(), mu, y), state: HeldAs::Open };
    }
    let mut impulse: Vec<Rational> = r.iter().map(|r| exact(*r)).collect();
    if mu == 0.0 {
        impulse[1..].iter_mut().for_each(|r| *r = Rational::ZERO);
        let mut velocity: Vec<Rational> = y.iter().map(|y| exact(*y)).collect();
        velocity[0] = Rational::ZERO;
        return Near { impulse, velocity, state: HeldAs::Sticking };
    }
    let friction = r[1..].iter().fold(0.0_f64, |sum, r| sum.hypot(*r));
    let pushed: Vec<f64> = (1..rows).map(|i| r[i] - rho * y[i]).collect();
    let wanted = pushed.iter().fold(0.0_f64, |sum, p| sum.hypot(*p));
    if wanted > mu * r[0] && (slip > 0.0 || friction > 0.0) {
        let direction = unit(&pushed);
        let (bound, slip) = (exact(mu) * impulse[0].clone(), exact(slip));
        let mut velocity = zeros();
        for (i, t) in direction.into_iter().enumerate() {
            impulse[1 + i] = bound.clone() * t.clone();
            velocity[1 + i] = -(slip.clone() * t);
        }
        if problem.law() == Law::Associated {
            velocity[0] = exact(mu) * slip;
        }
        return Near { impulse, velocity, state: HeldAs::Sliding };
    }
    // inside of the cone, or a little outside by rounding: the normal impulse is enlarged until it is inside
    let squares: Rational = impulse[1..].iter().map(|r| r.clone() * r.clone()).fold(Rational::ZERO, |a, b| a + b);
    let mut normal = r[0];
    while normal.is_finite() && exact(mu) * exact(mu) * exact(normal) * exact(normal) < squares {
        normal = normal.next_up().max(friction / mu);
    }
    if normal.is_finite() {
        impulse[0] = exact(normal);
    } else {
        impulse[1..].iter_mut().for_each(|r| *r = Rational::ZERO);
    }
    Near { impulse, velocity: zeros(), state: HeldAs::Sticking }
}

/// y′ of an open contact: y, lifted into what the law allows.
fn open_velocity(law: Law, mu: f64, y: &[f64]) -> Vec<Rational> {
    let mut velocity: Vec<Rational> = y.iter().map(|y| exact(*y)).collect();
    let mut normal = y[0].max(0.0);
    if law == Law::Associated {
        let squares: Rational = velocity[1..].iter().map(|v| v.clone() * v.clone()).fold(Rational::ZERO, |a, b| a + b);
        while normal.is_finite() && exact(normal) * exact(normal) < exact(mu) * exact(mu) * squares.clone() {
            normal = normal.next_up().max(mu * y[1..].iter().fold(0.0_f64, |sum, v| sum.hypot(*v)));
        }
    }
    if normal.is_finite() {
        velocity[0] = exact(normal);
    } else {
        velocity = vec![Rational::ZERO; y.len()];
    }
    velocity
}

/// A rational unit vector along one or two numbers that are not all zero.
fn unit(along: &[f64]) -> Vec<Rational> {
    let one = || exact(1.0);
    match *along {
        [x] => vec![exact(x.signum())],
        [x, y] => {
            // the half of the angle from the nearer of the two ends of the axis
            let m = exact(y / (x.abs() + x.hypot(y)));
            let scale = one() + m.clone() * m.clone();
            let first = (one() - m.clone() * m.clone()) / scale.clone();
            vec![if x < 0.0 { -first } else { first }, (m.clone() + m) / scale]
        }
        _ => unreachable!("a contact slides along one or two directions"),
    }
}

/// The least number whose square is not below this one; a little more where the square is too small for a number, infinity where it is
/// too large.
fn outward(square: Rational) -> f64 {
    let rounded = Scalar::to_f64(&square);
    if rounded < f64::MIN_POSITIVE {
        return if square.is_zero() { 0.0 } else { f64::MIN_POSITIVE.sqrt() };
    }
    let mut size = rounded.sqrt();
    while size.is_finite() && exact(size) * exact(size) < square && !planted(Plant::Inward) {
        size = size.next_up();
    }
    size
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::{Auto, ContactSolver};
    use moreau_exact::tolerance::rounding;
    use nalgebra::{DMatrix, dvector};

    fn problem(law: Law, mu: f64, free: DVector<f64>) -> ContactProblem {
        let w = DMatrix::from_row_slice(3, 3, &[2.0, 0.3, 0.1, 0.3, 1.5, 0.2, 0.1, 0.2, 1.0]);
        ContactProblem::new(w, free).law(law).friction(vec![mu]).build().unwrap()
    }

    #[test]
    fn every_state_has_a_proof_of_the_size_of_rounding() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
            for (free, state) in [
                (dvector![-1.0, 0.1, 0.0], HeldAs::Sticking),
                (dvector![-1.0, 2.0, -1.0], HeldAs::Sliding),
                (dvector![-1.0, -2.0, 0.3], HeldAs::Sliding),
                (dvector![3.0, 2.0, -1.0], HeldAs::Open),
            ] {
                let problem = problem(law, 0.5, free.clone());
                let answer = Auto.solve(&problem, None).unwrap();
                let proof = backward(&problem, &answer.impulse).unwrap();
                assert_eq!(proof.states[0], if law == Law::Frictionless && state == HeldAs::Sliding { HeldAs::Sticking } else { state });
                let size = rounding(64, 8.0);
                assert!(proof.velocity[0] <= size && proof.moved() <= size, "{law:?} {free:?} {proof:?}");
            }
        }
    }

    #[test]
    fn a_moved_answer_is_told_by_as_much_as_it_moves() {
        let problem = problem(Law::Coulomb, 0.5, dvector![-1.0, 2.0, -1.0]);
        let answer = Auto.solve(&problem, None).unwrap();
        for distance in [0.25, 1e-3, 1e-9] {
            for axis in 0..3 {
                let mut moved = answer.impulse.clone();
                moved[axis] += distance;
                let proof = backward(&problem, &moved).unwrap();
                // the exact answer is unique: r′ is at most ‖W⁻¹‖(1 + …)δ away from it, and W has no eigenvalue below ½
                assert!(proof.moved() + 8.0 * proof.velocity[0] >= distance / 8.0, "{axis} {distance} {proof:?}");
            }
        }
    }

    #[test]
    fn the_unit_vectors_are_exact_and_near() {
        for along in [[3.0, 4.0], [-1.0, 1e-9], [-0.3, -0.7], [0.0, -2.0], [5.0, 0.0], [-1e-300, 1e-300]] {
            let t = unit(&along);
            assert_eq!(t[0].clone() * t[0].clone() + t[1].clone() * t[1].clone(), exact(1.0));
            let size = along[0].hypot(along[1]);
            assert!((0..2).all(|i| (Scalar::to_f64(&t[i]) - along[i] / size).abs() <= rounding(8, 1.0)), "{along:?}");
        }
        assert_eq!(unit(&[-2.0]), vec![exact(-1.0)]);
    }

    #[test]
    fn bounds_are_rounded_outward() {
        let third = exact(1.0) / exact(9.0);
        let bound = outward(third.clone());
        assert!(exact(bound) * exact(bound) >= third && exact(bound.next_down()) * exact(bound.next_down()) < third);
        assert_eq!(outward(Rational::ZERO), 0.0);
        let tiny = exact(f64::MIN_POSITIVE) * exact(f64::MIN_POSITIVE);
        assert!(exact(outward(tiny.clone())) * exact(outward(tiny.clone())) >= tiny);
        assert_eq!(outward(exact(f64::MAX) * exact(f64::MAX) * exact(4.0)), f64::INFINITY);
    }

    #[test]
    fn extreme_coefficients_are_survived() {
        for law in [Law::Coulomb, Law::Associated] {
            for mu in [f64::from_bits(1), f64::MIN_POSITIVE, 1.0 / f64::MIN_POSITIVE] {
                let problem = problem(law, mu, dvector![-1.0, 2.0, -1.0]);
                for impulse in [dvector![1.0, 5.0, 0.0], dvector![0.5, -2.0, 1.0], dvector![0.0, 0.0, 0.0]] {
                    let proof = backward(&problem, &impulse).unwrap();
                    assert!(proof.velocity[0] >= 0.0, "{law:?} {mu} {proof:?}");
                }
            }
        }
    }

    #[test]
    fn wrong_sizes_are_refused() {
        let round = problem(Law::Coulomb, 0.5, dvector![-1.0, 0.0, 0.0]);
        assert!(backward(&round, &dvector![0.5]).is_err() && backward(&round, &dvector![f64::NAN, 0.0, 0.0]).is_err());
    }
}
