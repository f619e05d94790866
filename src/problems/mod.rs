//! The collection of contact problems with certified answers, `references/problems/`, as the program embeds it.
//!
//! ```text
//!     problem   contact-problem/1        u = W r + u_free ,   y = u + shift + R r ,   (r, y) in the law
//!     record    answered-problem/1       impulses r, residuals, δ, radius, uniqueness, difficulty
//! ```
//! A problem that is too large to be stored has its record all the same, with the command that makes it and its hash.

mod stored;
mod table;
pub mod work;

pub use moreau_contact::answered::*;
pub use stored::Stored;

use crate::problem::{ContactProblem, Solution};
use crate::{Error, Result};
use nalgebra::DVector;

/// Every problem, in order.
pub static ALL: &[Stored] = table::STORED;

/// The problem of this name.
///
/// # Errors
/// [`Error::Unsupported`] if there is none.
/// ```
/// use moreau::certificate::residuals;
///
/// let stored = moreau::problems::named("single-slide")?;
/// let (problem, record) = (stored.problem()?, stored.record()?);
/// let answer = moreau::problems::solution(&problem, &record, &record.answers[0]);
/// assert!(residuals(&problem, &answer)?.is_solution(1e-8));
/// # Ok::<(), moreau::Error>(())
/// ```
pub fn named(name: &str) -> Result<&'static Stored> {
    let missing = || Error::Unsupported(format!("there is no problem `{name}`; `moreau problems list` lists them"));
    ALL.iter().find(|stored| stored.name == name).ok_or_else(missing)
}

/// An answer of a record with its velocity, u = W r + u_free, and with the iterations of the solver of the record that proposed it.
pub fn solution(problem: &ContactProblem, record: &Record, answer: &Answered) -> Solution {
    let impulse = DVector::from_column_slice(&answer.impulse);
    let velocity = problem.velocity(&impulse);
    let vector = |numbers: &Option<Vec<f64>>| numbers.as_deref().map(DVector::from_column_slice);
    let asked = record.solvers.iter().find(|outcome| outcome.solver == answer.by);
    let mut solution = Solution::new(answer.by.clone(), impulse, velocity, asked.and_then(|outcome| outcome.iterations).unwrap_or(0));
    (solution.beta, solution.sigma) = (vector(&answer.beta), vector(&answer.sigma));
    solution
}
