//! Contact solvers, one per file. None of them judges itself: [`crate::certificate`] does.

use crate::cones::second_order;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law, Solution};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

mod accelerated_projected_gradient;
mod alternating_directions;
mod anderson;
mod barzilai_borwein;
#[cfg(feature = "clarabel")]
mod clarabel;
pub mod enumeration;
mod friction_set;
pub mod gauss;
pub mod lemke;
mod lemke_pivoting;
mod nonsmooth_newton;
mod one_contact;
mod polyhedral_contact;
pub mod primal_newton;
mod projected_gauss_seidel;
mod projected_over_relaxation;
mod reference;
mod sap;
mod sequential_impulses;
mod stopping;

pub use accelerated_projected_gradient::{AcceleratedProjectedGradient, Momentum, largest_eigenvalue_bound, objective};
pub use alternating_directions::AlternatingDirections;
pub use barzilai_borwein::BarzilaiBorwein;
#[cfg(feature = "clarabel")]
pub use clarabel::{ClarabelPolished, Polished};
pub use gauss::{GaussConjugateGradient, GaussNewton, GaussSweeps};
pub use lemke_pivoting::LemkePivoting;
pub use nonsmooth_newton::NonsmoothNewton;
pub use projected_gauss_seidel::ProjectedGaussSeidel;
pub use projected_over_relaxation::ProjectedOverRelaxation;
pub use reference::{NAMES, Reference, by_name, with_iterations};
pub use sap::SemiAnalyticPrimal;
pub use sequential_impulses::SequentialImpulses;

/// An algorithm that proposes a solution of a contact problem.
pub trait ContactSolver: Send + Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> &'static str;
    /// Whether the algorithm is a declared number of sweeps and promises no solution: what its certificate rejects counts as unconverged.
    fn is_truncated(&self) -> bool {
        false
    }
    /// Proposes a solution, starting from `warm_start` impulses if given.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Solver`] if the law, the size or an asymmetric W is outside the algorithm's scope, or if it
    /// ends without an answer (a ray, a breakdown). An answer that is merely not converged is returned and left to
    /// the certificate.
    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution>;
}

/// The impulses an iteration starts from: the given ones, or zero.
fn start(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<DVector<f64>> {
    match warm_start {
        None => Ok(DVector::zeros(problem.rows())),
        Some(impulse) if impulse.len() == problem.rows() && impulse.iter().all(|r| r.is_finite()) => Ok(impulse.clone()),
        Some(impulse) => {
            let cure = format!("give {} finite impulses", problem.rows());
            Err(Error::invalid("warm_start", format!("has {} entries, or some not finite", impulse.len()), cure))
        }
    }
}

/// The answer, unless it left the numbers: then there is none.
fn finite(solution: Solution) -> Result<Solution> {
    if solution.impulse.iter().chain(&solution.velocity).all(|x| x.is_finite()) {
        return Ok(solution);
    }
    Err(Error::solver(&solution.solver, "ended with impulses or velocities too large for a number; rescale the units of the problem"))
}

/// R of one contact row \[1/kg\], zero if the problem is hard or its compliance acts on edges.
fn compliance(problem: &ContactProblem, row: usize) -> f64 {
    match &problem.compliance {
        Some(Compliance { coordinates: Coordinates::Contact, diagonal }) => diagonal[row],
        _ => 0.0,
    }
}

/// μ of the cone that the law uses at contact k: 0 without friction.
fn cone_friction(problem: &ContactProblem, k: usize) -> f64 {
    if problem.law == Law::Frictionless { 0.0 } else { problem.friction[k] }
}

/// Replaces every contact's impulse by its projection on the second-order cone.
fn project(problem: &ContactProblem, impulse: &mut DVector<f64>) {
    for (k, contact) in impulse.as_mut_slice().chunks_exact_mut(problem.rows_per_contact).enumerate() {
        second_order::project(contact, cone_friction(problem, k));
    }
}

/// The error of a solver for convex laws that is given another one, with a solver that takes it.
fn not_convex(solver: &str, law: Law) -> Error {
    let cure = if law.directions().is_some() { "lemke" } else { "pgs" };
    Error::solver(solver, format!("does not solve the law `{}`; use `{cure}`", law.name()))
}

/// Refuses an asymmetric W in the name of a solver that minimises ½rᵀWr, whose gradient is W r only if W is symmetric.
fn require_symmetry(solver: &str, problem: &ContactProblem) -> Result<()> {
    let asymmetry = problem.asymmetry();
    if asymmetry <= crate::tolerance::solvers::SYMMETRY {
        return Ok(());
    }
    Err(Error::solver(solver, format!("needs a symmetric W, and this one has relative asymmetry {asymmetry:.1e}; use `pgs` or `lemke`")))
}

#[cfg(test)]
mod agreement_tests;
