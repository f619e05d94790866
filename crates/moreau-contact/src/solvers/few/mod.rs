//! A few contacts, answered on the stack: no memory is asked for but that of candidates, and nothing is prepared that the data do not ask
//! for.
//!
//! ```text
//!     no friction    Newton-min, then Lemke's path, over a support: M_αα z_α = −q_α                  (`normals`, `path`)
//!     Coulomb        a few sweeps, then Newton's method on the contacts that press                   (`friction`, `newton`)
//! ```
//! What is returned meets the certificate's residual; where nothing does, nothing is returned, and the longer chain begins from the same
//! start, its answer without these iterations. Numbers of iterations are fixed, so that they are what the problem makes them.

mod contacts;
mod elimination;
mod friction;
mod newton;
mod normals;
mod parts;
mod path;
mod rows;

use crate::problem::{ContactProblem, Law, Solution};
use nalgebra::DVector;
use parts::MOST;

/// An answer with a relative residual of at most `stop`, or one of at most `enough` where the iteration ends; `None` where this is no
/// problem of a few contacts with a W that is stored, or nothing here solves it.
pub(super) fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64, enough: f64) -> Option<Solution> {
    let is_few = (1..=MOST).contains(&problem.contacts()) && problem.delassus().matrix_free().is_none();
    if !is_few || !super::NonsmoothNewton::fits(problem) {
        return None;
    }
    match (problem.law(), problem.rows_per_contact()) {
        _ if problem.is_frictionless() => normals::solve(problem, start, enough),
        (Law::Coulomb, 2) => friction::solve::<2>(problem, start, stop, enough),
        (Law::Coulomb, 3) => friction::solve::<3>(problem, start, stop, enough),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
