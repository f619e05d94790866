//! All solutions of a problem in the plane, pattern by pattern, in fractions.
//!
//! ```text
//!     open       r = 0 ,  y_n = a                                                  a ≥ 0
//!     sticking   y = 0 ,  r_n = (p + m)/(2μ) ,  r_t = (p − m)/2                    p, m ≥ 0
//!     sliding    y_n = 0 ,  y_t = ± s ,  r_n = p ,  r_t = ∓ μ p                    p, s ≥ 0
//!     pressing   y_n = 0 ,  r_n = p ,  r_t = 0        (μ = 0 or normal rows alone)  p ≥ 0
//! ```
//! Every solution has one of the 4^k patterns, and each pattern is a linear system for non-negative numbers. A regular one has one solution
//! or none; of a singular one the simplex method finds a vertex, and whether anything moves from there without leaving the pattern. So the
//! list is complete: *no* solution, *exactly k* velocities, or a continuum, between two ends of which every mean is a solution.

use super::feasibility::nonnegative_solution;
use super::in_fractions::Data;
use super::moving::moving;
use super::true_operator::operator;
use crate::problem::{ContactProblem, Law};
use crate::tolerance::proof::PATTERN_CONTACTS;
use dashu_ratio::RBig;
use moreau_exact::elimination::solve;
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A solution in fractions.
#[derive(Clone, Debug, PartialEq)]
pub struct Exact {
    /// r \[N·s\].
    pub impulse: DVector<Rational>,
    /// u = W r + u_free \[m/s\].
    pub velocity: DVector<Rational>,
}

/// Every solution there is.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions {
    /// One solution of every velocity that is met at a vertex of a pattern, in the order of patterns.
    pub found: Vec<Exact>,
    /// The ends of a continuum of velocities; every mean of both impulses is a solution. None if `found` are all velocities.
    pub continuum: Option<[Exact; 2]>,
    /// How many patterns were decided: all there are.
    pub patterns: usize,
}

/// All solutions of a problem with Coulomb's law in the plane, or without friction.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`PATTERN_CONTACTS`] contacts, contacts in space, other laws and compliant contacts.
/// ```
/// use moreau_contact::ContactProblem;
/// use moreau_contact::certificate::patterns::solutions;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
///
/// let rod = |free: [f64; 2]| {
///     // a normal impulse pushes it along twice as much as away: it slides, is jammed, or lifts off
///     let w = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
///     ContactProblem::new(w, dvector![free[0], free[1]]).rows_per_contact(2).friction(vec![1.0]).build()
/// };
/// assert_eq!(solutions(&rod([1.0, 4.0])?)?.found.len(), 3); // Painlevé: open, sliding and sticking all solve it
/// assert_eq!(solutions(&rod([-1.0, 1.0])?)?.found.len(), 1);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn solutions(problem: &ContactProblem) -> Result<Solutions> {
    let d = problem.rows_per_contact();
    let planar = d == 1 || (d == 2 && problem.law() == Law::Coulomb) || problem.law() == Law::Frictionless;
    let cones = matches!(problem.law(), Law::Frictionless | Law::Coulomb);
    if !planar || !cones || problem.compliance().is_some() || problem.contacts() > PATTERN_CONTACTS {
        let text = format!("all patterns are tried with hard contacts in the plane, {PATTERN_CONTACTS} at most");
        return Err(Error::Unsupported(text));
    }
    let w = operator(problem)?;
    let data = Data::new(problem, w);
    let mut solutions = Solutions { found: Vec::new(), continuum: None, patterns: 0 };
    let kinds: Vec<&[Kind]> = (0..problem.contacts()).map(|k| data.kinds(k)).collect();
    let mut digits = vec![0; kinds.len()];
    loop {
        let pattern: Vec<Kind> = digits.iter().zip(&kinds).map(|(digit, kinds)| kinds[*digit]).collect();
        solutions.patterns += 1;
        data.decide(&pattern, &mut solutions);
        let Some(next) = (0..digits.len()).find(|k| digits[*k] + 1 < kinds[*k].len()) else { break };
        digits[..next].fill(0);
        digits[next] += 1;
    }
    Ok(solutions)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Open,
    Pressing,
    Sticking,
    Sliding(i64),
}

impl Data {
    fn kinds(&self, k: usize) -> &'static [Kind] {
        if self.friction[k].is_zero() {
            &[Kind::Open, Kind::Pressing]
        } else {
            &[Kind::Open, Kind::Sticking, Kind::Sliding(1), Kind::Sliding(-1)]
        }
    }

    /// The impulses that one unit of each unknown makes.
    fn unknowns(&self, pattern: &[Kind]) -> Vec<DVector<Rational>> {
        let mut made = Vec::new();
        for (k, kind) in pattern.iter().enumerate() {
            let (at, mu) = (k * self.rows, &self.friction[k]);
            let mut add = |normal: Rational, tangential: Rational| {
                let mut r = DVector::from_element(self.free.len(), RBig::ZERO);
                r[at] = normal;
                if self.rows > 1 {
                    r[at + 1] = tangential;
                }
                made.push(r);
            };
            match kind {
                Kind::Open => {}
                Kind::Pressing => add(RBig::ONE, RBig::ZERO),
                Kind::Sticking => [1, -1].into_iter().for_each(|side| add(RBig::ONE / (mu * ratio(2, 1)), ratio(side, 2))),
                Kind::Sliding(side) => add(RBig::ONE, mu * ratio(-*side, 1)),
            }
        }
        made
    }

    /// Rows of y that must vanish, and rows that must not be negative, with a sign.
    fn conditions(&self, pattern: &[Kind]) -> (Vec<usize>, Vec<(usize, i64)>) {
        let (mut zero, mut positive) = (Vec::new(), Vec::new());
        for (k, kind) in pattern.iter().enumerate() {
            let at = k * self.rows;
            match kind {
                Kind::Open => positive.push((at, 1)),
                Kind::Pressing => zero.push(at),
                Kind::Sticking => zero.extend([at, at + 1]),
                Kind::Sliding(side) => {
                    zero.push(at);
                    positive.push((at + 1, *side));
                }
            }
        }
        (zero, positive)
    }

    fn decide(&self, pattern: &[Kind], solutions: &mut Solutions) {
        let (unknowns, (zero, positive)) = (self.unknowns(pattern), self.conditions(pattern));
        let moved: Vec<DVector<Rational>> = unknowns.iter().map(|r| &self.w * r).collect();
        let free = &self.free + &self.shift;
        let matrix = DMatrix::from_fn(zero.len(), unknowns.len(), |i, j| moved[j][zero[i]].clone());
        let right = DVector::from_fn(zero.len(), |i, _| -free[zero[i]].clone());
        let combined = |x: &[Rational], of: &[DVector<Rational>]| {
            x.iter().zip(of).fold(DVector::from_element(self.free.len(), RBig::ZERO), |sum, (x, r)| sum + r * x.clone())
        };
        if let Some(x) = solve(&matrix, &right) {
            let y = &free + combined(x.as_slice(), &moved);
            let holds = x.iter().all(|x| *x >= RBig::ZERO) && positive.iter().all(|(row, sign)| &y[*row] * ratio(*sign, 1) >= RBig::ZERO);
            if holds {
                self.add(combined(x.as_slice(), &unknowns), solutions);
            }
            return;
        }
        // unknowns x ≥ 0 and slacks s ≥ 0: y = 0 at `zero`, ± y − s = 0 at `positive`
        let (n, m) = (unknowns.len(), zero.len() + positive.len());
        let row = |i: usize| if i < zero.len() { (zero[i], 1) } else { positive[i - zero.len()] };
        let system = DMatrix::from_fn(m, n + positive.len(), |i, j| {
            let (at, sign) = row(i);
            match j < n {
                true => &moved[j][at] * ratio(sign, 1),
                false => ratio(-i64::from(i >= zero.len() && i - zero.len() == j - n), 1),
            }
        });
        let right = DVector::from_fn(m, |i, _| &free[row(i).0] * ratio(-row(i).1, 1));
        let Some(vertex) = nonnegative_solution(&system, &right).point() else { return };
        self.add(combined(&vertex.as_slice()[..n], &unknowns), solutions);
        if solutions.continuum.is_some() {
            return;
        }
        let gains = (0..self.free.len()).map(|i| (0..n).map(|j| moved[j][i].clone()).collect());
        let Some(direction) = moving(&system, &vertex, gains) else { return };
        // as far as a non-negative number goes, or one unit
        let limits = vertex.iter().zip(direction.iter()).filter(|(_, d)| **d < RBig::ZERO).map(|(x, d)| x / -d);
        let step = limits.min().unwrap_or(RBig::ONE);
        let end: Vec<Rational> = (0..n).map(|j| &vertex[j] + &direction[j] * &step).collect();
        solutions.continuum = Some([&vertex.as_slice()[..n], &end].map(|x| self.exact(combined(x, &unknowns))));
    }

    fn exact(&self, impulse: DVector<Rational>) -> Exact {
        Exact { velocity: &self.free + &self.w * &impulse, impulse }
    }

    fn add(&self, impulse: DVector<Rational>, solutions: &mut Solutions) {
        let made = self.exact(impulse);
        if solutions.found.iter().all(|known| known.velocity != made.velocity) {
            solutions.found.push(made);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Solution;
    use moreau_exact::scalar::{Scalar, exact};
    use nalgebra::dvector;

    fn planar(w: &[f64], free: &[f64], mu: f64) -> ContactProblem {
        let n = free.len();
        let problem = ContactProblem::new(DMatrix::from_row_slice(n, n, w), DVector::from_row_slice(free));
        problem.rows_per_contact(2).friction(vec![mu; n / 2]).build().unwrap()
    }

    fn assert_solves(problem: &ContactProblem, exact: &Exact) {
        let rounded = |of: &DVector<Rational>| of.map(|x| Scalar::to_f64(&x));
        let answer = Solution::new("", rounded(&exact.impulse), rounded(&exact.velocity), 0);
        assert!(residuals(problem, &answer).unwrap().is_solution(1e-12), "{exact:?}");
    }

    #[test]
    fn painleve_s_rod_has_none_one_or_three_solutions() {
        let w = [1.0, 2.0, 2.0, 5.0];
        for (free, count) in [([-1.0, 1.0], 1), ([1.0, 4.0], 3), ([1.0, 1.0], 1), ([-1.0, -3.0], 1)] {
            let problem = planar(&w, &free, 1.0);
            let all = solutions(&problem).unwrap();
            assert_eq!((all.found.len(), all.patterns, &all.continuum), (count, 4, &None), "{free:?}: {all:?}");
            all.found.iter().for_each(|one| assert_solves(&problem, one));
        }
        // a W that is not semidefinite leaves none: sliding pushes in, sticking would pull
        let none = solutions(&planar(&[-1.0, 0.0, 0.0, 1.0], &[-1.0, 0.0], 0.5)).unwrap();
        assert!(none.found.is_empty() && none.continuum.is_none());
    }

    #[test]
    fn impulses_of_a_jammed_body_differ_and_its_velocity_does_not() {
        // between two walls that stand still: any equal pair of impulses
        let rows = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 1.0]];
        let w = DMatrix::from_fn(4, 4, |i, j| rows[i][0] * rows[j][0] + rows[i][1] * rows[j][1]);
        let problem = planar(w.transpose().as_slice(), &[0.0, 0.0, 0.0, 0.0], 0.5);
        let all = solutions(&problem).unwrap();
        assert_eq!((all.found.len(), all.patterns, all.continuum), (1, 16, None));
        // moving along the walls it may be held by any part of what would stop it, and is found to slide at all speeds between
        let sliding = planar(w.transpose().as_slice(), &[0.0, 2.0, 0.0, 2.0], 0.5);
        let all = solutions(&sliding).unwrap();
        let [one, other] = all.continuum.clone().expect("jammed as hard as one likes");
        assert_ne!(one.velocity, other.velocity);
        for part in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let mean = &one.impulse * (RBig::ONE - &part) + &other.impulse * part;
            let velocity = sliding.free_velocity().map(exact) + w.map(exact) * &mean;
            assert_solves(&sliding, &Exact { impulse: mean, velocity });
        }
    }

    #[test]
    fn other_laws_space_and_large_problems_are_refused() {
        let space = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.0, 0.0]).friction(vec![0.5]).build().unwrap();
        let cone = planar(&[1.0, 0.0, 0.0, 1.0], &[-1.0, 0.0], 0.5).into_builder().law(Law::Associated).build().unwrap();
        let many = planar(DMatrix::<f64>::identity(14, 14).as_slice(), &[-1.0; 14], 0.5);
        assert!([space, cone, many].iter().all(|problem| solutions(problem).is_err()));
    }
}
