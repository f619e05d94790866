//! What every algorithm for a few contacts needs: how many they are, the certificate's residual, and an answer.

use crate::memory::spare;
use crate::problem::{ContactProblem, Solution};
use crate::solvers::workspace;
use crate::tolerance::solvers::DIRECT_CONTACTS;
use nalgebra::DVector;

/// Most contacts.
pub(super) const MOST: usize = DIRECT_CONTACTS;

/// The largest relative residual of the certificate; infinite where it is not a number.
pub(super) fn relative(problem: &ContactProblem, solution: &Solution) -> f64 {
    let judged = workspace::borrow(problem).judge.look(problem, solution).map_or(f64::INFINITY, |judged| judged.relative());
    if judged.is_nan() { f64::INFINITY } else { judged }
}

/// The answer of these impulses.
pub(super) fn answer(problem: &ContactProblem, name: &str, impulse: DVector<f64>, iterations: usize) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new(spare::text(name), impulse, velocity, iterations)
}
