//! Coulomb's law as a fixed point of convex problems, by de Saxcé's correction:
//!
//! ```text
//!     r(s) = argmin { ½ rᵀA r + (q + Σ s_k n_k)ᵀr : r ∈ K } ,   y(s) = A r(s) + q ,   F(s)_k = μ_k ‖y_t(s)_k‖ ,   s = F(s)
//!     s ← s + θ (F(s) − s)
//! ```
//! with A = W + R, q = u_free + shift. Each subproblem has the associated law and is solved from the last impulses, by Newton's method or,
//! where that does not end, by interior points and Newton's method from there. A fixed point is a solution of Coulomb's problem.
//!
//! **Safeguards.** θ = 1 is de Saxcé's iteration, a contraction for small friction only. Where F(s) − s grows, or turns round and hardly
//! falls, θ is halved; where it falls without turning round it is doubled again, to at most 1. Where s cycles for every θ the iteration
//! ends with the best iterate by the certificate's residual; no fixed point is promised, and none need exist.
//!
//! # Source
//! De Saxcé and Feng, *The bipotential method* (1998); Acary, Cadoux, Lemaréchal and Malick, *A formulation of the linear discrete Coulomb
//! friction problem via convex optimization*, ZAMM 91 (2011).

use super::stopping::Stopping;
use super::{ContactSolver, InteriorPoint, NonsmoothNewton};
use crate::certificate::Judge;
use crate::cones::second_order::tangential_norm;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::problem::LARGEST;
use crate::tolerance::{first_order, solvers as tolerance};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// De Saxcé's fixed point for Coulomb's law; W may be asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConvexSubproblems {
    /// Most convex problems.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
}

impl Default for ConvexSubproblems {
    fn default() -> Self {
        ConvexSubproblems { steps: first_order::SUBPROBLEMS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "convex-subproblems";

impl ContactSolver for ConvexSubproblems {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law == Law::Coulomb
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.law() != Law::Coulomb {
            let reason = format!("is for Coulomb's law, and this one is `{}`", problem.law().name());
            return Err(Error::refused(NAME, reason));
        }
        let mut impulse = super::start_of_use(problem, warm_start)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut lift = lift_of(problem, &problem.law_velocity(&impulse));
        if !lift.iter().all(|lift| *lift <= LARGEST) {
            // a start at which no number holds the slip tells nothing
            impulse.fill(0.0);
            lift = lift_of(problem, &problem.law_velocity(&impulse));
        }
        let mut convex = problem.clone();
        let (mut best, mut theta, mut done) = ((f64::INFINITY, impulse.clone()), 1.0_f64, 0);
        let mut before: Option<DVector<f64>> = None;
        loop {
            let velocity = problem.law_velocity(&impulse);
            let relative = stopping.relative(&impulse, &velocity);
            if relative < best.0 {
                best = (relative, impulse.clone());
            }
            if relative <= self.tolerance || done == self.steps || super::watch::is_over() {
                break;
            }
            if done > 0 {
                let change = lift_of(problem, &velocity) - &lift;
                theta = (theta * before.as_ref().map_or(1.0, |before| longer(before, &change))).clamp(first_order::LEAST_SHARE, 1.0);
                lift += &change * theta;
                before = Some(change);
            }
            (convex, impulse) = super::watch::unnoted(|| subproblem(problem, convex, &lift, &impulse))?;
            done += 1;
        }
        let velocity = problem.velocity(&best.1);
        super::finite(Solution::new(NAME, best.1, velocity, done))
    }
}

/// By how much the next step should be longer than the last: half where F(s) − s grew, or swings to the other side and hardly falls; twice
/// where it falls without a swing.
fn longer(before: &DVector<f64>, change: &DVector<f64>) -> f64 {
    let (was, is, swings) = (before.norm(), change.norm(), before.dot(change) < 0.0);
    if is >= was || swings && is > first_order::SWINGS * was {
        0.5
    } else if swings {
        1.0
    } else {
        2.0
    }
}

/// μ‖y_t‖ of every contact \[m/s\].
fn lift_of(problem: &ContactProblem, law_velocity: &DVector<f64>) -> DVector<f64> {
    let contacts = law_velocity.as_slice().chunks_exact(problem.rows_per_contact());
    DVector::from_iterator(problem.contacts(), contacts.zip(problem.friction()).map(|(y, mu)| mu * tangential_norm(y)))
}

/// The associated problem with this lift, and its impulses.
fn subproblem(
    problem: &ContactProblem,
    convex: ContactProblem,
    lift: &DVector<f64>,
    start: &DVector<f64>,
) -> Result<(ContactProblem, DVector<f64>)> {
    let mut shift = problem.shift().clone();
    lift.iter().enumerate().for_each(|(k, s)| shift[k * problem.rows_per_contact()] += s);
    let convex = convex.into_builder().law(Law::Associated).shift(shift).build()?;
    let newton = NonsmoothNewton { starts: 1, ..Default::default() };
    let near = newton.solve(&convex, Some(start))?;
    let mut judge = Judge::default();
    let reached = judge.look(&convex, &near)?.relative();
    if reached <= tolerance::ACCEPTABLE {
        return Ok((convex, near.impulse));
    }
    let inner = InteriorPoint::default().solve(&convex, None)?;
    let ended = newton.solve(&convex, Some(&inner.impulse))?;
    let better = judge.look(&convex, &ended)?.relative() < reached;
    Ok((convex, if better { ended.impulse } else { near.impulse }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use nalgebra::DMatrix;

    fn block(friction: f64) -> ContactProblem {
        ContactProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![-0.8, 0.6]))
            .name("block")
            .rows_per_contact(2)
            .friction(vec![friction])
            .build()
            .unwrap()
    }

    #[test]
    fn one_sliding_block_slides_as_coulomb_says() {
        // r = 0.8 (1, −½), u = (0, 0.2)
        let answer = ConvexSubproblems::default().solve(&block(0.5), None).unwrap();
        assert!((answer.velocity - DVector::from_vec(vec![0.0, 0.2])).amax() <= 8.0 * tolerance::STOP);
    }

    #[test]
    fn a_fixed_point_that_repels_the_plain_iteration_is_found_with_shorter_steps() {
        // W couples normal and tangent: dF/ds = −μ w_tt μ …; the plain iteration of this block swings between two lifts
        let w = DMatrix::from_row_slice(2, 2, &[1.0, -0.7, -0.7, 1.0]);
        let problem = block(1.2).into_builder().delassus(w).free_velocity(DVector::from_vec(vec![-0.2, 1.0])).build().unwrap();
        let answer = ConvexSubproblems::default().solve(&problem, None).unwrap();
        assert!(residuals(&problem, &answer).unwrap().is_solution(tolerance::ENOUGH));
    }

    #[test]
    fn a_swing_that_falls_by_a_last_bit_only_is_a_swing() {
        // W = H Hᵀ of one row twice: F turns s round by as much, and rounding decides whether a swing is smaller than the one before
        let w = DMatrix::from_row_slice(2, 2, &[0.36, -0.48, -0.48, 0.64]);
        let problem = block(0.5).into_builder().delassus(w).free_velocity(DVector::from_vec(vec![-1.16, 1.0])).build().unwrap();
        let answer = ConvexSubproblems::default().solve(&problem, None).unwrap();
        assert!(residuals(&problem, &answer).unwrap().is_solution(tolerance::ENOUGH), "{}", answer.iterations);
        let after = |change: f64| longer(&DVector::from_element(1, 1.0), &DVector::from_element(1, change));
        assert_eq!([1.0, -1.0 + f64::EPSILON, -0.5, 1.0 - f64::EPSILON].map(after), [0.5, 0.5, 1.0, 2.0]);
    }

    #[test]
    fn other_laws_are_refused_by_name() {
        let problem = block(0.5).into_builder().law(Law::Associated).build().unwrap();
        let message = ConvexSubproblems::default().solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains("`convex-subproblems`") && message.contains("`associated`"), "{message}");
    }
}
