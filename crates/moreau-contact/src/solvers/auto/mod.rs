//! The default solver, which tries several algorithms in turn.

mod stages;

use super::ContactSolver;
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::solvers::{ACCEPTABLE, ENOUGH, STOP};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use stages::{QUICK, THOROUGH, left_out};

/// The default choice: one algorithm after another, in a fixed order, until the certificate's residuals are below [`ENOUGH`], after the
/// first of nonsmooth Newton below [`ACCEPTABLE`]; otherwise the best answer seen.
///
/// | for | algorithm |
/// |---|---|
/// | soft contacts | Newton on Gauss's principle |
/// | all but a compliance on edges | a few accelerated sweeps, and nonsmooth Newton from what they found, until [`ENOUGH`] |
/// | W stored by blocks, first | a few steps of Newton; with round cones interior points, and Newton from there; Newton from zero |
/// | the same without the polyhedral associated law in space | more accelerated sweeps, and Newton |
/// | all but a compliance on edges | Newton from zero; Newton on contacts that are soft at first and then harder and harder |
/// | second-order cones | plain sweeps, and Newton from what they found |
/// | second-order cones and a symmetric W | a few steps of the alternating directions, and Newton |
/// | one row, the plane, polyhedral laws, no friction; not too many contacts | Lemke |
/// | second-order cones, not too many contacts | Lemke with an octagon, then a pentagon, in place of the disk, and Newton |
/// | second-order cones and a symmetric W | many steps of the alternating directions, and Newton |
/// | second-order cones | over-relaxation |
/// | polyhedral Coulomb in space | plain sweeps |
/// | the associated law | accelerated projected gradient, Clarabel |
/// | one row, the plane, polyhedral laws, no friction; up to ten times as many contacts as before | Lemke |
/// | one row, few contacts | complementary cones, in whole numbers: a solution, or the proof that there is none |
///
/// Each starts from the best answer of those before. The order and the numbers of iterations are fixed, so that the same problem has the
/// same answer on every machine; no clock is asked. The answer names the algorithm it came from, with the iterations of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Auto;

/// [`Auto`] for another accuracy: its algorithms stop, and its chain ends, where the largest relative residual of the certificate is at
/// most this.
///
/// A pile of ten thousand contacts is solved to 1e-6 in a fraction of the time that the last digits take:
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
/// use moreau_contact::solvers::AutoWithin;
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let answer = AutoWithin { tolerance: 1e-6 }.solve(&block, None)?;
/// assert!(residuals(&block, &answer)?.is_solution(1e-6));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AutoWithin {
    /// The largest relative residual that is asked for.
    pub tolerance: f64,
}

/// The relative residuals at which the algorithms stop, the quick ones are enough, and the expensive ones are not tried.
#[derive(Clone, Copy)]
struct Goal {
    stop: f64,
    enough: f64,
    acceptable: f64,
}

const NAME: &str = "auto";

impl ContactSolver for Auto {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        // below STOP the rounding of y begins
        Some(Box::new(AutoWithin { tolerance: relative.max(STOP) }))
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        chain(problem, warm_start, Goal { stop: STOP, enough: ENOUGH, acceptable: ACCEPTABLE })
    }
}

impl ContactSolver for AutoWithin {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        // below STOP the rounding of y begins
        Some(Box::new(AutoWithin { tolerance: relative.max(STOP) }))
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let goal = self.tolerance;
        chain(problem, warm_start, Goal { stop: goal, enough: goal, acceptable: goal })
    }
}

fn is_infeasible(error: &Error) -> bool {
    matches!(error, Error::Solver { failure: Failure::Infeasible, .. })
}

/// One algorithm after another until the goal is reached, and the best answer of all.
fn chain(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Result<Solution> {
    super::start(problem, warm_start)?;
    let (mut judge, mut iterations) = (Judge::default(), 0);
    let mut best: Option<(f64, Solution)> = None;
    let mut failure = None;
    let stages = QUICK.iter().map(|stage| (stage, goal.enough)).chain(THOROUGH.iter().map(|stage| (stage, goal.acceptable)));
    for ((takes, stage), enough) in stages {
        if best.as_ref().is_some_and(|(least, _)| *least <= enough || super::watch::is_over()) {
            break;
        }
        if !takes(problem) {
            continue;
        }
        let start = best.as_ref().map(|(_, solution)| &solution.impulse).or(warm_start);
        let solution = match stage(problem, start, goal.stop) {
            Ok(solution) => solution,
            // that there is no solution is proved; what was found before is one to the tolerance of the certificate, or none
            Err(error) if is_infeasible(&error) && best.as_ref().is_none_or(|(least, _)| *least > CERTIFY) => return Err(error),
            Err(error) => {
                failure = failure.or(Some(error));
                continue;
            }
        };
        iterations += solution.iterations;
        let relative = judge.judge(problem, &solution)?.relative();
        let better = !relative.is_nan() && best.as_ref().is_none_or(|(least, _)| relative < *least);
        if better {
            best = Some((relative, solution));
        }
    }
    match (best, failure) {
        (Some((relative, solution)), _) => {
            let untried = if relative <= goal.acceptable { "" } else { left_out(problem) };
            Ok(Solution { iterations, solver: solution.solver + untried, ..solution })
        }
        (None, Some(Error::Solver { solver, failure, reason })) => {
            // one of several algorithms may refuse a problem; the chain takes them all, so that it breaks down
            let failure = if failure == Failure::Refused { Failure::Breakdown } else { failure };
            Err(Error::solver(solver, failure, reason + left_out(problem)))
        }
        (None, Some(error)) => Err(error),
        (None, None) => {
            let reason = "no algorithm gave an answer made of numbers; rescale the units of the problem";
            Err(Error::breakdown(NAME, format!("{reason}{}", left_out(problem))))
        }
    }
}
