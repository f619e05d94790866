//! A few contacts, answered on the stack: no memory is asked for but that of the answer, and nothing is prepared that the data do not ask for.
//!
//! ```text
//!     frictionless   Newton-min, then Lemke's path, over a support: M_αα z_α = −q_α                  (`normals`, `path`)
//!     Coulomb        a few sweeps, then Newton's method on the contacts that press                   (`friction`, `newton`)
//! ```
//! What is returned meets the certificate's residual; where nothing does, nothing is returned, and the longer chain begins as if nothing had
//! been tried. Numbers of iterations are fixed, so that they are what the problem makes them.

mod friction;
mod newton;
mod normals;
mod path;

use crate::certificate::Judge;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers::DIRECT_CONTACTS;
use nalgebra::DVector;
use std::cell::RefCell;

/// Most contacts.
const MOST: usize = DIRECT_CONTACTS;

thread_local! {
    /// Prepared anew for every problem; only its memory is used again, which is that of a few contacts.
    static JUDGE: RefCell<Judge> = RefCell::default();
}

/// An answer with a relative residual of at most `stop`, or one of at most `enough` where the iteration ends; `None` where this is no
/// problem of a few contacts with a W that is stored, or nothing here solves it.
pub(super) fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64, enough: f64) -> Option<Solution> {
    let is_few = (1..=MOST).contains(&problem.contacts()) && problem.delassus().matrix_free().is_none();
    if !is_few || !super::NonsmoothNewton::fits(problem) {
        return None;
    }
    match (problem.law(), problem.rows_per_contact()) {
        (Law::Frictionless, _) => normals::solve(problem, start, enough),
        (Law::Coulomb, 2) => friction::solve::<2>(problem, start, stop, enough),
        (Law::Coulomb, 3) => friction::solve::<3>(problem, start, stop, enough),
        _ => None,
    }
}

/// The largest relative residual of the certificate; infinite where it is not a number.
fn relative(problem: &ContactProblem, solution: &Solution) -> f64 {
    JUDGE.with_borrow_mut(|judge| {
        let judged = judge.judge(problem, solution).map_or(f64::INFINITY, |judged| judged.relative());
        if judged.is_nan() { f64::INFINITY } else { judged }
    })
}

/// The answer of these impulses.
fn answer(problem: &ContactProblem, name: &str, impulse: DVector<f64>, iterations: usize) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new(name, impulse, velocity, iterations)
}

#[cfg(test)]
mod tests;
