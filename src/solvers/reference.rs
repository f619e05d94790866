//! The solver to use when nothing is said, and solvers by name.

use super::{ContactSolver, LemkePivoting, ProjectedGaussSeidel};
use crate::problem::{ContactProblem, Solution};
use crate::{Error, Result};
use nalgebra::DVector;

/// The names [`by_name`] knows.
pub const NAMES: [&str; 3] = ["auto", "lemke", "pgs"];

/// The default choice: Lemke for the polyhedral laws, block projected Gauss–Seidel for the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reference;

impl ContactSolver for Reference {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        match problem.law.directions() {
            Some(_) => LemkePivoting.solve(problem, warm_start),
            None => ProjectedGaussSeidel::default().solve(problem, warm_start),
        }
    }
}

/// The solver of this name with its default settings.
///
/// # Errors
/// [`Error::Unsupported`] lists the names there are.
pub fn by_name(name: &str) -> Result<Box<dyn ContactSolver>> {
    match name {
        "auto" => Ok(Box::new(Reference)),
        "lemke" => Ok(Box::new(LemkePivoting)),
        "pgs" => Ok(Box::new(ProjectedGaussSeidel::default())),
        _ => Err(Error::Unsupported(format!("there is no solver `{name}`; use one of {}", NAMES.join(", ")))),
    }
}
