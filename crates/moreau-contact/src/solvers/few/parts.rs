//! What every algorithm for a few contacts needs: how many they are, the certificate's residual, and an answer.

use crate::certificate::Judge;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::solvers::DIRECT_CONTACTS;
use nalgebra::DVector;
use std::cell::RefCell;

/// Most contacts.
pub(super) const MOST: usize = DIRECT_CONTACTS;

thread_local! {
    /// Prepared anew for every problem; only its memory is used again, which is that of a few contacts.
    static JUDGE: RefCell<Judge> = RefCell::default();
}

/// The largest relative residual of the certificate; infinite where it is not a number.
pub(super) fn relative(problem: &ContactProblem, solution: &Solution) -> f64 {
    JUDGE.with_borrow_mut(|judge| {
        let judged = judge.judge(problem, solution).map_or(f64::INFINITY, |judged| judged.relative());
        if judged.is_nan() { f64::INFINITY } else { judged }
    })
}

/// The answer of these impulses.
pub(super) fn answer(problem: &ContactProblem, name: &str, impulse: DVector<f64>, iterations: usize) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new(name, impulse, velocity, iterations)
}
