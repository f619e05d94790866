//! A segment of solutions with different velocities, between two ends in fractions.
//!
//! ```text
//!     r^i in the law with y^j  for i, j = 1, 2  at every contact
//!     ⟹      r = (1 − s) r¹ + s r² ,  y = (1 − s) y¹ + s y²  solve the problem for all s in [0, 1]
//! ```
//! K is convex; y_n stays ≥ 0, and r_n y_n is a sum of products that all vanish. Where a contact has friction at one end, its slips at both
//! ends are against it or zero, so that they have one direction d, and both ends have r_t = −μ r_n d unless neither slips: hence every mean
//! has. None of it takes a root: r_t is against y_t where their cross product vanishes, r_t·y_t ≤ 0 and ‖r_t‖² = μ² r_n².
//!
//! Ends are looked for with the directions of an answer, which must be rational, d = (1 − t², 2t)/(1 + t²) with a small fraction t: the
//! contacts that touch then are a polyhedron of impulses, as in [`patterns`](super::patterns), sticking ones in eight generators
//! of their cone. Where slip has another direction, or turns along a continuum, no end of it is a fraction, and nothing is said.

use super::feasibility::nonnegative_solution;
use super::in_fractions::Data;
use super::moving::moving;
use super::patterns::Exact;
use super::planted::{Plant, planted};
use super::true_operator::operator;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::proof::{DIRECTION, LARGEST_DENOMINATOR, SEGMENT_ROWS};
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Eight directions of rational length, five times unit vectors.
const EIGHT: [[i64; 2]; 8] = [[5, 0], [4, 3], [0, 5], [-3, 4], [-5, 0], [-4, -3], [0, -5], [3, -4]];

/// What a contact does on a segment.
#[derive(PartialEq)]
enum Doing {
    Open,
    Pressing,
    Sticking,
    /// Along this direction, or not at all.
    Sliding(Vec<Rational>),
}

/// Two solutions with different velocities between which every mean of both impulses is a solution, whose contacts do what they do at one
/// of these answers; none if none is found.
///
/// # Errors
/// [`Error::Unsupported`] for other laws than Coulomb's, compliant contacts, and more than [`SEGMENT_ROWS`] rows.
/// ```
/// use moreau_contact::certificate::segment::segment;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Solution};
///
/// // a body that slides along (3, 4) between two walls, which may hold it as hard as one likes
/// let h = DMatrix::from_row_slice(6, 3, &[1., 0., 0., 0., 1., 0., 0., 0., 1., -1., 0., 0., 0., 1., 0., 0., 0., 1.]);
/// let walls = ContactProblem::new(&h * h.transpose(), dvector![0., 3., 4., 0., 3., 4.]).friction(vec![0.5; 2]).build()?;
/// let free = Solution::new("by hand", dvector![0., 0., 0., 0., 0., 0.], walls.free_velocity().clone(), 0);
/// let [one, other] = segment(&walls, &[free])?.expect("a continuum");
/// assert_ne!(one.velocity, other.velocity);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn segment(problem: &ContactProblem, answers: &[Solution]) -> Result<Option<[Exact; 2]>> {
    let is_coulomb = matches!(problem.law(), Law::Coulomb | Law::Frictionless);
    if !is_coulomb || problem.compliance().is_some() || problem.rows() > SEGMENT_ROWS {
        let text = format!("a segment of solutions is looked for under Coulomb's law with hard contacts, of {SEGMENT_ROWS} rows at most");
        return Err(Error::Unsupported(text));
    }
    let data = Data::new(problem, operator(problem)?);
    let mut looked_at: Vec<Vec<Doing>> = Vec::new();
    for doings in answers.iter().filter_map(|answer| data.doings(problem, answer)) {
        // where every contact sticks no velocity of one is left to move
        let may_move = doings.iter().any(|doing| *doing != Doing::Sticking) && !looked_at.contains(&doings);
        if let Some(ends) = may_move.then(|| data.ends(&doings)).flatten().filter(|ends| data.is_segment(ends)) {
            return Ok(Some(ends));
        }
        looked_at.push(doings);
    }
    Ok(None)
}

impl Data {
    /// What the contacts of an answer may do; none if one slides in a direction that is no small fraction.
    fn doings(&self, problem: &ContactProblem, answer: &Solution) -> Option<Vec<Doing>> {
        let y = problem.law_velocity(&answer.impulse);
        let small = DIRECTION * y.amax().max(problem.free_velocity().amax());
        let doing = |(mu, y): (&Rational, &[f64])| {
            let slip = y[1..].iter().fold(0.0_f64, |sum, y| sum.hypot(*y));
            match () {
                () if y[0] > small => Some(Doing::Open),
                () if mu.is_zero() => Some(Doing::Pressing),
                () if slip <= small => Some(Doing::Sticking),
                () => rational_direction(&y[1..]).map(Doing::Sliding),
            }
        };
        self.friction.iter().zip(y.as_slice().chunks_exact(self.rows)).map(doing).collect()
    }

    /// The impulses of contact k that its unknowns x ≥ 0 make, one unit each.
    fn generators(&self, k: usize, doing: &Doing) -> Vec<Vec<Rational>> {
        let mu = &self.friction[k];
        let along = |d: &[Rational], sign: i64| [Rational::ONE].into_iter().chain(d.iter().map(|d| mu * d * ratio(sign, 1))).collect();
        match doing {
            Doing::Open => Vec::new(),
            Doing::Pressing => vec![(0..self.rows).map(|i| ratio(i64::from(i == 0), 1)).collect()],
            Doing::Sliding(d) => vec![along(d, -1)],
            Doing::Sticking if self.rows == 2 => [1, -1].iter().map(|side| along(&[Rational::ONE], *side)).collect(),
            Doing::Sticking => EIGHT.iter().map(|d| along(&d.map(|d| ratio(d, 5)), 1)).collect(),
        }
    }

    /// Σ c_i y_i of contact k that vanish, and those that must not be negative.
    fn rows_held(&self, doing: &Doing) -> [Vec<Vec<Rational>>; 2] {
        let unit = |i: usize| (0..self.rows).map(|j| ratio(i64::from(i == j), 1)).collect();
        let tangential = |d: &[Rational]| [Rational::ZERO].into_iter().chain(d.iter().cloned()).collect();
        match doing {
            Doing::Open => [vec![], vec![unit(0)]],
            Doing::Pressing => [vec![unit(0)], vec![]],
            Doing::Sticking => [(0..self.rows).map(unit).collect(), vec![]],
            Doing::Sliding(d) => match d.as_slice() {
                [first, second] => [vec![unit(0), tangential(&[-second.clone(), first.clone()])], vec![tangential(d)]],
                _ => [vec![unit(0)], vec![tangential(d)]],
            },
        }
    }

    /// A vertex of the impulses of these doings, and the last point in a direction from there in which velocities move.
    fn ends(&self, doings: &[Doing]) -> Option<[Exact; 2]> {
        let size = self.free.len();
        let mut unknowns: Vec<DVector<Rational>> = Vec::new();
        let (mut zero, mut positive) = (Vec::new(), Vec::new());
        for (k, doing) in doings.iter().enumerate() {
            let whole = |part: Vec<Rational>| {
                let mut all = DVector::from_element(size, Rational::ZERO);
                part.into_iter().enumerate().for_each(|(i, x)| all[k * self.rows + i] = x);
                all
            };
            unknowns.extend(self.generators(k, doing).into_iter().map(whole));
            let [vanish, stay] = self.rows_held(doing);
            zero.extend(vanish.into_iter().map(whole));
            positive.extend(stay.into_iter().map(whole));
        }
        let (n, free) = (unknowns.len(), &self.free + &self.shift);
        let moved: Vec<DVector<Rational>> = unknowns.iter().map(|r| &self.w * r).collect();
        let slacks = zero.len();
        let conditions: Vec<DVector<Rational>> = zero.into_iter().chain(positive).collect();
        // unknowns x ≥ 0 and slacks s ≥ 0: y = 0, or y − s = 0
        let system = DMatrix::from_fn(conditions.len(), n + conditions.len() - slacks, |i, j| match j < n {
            true => conditions[i].dot(&moved[j]),
            false => ratio(-i64::from(i >= slacks && i - slacks == j - n), 1),
        });
        let right = DVector::from_fn(conditions.len(), |i, _| -conditions[i].dot(&free));
        let vertex = nonnegative_solution(&system, &right).point()?;
        let direction = moving(&system, &vertex, (0..size).map(|i| (0..n).map(|j| moved[j][i].clone()).collect()))?;
        // as far as a non-negative number goes, or one unit
        let limits = vertex.iter().zip(direction.iter()).filter(|(_, d)| **d < Rational::ZERO).map(|(x, d)| x / -d);
        let step = limits.min().unwrap_or(Rational::ONE);
        let made = |x: &DVector<Rational>| {
            let none = DVector::from_element(size, Rational::ZERO);
            let impulse = unknowns.iter().zip(x.iter()).fold(none, |sum, (r, x)| sum + r * x.clone());
            Exact { velocity: &self.free + &self.w * &impulse, impulse }
        };
        Some([made(&vertex), made(&(&vertex + direction * step))])
    }

    /// Whether these are two solutions with different velocities, and every mean of them is one.
    fn is_segment(&self, ends: &[Exact; 2]) -> bool {
        let of = |all: &DVector<Rational>, k: usize| all.rows(k * self.rows, self.rows).iter().cloned().collect::<Vec<_>>();
        let is_posed = ends.iter().all(|end| end.velocity == &self.free + &self.w * &end.impulse);
        let holds = |k: usize| {
            let [r, y] = [ends.each_ref().map(|end| of(&end.impulse, k)), ends.each_ref().map(|end| of(&(&end.velocity + &self.shift), k))];
            let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)];
            pairs.iter().filter(|(i, j)| i == j || !planted(Plant::Alone)).all(|(i, j)| self.obeys(k, &r[*i], &y[*j]))
        };
        is_posed && ends[0].velocity != ends[1].velocity && (0..self.friction.len()).all(holds)
    }

    /// Whether r and y of contact k are in the law.
    fn obeys(&self, k: usize, r: &[Rational], y: &[Rational]) -> bool {
        let square = |x: &[Rational]| x.iter().fold(Rational::ZERO, |sum, x| sum + x * x);
        let (friction, bound) = (square(&r[1..]), square(&[&self.friction[k] * &r[0]]));
        let normal = r[0] >= Rational::ZERO && y[0] >= Rational::ZERO && (&r[0] * &y[0]).is_zero();
        let against = || friction == bound && is_against(&r[1..], &y[1..]);
        normal && friction <= bound && (y[1..].iter().all(Rational::is_zero) || against())
    }
}

/// Whether one vector of the tangential plane points against the other, or one is zero.
fn is_against(one: &[Rational], other: &[Rational]) -> bool {
    let dot = one.iter().zip(other).fold(Rational::ZERO, |sum, (a, b)| sum + a * b);
    let is_straight = one.len() < 2 || (&one[0] * &other[1]) == (&one[1] * &other[0]);
    is_straight && dot <= Rational::ZERO
}

/// The direction of a vector of one or two components, if it is that of a small fraction.
fn rational_direction(y: &[f64]) -> Option<Vec<Rational>> {
    let [first, second] = match *y {
        [one] => return Some(vec![ratio(if one > 0.0 { 1 } else { -1 }, 1)]),
        [first, second] => [first, second],
        _ => return None,
    };
    // half of the angle to the nearer of ±e₁
    let side: i64 = if first < 0.0 { -1 } else { 1 };
    let t = second * side as f64 / (first.abs() + first.hypot(second));
    let near = |q: &i64| ((t * *q as f64).round() - t * *q as f64).abs() <= DIRECTION * *q as f64;
    let q = (1..=LARGEST_DENOMINATOR).find(near)?;
    let p = (t * q as f64).round() as i64;
    let size = p * p + q * q;
    Some(vec![ratio(side * (q * q - p * p), size), ratio(side * 2 * p * q, size)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::planted::with;
    use crate::certificate::residuals;
    use moreau_exact::scalar::{Scalar, exact};
    use nalgebra::dvector;

    /// A body of 1 kg between two walls that stand still, μ = ½, sliding along them.
    fn walls(free: [f64; 2]) -> ContactProblem {
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let h = DMatrix::from_row_iterator(6, 3, rows.into_iter().flatten());
        let free = dvector![0.0, free[0], free[1], 0.0, free[0], free[1]];
        ContactProblem::new(&h * h.transpose(), free).friction(vec![0.5; 2]).build().unwrap()
    }

    fn free_of(problem: &ContactProblem) -> Solution {
        Solution::new("", DVector::zeros(problem.rows()), problem.free_velocity().clone(), 0)
    }

    #[test]
    fn a_body_between_walls_slides_at_all_speeds_between_two_ends() {
        for (free, shares) in [([3.0, 4.0], [3, 4]), ([-4.0, 3.0], [-4, 3]), ([0.0, -5.0], [0, -5]), ([-5.0, 0.0], [-5, 0])] {
            let problem = walls(free);
            let [one, other] = segment(&problem, &[free_of(&problem)]).unwrap().expect("a continuum");
            // v = (5 − p) d with p of 0 to 5
            let mut speeds: Vec<Rational> =
                [&one, &other].map(|end| (0..2).fold(Rational::ZERO, |sum, i| sum + &end.velocity[1 + i] * ratio(shares[i], 5))).to_vec();
            speeds.sort();
            assert_eq!(speeds, [ratio(0, 1), ratio(5, 1)], "{free:?}");
            for part in [ratio(0, 1), ratio(1, 3), ratio(7, 8), ratio(1, 1)] {
                let impulse = &one.impulse * (Rational::ONE - &part) + &other.impulse * part;
                let rounded = impulse.map(|x| Scalar::to_f64(&x));
                let answer = Solution::new("", rounded.clone(), problem.velocity(&rounded), 0);
                assert!(residuals(&problem, &answer).unwrap().is_solution(1e-12), "{free:?}");
            }
        }
    }

    #[test]
    fn where_velocities_are_unique_or_slip_is_no_fraction_nothing_is_said() {
        let still = walls([0.0, 0.0]);
        assert_eq!(segment(&still, &[free_of(&still)]).unwrap(), None);
        let askew = walls([1.0, 2.0]);
        assert_eq!(segment(&askew, &[free_of(&askew)]).unwrap(), None);
        let soft = still.into_builder().law(Law::Associated).build().unwrap();
        assert!(segment(&soft, &[free_of(&soft)]).is_err());
    }

    /// Pairs of solutions between which means are none, that are taken for segments.
    fn believed() -> usize {
        // of Painlevé's rod, which lifts off or is jammed
        let w = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 2.0, 5.0, 0.0, 0.0, 0.0, 1.0]);
        let rod = ContactProblem::new(w, dvector![1.0, 4.0, 0.0]).friction(vec![1.0]).build().unwrap();
        let of = |problem: &ContactProblem, impulses: [DVector<f64>; 2]| {
            let data = Data::new(problem, operator(problem).unwrap());
            let ends = impulses.map(|r| r.map(exact)).map(|r| Exact { velocity: &data.free + &data.w * &r, impulse: r });
            assert!(ends.iter().all(|end| data.obeys(0, end.impulse.as_slice(), end.velocity.as_slice())));
            usize::from(data.is_segment(&ends))
        };
        let jammed = dvector![3.0, -2.0, 0.0];
        of(&rod, [dvector![0.0, 0.0, 0.0], jammed.clone()]) + of(&rod, [dvector![1.0, -1.0, 0.0], jammed])
    }

    #[test]
    fn solutions_between_which_there_is_none_are_no_ends_of_a_segment() {
        assert_eq!(with(None, believed), 0);
        assert_eq!(with(Some(Plant::Alone), believed), 2);
    }

    #[test]
    fn a_direction_is_a_fraction_of_length_one_or_none() {
        for (y, expected) in [([3.0, 4.0], Some([3, 4])), ([-0.6, 0.8], Some([-3, 4])), ([0.0, -2.0], Some([0, -5])), ([1.0, 2.0], None)] {
            let expected = expected.map(|d: [i64; 2]| d.map(|d| ratio(d, 5)).to_vec());
            assert_eq!(rational_direction(&y), expected, "{y:?}");
        }
        assert_eq!(rational_direction(&[-2.0]), Some(vec![ratio(-1, 1)]));
    }
}
