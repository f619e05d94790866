//! Contact solvers, one per file. None of them judges itself: [`crate::certificate`] does.

pub mod lemke;

use crate::Result;
use crate::problem::{ContactProblem, Solution};
use nalgebra::DVector;

/// An algorithm that proposes a solution of a contact problem.
pub trait ContactSolver: Send + Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> &'static str;
    /// Proposes a solution, starting from `warm_start` impulses if given.
    ///
    /// # Errors
    /// [`crate::Error::Solver`] if the law, the size or an asymmetric W is outside the algorithm's scope, or if it
    /// ends without an answer (a ray, a breakdown). An answer that is merely not converged is returned and left to
    /// the certificate.
    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution>;
}
