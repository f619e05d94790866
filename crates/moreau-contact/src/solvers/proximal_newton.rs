//! Proximal points: a sequence of softer problems, each solved by Newton's method, whose limit solves the hard one:
//!
//! ```text
//!     r_k+1  solves the problem with   y = (W + R + α/ρ) r + q − (α/ρ) r_k          in place of   y = (W + R) r + q
//! ```
//! Where r_k+1 = r_k the two are one. The softer problem moves around r_k like a spring: contacts share what is redundant, no impulse
//! runs away along the null space of W, and Newton's method ends it in a few steps where α is large. The smaller α is the fewer points are
//! needed. So α falls to a quarter where Newton's steps were few, and is four times as large where they did not end; the point then stays
//! where it is. Where W ⪰ 0 and the law is convex the points converge for every α; for Coulomb's law nothing is promised, and the best
//! point by the certificate's residual is returned. Where the points creep they leap ([`creep`](super::creep)).
//!
//! # Source
//! Rockafellar, *Monotone operators and the proximal point algorithm*, SIAM J. Control Optim. 14 (1976); Acary, Brémond and Huber, *On
//! solving contact problems with Coulomb friction: formulations and numerical comparisons*, in *Advanced Topics in Nonsmooth Dynamics*
//! (2018).

use super::creep::Creep;
use super::nonsmooth_newton::NonsmoothNewton;
use super::stopping::Stopping;
use super::{ContactSolver, watch};
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::newton as tolerance;
use crate::tolerance::solvers::STOP;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Proximal points around Newton's method for every law, compliance on edges excepted; W may be asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximalNewton {
    /// Limit of Newton's steps around all points together.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
    /// α of the first point.
    pub softness: f64,
    /// Points in a row that do not halve the certificate's residual after which it ends.
    pub patience: usize,
}

impl Default for ProximalNewton {
    fn default() -> Self {
        ProximalNewton {
            steps: tolerance::PROXIMAL_STEPS,
            tolerance: STOP,
            softness: tolerance::FIRST_PROXIMAL,
            patience: tolerance::PROXIMAL_PATIENCE,
        }
    }
}

const NAME: &str = "proximal-newton";

impl ContactSolver for ProximalNewton {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if !NonsmoothNewton::fits(problem) {
            return Err(Error::refused(NAME, "does not solve a compliance on edges, of which the impulse is not a function"));
        }
        let mut centre = super::start_of_use(problem, warm_start)?;
        let (weights, mut softer, mut systems) = (Judge::weights(problem), problem.clone(), NonsmoothNewton::systems(problem));
        let (mut stopping, mut judge) = (Stopping::new(problem, self.tolerance), Judge::default());
        let mut relative = stopping.relative(&centre, &problem.law_velocity(&centre));
        let mut best = (relative, centre.clone());
        let mut creep = Creep::default();
        let (mut alpha, mut steps, mut mark, mut since) = (self.softness, 0, f64::INFINITY, 0);
        while best.0 > self.tolerance && steps < self.steps && since <= self.patience && !watch::is_over() {
            soften_around(&mut softer, problem, weights, alpha, &centre);
            let left = (tolerance::PART_LEFT * relative).min(tolerance::LARGEST_LEFT).max(tolerance::PART_LEFT * self.tolerance);
            let most = tolerance::STEPS_AROUND.min(self.steps - steps);
            let newton = NonsmoothNewton { steps: most, starts: 1, tolerance: left, ..Default::default() };
            let around = watch::unnoted(|| newton.solve_with(&softer, Some(&centre), systems.as_mut()))?;
            // a point that needs no step is the end of what this α moves
            steps += around.iterations.max(1);
            let has_ended = judge.look(&softer, &around)?.relative() <= left;
            let moved = stopping.relative(&around.impulse, &problem.law_velocity(&around.impulse));
            if moved < best.0 {
                best = (moved, around.impulse.clone());
            }
            since += 1;
            if best.0 < 0.5 * mark {
                (mark, since) = (best.0, 0);
            }
            let had_leapt = creep.has_leapt();
            if has_ended {
                centre = creep.next(problem, &centre, around.impulse, moved <= 0.5 * relative);
                relative = moved;
            } else if let Some(left) = creep.take_back() {
                centre = left;
            } else if moved < relative {
                (relative, centre) = (moved, around.impulse);
            }
            if !had_leapt && !creep.has_leapt() {
                alpha = softness_after(alpha, has_ended, around.iterations);
            }
            if alpha > tolerance::MOST_PROXIMAL {
                break;
            }
        }
        let velocity = problem.velocity(&best.1);
        super::finite(Solution::new(NAME, best.1, velocity, steps))
    }
}

/// α of the next point: less where Newton's steps were few, more where they did not end.
fn softness_after(alpha: f64, has_ended: bool, steps: usize) -> f64 {
    if !has_ended {
        alpha * tolerance::PROXIMAL_CHANGES
    } else if steps <= tolerance::FEW_STEPS_AROUND {
        (alpha / tolerance::PROXIMAL_CHANGES).max(tolerance::LEAST_PROXIMAL)
    } else {
        alpha
    }
}

/// Makes `softer` the problem with W + R + α/ρ and q − (α/ρ) r_k.
fn soften_around(softer: &mut ContactProblem, problem: &ContactProblem, weights: &[[f64; 2]], alpha: f64, centre: &DVector<f64>) {
    let rows = problem.rows_per_contact();
    let added = DVector::from_fn(problem.rows(), |row, _| alpha / weights[row / rows][usize::from(!row.is_multiple_of(rows))]);
    let softness = DVector::from_fn(problem.rows(), |row, _| problem.row_compliance(row) + added[row]);
    softer.soften(softness, problem.shift() - added.component_mul(centre));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::{Compliance, Coordinates};
    use crate::solvers::test_problems::{by_blocks, four_corners, of_a_point, point};
    use crate::solvers::{AlternatingDirections, LemkePivoting};
    use crate::tolerance::certificate::CERTIFY;
    use crate::tolerance::solvers::ENOUGH;
    use nalgebra::{DMatrix, dvector};

    fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>) -> Solution {
        let solution = ProximalNewton::default().solve(problem, start).unwrap();
        let found = residuals(problem, &solution).unwrap();
        assert!(found.is_solution(ENOUGH), "{} {:?}: {found:?}", problem.name(), problem.law());
        solution
    }

    #[test]
    fn a_point_opens_sticks_and_slides_as_the_closed_forms_say() {
        for law in [Law::Coulomb, Law::Associated] {
            for (free, impulse) in of_a_point(law) {
                let solution = solve(&point(law, 0.5, free.clone()), None);
                assert!((&solution.impulse - &impulse).amax() <= ENOUGH, "{law:?} {free:?}: {}", solution.impulse);
            }
        }
    }

    #[test]
    fn redundant_contacts_end_where_other_algorithms_end_cold_and_warm() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralAssociated { directions: 4 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let (cold, blocks) = (solve(&problem, None), solve(&by_blocks(&problem), None));
                let other = match law {
                    // its velocity need not be unique
                    Law::Coulomb => None,
                    Law::PolyhedralAssociated { .. } => Some(LemkePivoting.solve(&problem, None).unwrap()),
                    _ => Some(AlternatingDirections::default().solve(&problem, None).unwrap()),
                };
                for answer in [&cold, &blocks] {
                    let differs = other.as_ref().is_some_and(|other| (&other.velocity - &answer.velocity).amax() > CERTIFY);
                    assert!(!differs, "{law:?} {sideways} {turning}");
                }
                assert_eq!(solve(&problem, Some(&cold.impulse)).iterations, 0, "{law:?} {sideways} {turning}");
            }
        }
    }

    #[test]
    fn the_softer_problem_has_the_same_solution_around_it_and_another_one_around_another_point() {
        for law in [Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 6 }] {
            let problem = four_corners(law, 0.5, 1.0);
            let (solution, weights) = (solve(&problem, None), Judge::weights(&problem));
            let mut softer = problem.clone();
            let mut holds = |centre: &DVector<f64>| {
                soften_around(&mut softer, &problem, weights, 0.5, centre);
                residuals(&softer, &solution).unwrap().is_solution(CERTIFY)
            };
            assert!(holds(&solution.impulse), "{law:?}");
            // what is planted: a spring around nothing, and around twice the solution
            assert!(!holds(&DVector::zeros(12)) && !holds(&(&solution.impulse * 2.0)), "{law:?}");
        }
    }

    #[test]
    fn a_compliance_is_kept_and_an_asymmetric_w_is_taken_as_it_is() {
        let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(12, 0.25) };
        let problem = four_corners(Law::Associated, 2.0, 1.0).into_builder().compliance(soft).build().unwrap();
        let other = AlternatingDirections::default().solve(&problem, None).unwrap();
        assert!((solve(&problem, None).impulse - other.impulse).amax() <= CERTIFY);
        // r_n = 1, and friction opposes a slip of 2 m/s that W_tn r_n makes 1.5 m/s: r_t = −½, u_t = 1.5 − ½
        let w = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, -0.5, 1.0]);
        let skew = ContactProblem::new(w, dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        assert!((solve(&skew, None).velocity - dvector![0.0, 1.0]).amax() <= ENOUGH);
    }

    #[test]
    fn compliance_on_edges_is_refused_by_name() {
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(16, 1.0) };
        let hard = four_corners(Law::PolyhedralAssociated { directions: 4 }, 0.1, 0.0);
        let problem = hard.into_builder().compliance(compliance).build().unwrap();
        let refused = ProximalNewton::default().solve(&problem, None).unwrap_err().to_string();
        assert!(refused.contains(NAME) && refused.contains("compliance on edges"), "{refused}");
    }

    #[test]
    fn a_limit_of_steps_is_kept_and_a_tolerance_asked_for_ends_it_sooner() {
        let problem = four_corners(Law::Coulomb, 0.5, 1.0);
        let steps = |solver: &dyn ContactSolver| solver.solve(&problem, None).unwrap().iterations;
        let whole = steps(&ProximalNewton::default());
        assert_eq!(steps(&ProximalNewton { steps: 2, ..Default::default() }), 2);
        assert!(steps(&*ProximalNewton::default().with_tolerance(0.1).unwrap()) < whole);
    }
}
