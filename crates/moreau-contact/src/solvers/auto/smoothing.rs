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
    let begun = FischerBurmeister { tolerance: stop, ..Default::default() }.solve(problem, start)?;
    let ended = NonsmoothNewton { tolerance: stop, ..Default::default() }.solve(problem, Some(&begun.impulse))?;
    Ok(Solution { iterations: begun.iterations + ended.iterations, ..ended })
}
