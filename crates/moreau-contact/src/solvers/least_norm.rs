//! The impulses of least norm among those that give the velocity of a solution r*.
//!
//! ```text
//!     min ½‖r‖²   over   A r = A r* ,  r_k ∈ C_k ,      A = W + R                                         [N²·s²]
//!     C_k = {0} where contact k opens ,   the ray of (1, −μ y_t/‖y_t‖) where it slides ,   K_μ where it sticks or only touches
//!     r = P_C(Aᵀλ) ,      (A J Aᵀ + ε) d = A r* − A P_C(Aᵀλ) ,   J ∈ ∂P_C ,   λ ← λ + s d ,  s = 1, ½, …
//! ```
//! y is that of r*, and so every r of this set is a solution: contacts that stick or touch take any impulse of their cones, and the set is
//! convex, so that its point of least norm is unique. How a table's load is shared among its legs, and how hard two fingers press, is
//! chosen so. The dual function A r*·λ − ½‖P_C(Aᵀλ)‖² is concave, and Newton's steps go up along it.

use super::watch;
use crate::certificate::Judge;
use crate::cones::projection_jacobian;
use crate::cones::second_order::{project, tangential_norm};
use crate::memory;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::least_norm as tolerance;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

const NAME: &str = "least-norm";

/// The impulses that a contact may have at the velocity of the solution.
enum Allowed {
    Nothing,
    Ray(DVector<f64>),
    Cone(f64),
}

/// The solution with the velocity of this one and the impulses of least norm.
///
/// # Errors
/// [`Error::Solver`] if the given answer is none to the certificate, or the one of least norm is not found to it;
/// [`Error::Unsupported`] under polyhedral laws.
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
/// use moreau_contact::solvers::least_norm;
///
/// // two fingers hold 1 kg that falls at 1 m/s, μ = ½; any harder grip would hold it as well
/// let w = DMatrix::from_row_slice(4, 4, &[1.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
/// let held = ContactProblem::new(w, dvector![0.0, -1.0, 0.0, -1.0]).rows_per_contact(2).friction(vec![0.5; 2]).build()?;
/// let hard = Solution::new("by hand", dvector![5.0, 0.5, 5.0, 0.5], dvector![0.0, 0.0, 0.0, 0.0], 0);
/// let soft = least_norm(&held, &hard)?;
/// assert!((soft.impulse - dvector![1.0, 0.5, 1.0, 0.5]).amax() < 1e-9);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn least_norm(problem: &ContactProblem, solution: &Solution) -> Result<Solution> {
    if problem.law().directions().is_some() {
        return Err(Error::Unsupported(format!("impulses of least norm are not chosen under the law `{}`", problem.law().name())));
    }
    let mut judge = Judge::default();
    if judge.look(problem, solution)?.relative() > CERTIFY {
        return Err(Error::breakdown(NAME, "begins from an answer that is no solution; give a better one"));
    }
    let n = problem.rows();
    memory::require(format_args!("impulses of least norm of {}", counted(n, "row")), memory::matrix(n, n).saturating_mul(3))?;
    let mut a = problem.dense().clone();
    (0..n).for_each(|row| a[(row, row)] += problem.row_compliance(row));
    let allowed = allowed(problem, &solution.impulse);
    let (impulse, steps) = dual_newton(&a, &(&a * &solution.impulse), &allowed, problem.rows_per_contact());
    let velocity = problem.velocity(&impulse);
    let found = Solution { impulse, velocity, iterations: solution.iterations + steps, beta: None, sigma: None, ..solution.clone() };
    if judge.look(problem, &found)?.relative() > CERTIFY {
        let reason = if watch::is_over() {
            "was ended before it had one with this velocity"
        } else {
            "found none with this velocity: rows are too nearly dependent, or the answer is too rough; use a smaller `--tolerance`"
        };
        return Err(Error::breakdown(NAME, reason));
    }
    Ok(found)
}

/// C_k of every contact.
fn allowed(problem: &ContactProblem, impulse: &DVector<f64>) -> Vec<Allowed> {
    let (rows, y) = (problem.rows_per_contact(), problem.law_velocity(impulse));
    let fastest = (problem.free_velocity() + problem.shift()).amax();
    let moves = |speed: f64| speed > CERTIFY * fastest;
    let contact = |k: usize| {
        let (y, mu) = (&y.as_slice()[k * rows..(k + 1) * rows], problem.law().cone_friction(problem.friction()[k]));
        let slip = tangential_norm(y);
        let lift = if problem.law() == Law::Associated { mu * slip } else { 0.0 };
        if moves(y[0] - lift) {
            return Allowed::Nothing;
        }
        if mu > 0.0 && !moves(slip) {
            return Allowed::Cone(mu);
        }
        Allowed::Ray(DVector::from_fn(rows, |row, _| {
            if row == 0 {
                1.0
            } else if mu > 0.0 {
                -mu * y[row] / slip
            } else {
                0.0
            }
        }))
    };
    (0..problem.contacts()).map(contact).collect()
}

impl Allowed {
    /// P_C(z) in place, and J.
    fn project(&self, z: &mut [f64]) -> DMatrix<f64> {
        let rows = z.len();
        match self {
            Allowed::Nothing => {
                z.fill(0.0);
                DMatrix::zeros(rows, rows)
            }
            Allowed::Ray(ray) => {
                let along = ray.iter().zip(z.iter()).map(|(d, z)| d * z).sum::<f64>() / ray.norm_squared();
                z.iter_mut().zip(ray).for_each(|(z, d)| *z = along.max(0.0) * d);
                if along > 0.0 { ray * ray.transpose() / ray.norm_squared() } else { DMatrix::zeros(rows, rows) }
            }
            Allowed::Cone(mu) => {
                let slope = projection_jacobian(z, *mu);
                project(z, *mu);
                slope
            }
        }
    }
}

/// P_C(Aᵀλ), and A J.
fn projected(a: &DMatrix<f64>, lambda: &DVector<f64>, allowed: &[Allowed], rows: usize) -> (DVector<f64>, DMatrix<f64>) {
    let mut r = a.tr_mul(lambda);
    let mut sloped = DMatrix::zeros(a.nrows(), a.ncols());
    for (k, one) in allowed.iter().enumerate() {
        let slope = one.project(&mut r.as_mut_slice()[k * rows..(k + 1) * rows]);
        sloped.columns_mut(k * rows, rows).copy_from(&(a.columns(k * rows, rows) * slope));
    }
    (r, sloped)
}

/// The impulses of the best multiplier, and how many steps were made.
fn dual_newton(a: &DMatrix<f64>, target: &DVector<f64>, allowed: &[Allowed], rows: usize) -> (DVector<f64>, usize) {
    let softness = tolerance::SOFTNESS * a.norm_squared().max(f64::MIN_POSITIVE);
    let soft = |mut matrix: DMatrix<f64>| {
        (0..matrix.nrows()).for_each(|row| matrix[(row, row)] += softness);
        matrix.cholesky()
    };
    if watch::is_over() {
        return (DVector::zeros(a.nrows()), 0);
    }
    let Some(start) = soft(a * a.transpose()) else { return (DVector::zeros(a.nrows()), 0) };
    let mut lambda = start.solve(target);
    let dual = |lambda: &DVector<f64>, r: &DVector<f64>| target.dot(lambda) - 0.5 * r.norm_squared();
    let (mut r, mut sloped) = projected(a, &lambda, allowed, rows);
    let mut best = (f64::INFINITY, r.clone());
    for step in 0..tolerance::STEPS {
        let rest = target - a * &r;
        if rest.norm() < best.0 {
            best = (rest.norm(), r.clone());
        }
        if rest.norm() <= tolerance::ENDED * target.norm() {
            return (best.1, step);
        }
        if watch::is_over() {
            return (best.1, step);
        }
        let Some(factor) = soft(&sloped * a.transpose()) else { return (best.1, step) };
        let (direction, value) = (factor.solve(&rest), dual(&lambda, &r));
        let (gain, mut length) = (rest.dot(&direction), 1.0);
        while !watch::is_over() {
            let next = &lambda + &direction * length;
            let (next_r, next_sloped) = projected(a, &next, allowed, rows);
            if dual(&next, &next_r) >= value + tolerance::SHARE * length * gain || length < tolerance::SHORTEST {
                (lambda, r, sloped) = (next, next_r, next_sloped);
                break;
            }
            length *= 0.5;
        }
    }
    (best.1, tolerance::STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::solvers::{Auto, ContactSolver};
    use nalgebra::dvector;

    /// Legs of a table of 1 kg and unit moments of inertia at these places, loaded off its middle.
    fn table(places: &[[f64; 2]], law: Law, mu: f64) -> ContactProblem {
        let n = places.len();
        let jacobian = DMatrix::from_fn(3 * n, 6, |row, column| {
            let [x, y] = places[row / 3];
            // rows n = z, t₁ = x, t₂ = y of the point (x, y, −½) of a body with v and ω
            let of = match row % 3 {
                0 => [0.0, 0.0, 1.0, y, -x, 0.0],
                1 => [1.0, 0.0, 0.0, 0.0, -0.5, -y],
                _ => [0.0, 1.0, 0.0, 0.5, 0.0, x],
            };
            of[column]
        });
        let w = &jacobian * jacobian.transpose();
        let free = &jacobian * DVector::from_row_slice(&[0.02, 0.0, -1.0, 0.1, -0.2, 0.0]);
        ContactProblem::new(w, free).law(law).friction(vec![mu; n]).build().unwrap()
    }

    const SQUARE: [[f64; 2]; 6] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0], [0.5, 0.0], [-0.25, 0.25]];

    /// The least norm over all supports of pressing legs, each by a pseudo-inverse.
    fn over_supports(problem: &ContactProblem, target: &DVector<f64>) -> f64 {
        let n = problem.contacts();
        let normal = DMatrix::from_fn(n, n, |i, j| problem.entry(3 * i, 3 * j));
        let target = DVector::from_fn(n, |k, _| target[3 * k]);
        let mut least = f64::INFINITY;
        for support in 1_u32..1 << n {
            let columns: Vec<usize> = (0..n).filter(|k| support >> k & 1 == 1).collect();
            let part = normal.select_columns(&columns);
            let r = part.clone().pseudo_inverse(1e-10).unwrap() * &target;
            if (&part * &r - &target).amax() <= 1e-10 && r.iter().all(|r| *r >= 0.0) {
                least = least.min(r.norm());
            }
        }
        least
    }

    #[test]
    fn legs_without_friction_share_a_load_as_the_best_of_all_supports_does() {
        for count in 4..=6 {
            let problem = table(&SQUARE[..count], Law::Frictionless, 0.0);
            let answer = Auto.solve(&problem, None).unwrap();
            let found = least_norm(&problem, &answer).unwrap();
            assert!(residuals(&problem, &found).unwrap().is_solution(CERTIFY));
            let second = over_supports(&problem, &(problem.dense() * &answer.impulse));
            assert!((found.impulse.norm() - second).abs() <= CERTIFY * second, "{count}: {} and {second}", found.impulse.norm());
        }
    }

    #[test]
    fn no_other_impulses_of_the_same_velocity_within_the_cones_are_smaller() {
        for (law, mu) in [(Law::Coulomb, 0.6), (Law::Associated, 0.6), (Law::Coulomb, 0.02)] {
            let problem = table(&SQUARE, law, mu);
            let answer = Auto.solve(&problem, None).unwrap();
            let found = least_norm(&problem, &answer).unwrap();
            assert!((&found.velocity - &answer.velocity).amax() <= CERTIFY);
            // r and r* are both in the convex set: r·(r* − r) ≥ 0 at its point of least norm, and only there for all of the set
            let slack = found.impulse.dot(&(&answer.impulse - &found.impulse));
            assert!(slack >= -CERTIFY * answer.impulse.norm_squared(), "{law:?} {mu}: {slack}");
            if mu > 0.1 {
                // where all stick, the set has no direction of slip in it that rounding could turn
                let back = least_norm(&problem, &found).unwrap();
                assert!((&back.impulse - &found.impulse).amax() <= CERTIFY * found.impulse.amax(), "{law:?}");
            }
        }
    }

    #[test]
    fn what_slides_stays_on_its_ray_and_what_opens_has_nothing() {
        // two contacts at one place that slide, and one that leaves
        let mut w = DMatrix::zeros(6, 6);
        for (i, j) in [(0, 0), (0, 2), (2, 0), (2, 2), (1, 1), (1, 3), (3, 1), (3, 3), (4, 4), (5, 5)] {
            w[(i, j)] = 1.0;
        }
        let problem = ContactProblem::new(w, dvector![-1.0, 2.0, -1.0, 2.0, 1.0, 0.0]).rows_per_contact(2).friction(vec![0.5; 3]);
        let problem = problem.build().unwrap();
        let uneven = dvector![1.0, -0.5, 0.0, 0.0, 0.0, 0.0];
        let answer = Solution::new("by hand", uneven.clone(), problem.velocity(&uneven), 0);
        let found = least_norm(&problem, &answer).unwrap();
        assert!((found.impulse - dvector![0.5, -0.25, 0.5, -0.25, 0.0, 0.0]).amax() <= CERTIFY);
    }

    #[test]
    fn an_answer_that_is_none_and_a_polyhedral_law_are_refused() {
        let problem = table(&SQUARE, Law::Coulomb, 0.6);
        let nothing = Solution::new("by hand", DVector::zeros(18), problem.free_velocity().clone(), 0);
        assert!(least_norm(&problem, &nothing).unwrap_err().to_string().contains("no solution"));
        let octagon = table(&SQUARE, Law::PolyhedralCoulomb { directions: 8 }, 0.6);
        assert!(least_norm(&octagon, &nothing).unwrap_err().to_string().contains("polyhedral-coulomb"));
    }
}
