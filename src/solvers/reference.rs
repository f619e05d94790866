//! The solver to use when nothing is said, and solvers by name.

use super::stopping::Stopping;
use super::{AcceleratedProjectedGradient, AlternatingDirections, BarzilaiBorwein, ClarabelPolished, ContactSolver, LemkePivoting};
use super::{
    GaussConjugateGradient, GaussNewton, GaussSweeps, ProjectedGaussSeidel, ProjectedOverRelaxation, SemiAnalyticPrimal, SequentialImpulses,
};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers::FIRST_SWEEPS;
use crate::{Error, Result};
use nalgebra::DVector;

/// The names [`by_name`] knows.
pub const NAMES: [&str; 13] =
    ["auto", "lemke", "pgs", "psor", "apgd", "bb", "admm", "clarabel", "newton", "cg", "gauss-pgs", "sap", "sequential-impulses"];

/// The default choice: Newton's method for soft convex laws whose mass and Jacobian are known, Lemke for the polyhedral laws, accelerated block projected Gauss–Seidel for the others. At spatial contacts Stewart–Trinkle's
/// law is first tried by a bounded number of sweeps, for Lemke's tableau has (2 + d)² entries per pair of contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reference;

impl ContactSolver for Reference {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.compliance.is_some()
            && let Ok(solution) = GaussNewton::default().solve(problem, warm_start)
        {
            return Ok(solution);
        }
        match problem.law.directions() {
            Some(_) if problem.rows_per_contact == 3 => match sweeps(problem, warm_start)? {
                Some(solution) => Ok(solution),
                None => LemkePivoting.solve(problem, warm_start),
            },
            Some(_) => LemkePivoting.solve(problem, warm_start),
            None => ProjectedGaussSeidel::accelerated().solve(problem, warm_start),
        }
    }
}

/// The answer of a bounded number of sweeps, if they converge.
fn sweeps(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Option<Solution>> {
    let Law::PolyhedralCoulomb { .. } = problem.law else { return Ok(None) };
    problem.validate()?;
    let solver = ProjectedGaussSeidel { sweeps: FIRST_SWEEPS, ..ProjectedGaussSeidel::accelerated() };
    let Ok(solution) = solver.solve(problem, warm_start) else { return Ok(None) };
    let converged = Stopping::new(problem, solver.tolerance).holds(&solution.impulse, &problem.law_velocity(&solution.impulse));
    Ok(converged.then_some(solution))
}

/// The solver of this name with its default settings.
///
/// # Errors
/// [`Error::Unsupported`] lists the names there are.
pub fn by_name(name: &str) -> Result<Box<dyn ContactSolver>> {
    match name {
        "auto" => Ok(Box::new(Reference)),
        "lemke" => Ok(Box::new(LemkePivoting)),
        "apgd" => Ok(Box::new(AcceleratedProjectedGradient::default())),
        "bb" => Ok(Box::new(BarzilaiBorwein::default())),
        "admm" => Ok(Box::new(AlternatingDirections::default())),
        "psor" => Ok(Box::new(ProjectedOverRelaxation::default())),
        "clarabel" => Ok(Box::new(ClarabelPolished)),
        "sap" => Ok(Box::new(SemiAnalyticPrimal)),
        "sequential-impulses" => Ok(Box::new(SequentialImpulses::default())),
        "pgs" => Ok(Box::new(ProjectedGaussSeidel::default())),
        "newton" => Ok(Box::new(GaussNewton::default())),
        "cg" => Ok(Box::new(GaussConjugateGradient::default())),
        "gauss-pgs" => Ok(Box::new(GaussSweeps::default())),
        _ => Err(Error::Unsupported(format!("there is no solver `{name}`; use one of {}", NAMES.join(", ")))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_name_is_a_solver_of_that_name_and_others_get_the_list() {
        for name in NAMES {
            assert_eq!(by_name(name).unwrap().name(), name);
        }
        let message = by_name("gauss").err().unwrap().to_string();
        assert!(NAMES.iter().all(|name| message.contains(name)), "{message}");
    }
}
