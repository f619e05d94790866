//! Fischer and Burmeister's equations, whose path passes by many patterns that others get caught in, and Newton for the last digits.

use super::super::{ContactSolver, FischerBurmeister, NonsmoothNewton};
use crate::problem::{ContactProblem, Solution};
use moreau_exact::Result;
use nalgebra::DVector;

/// The answer from these impulses, or from zero; it stops at this relative residual.
///
/// # Errors
/// As of these solvers.
pub(super) fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    ended_by(NonsmoothNewton { tolerance: stop, ..Default::default() }, problem, start, stop)
}

/// [`solve`] from zero, with one start of Newton's method: where it does not end it, others follow.
///
/// # Errors
/// As of these solvers.
pub(super) fn briefly(problem: &ContactProblem, stop: f64) -> Result<Solution> {
    ended_by(NonsmoothNewton { tolerance: stop, starts: 1, ..Default::default() }, problem, None, stop)
}

fn ended_by(newton: NonsmoothNewton, problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let begun = FischerBurmeister { tolerance: stop, ..Default::default() }.solve(problem, start)?;
    let ended = newton.solve(problem, Some(&begun.impulse))?;
    Ok(Solution { iterations: begun.iterations + ended.iterations, ..ended })
}
