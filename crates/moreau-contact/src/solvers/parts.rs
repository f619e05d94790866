//! What every solver needs, your own included: impulses to start from, refusals, and a check that an answer is finite.

use crate::cones::second_order;
use crate::memory::spare::{self, Lent, Spare};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::first_order::SLIGHTLY;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The impulses an iteration starts from \[N·s\]: the given ones, or zero.
///
/// # Errors
/// [`Error::Invalid`] if the given ones are not as many finite numbers as the problem has rows.
pub fn start(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<DVector<f64>> {
    check_start(problem, warm_start)?;
    Ok(warm_start.map_or_else(|| spare::zeros(problem.rows()), Spare::copied))
}

/// Refuses given impulses that are not as many finite numbers as the problem has rows.
///
/// # Errors
/// [`Error::Invalid`] with their number, or the first row that is not finite.
pub(super) fn check_start(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<()> {
    let Some(impulse) = warm_start else { return Ok(()) };
    problem.require_size("warm_start", impulse.len())?;
    match impulse.as_slice().iter().position(|r| !r.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::invalid(format!("warm_start[{row}]"), format!("is {}", impulse[row]), "give finite impulses")),
    }
}

/// The solution itself, if all its impulses and velocities are finite.
///
/// # Errors
/// [`Error::Solver`] in the name of its solver if one is infinite or not a number.
pub fn finite(solution: Solution) -> Result<Solution> {
    if solution.impulse.iter().chain(&solution.velocity).all(|x| x.is_finite()) {
        return Ok(solution);
    }
    let reason = "ended with impulses or velocities too large for a number; ask another solver, for its impulses may grow without \
                  end where W + R is not positive semidefinite, or rescale the units of the problem";
    Err(Error::breakdown(&solution.solver, reason))
}

/// Makes one vector another one's copy, in its own memory if there is room.
pub(super) fn copy(from: &DVector<f64>, to: &mut DVector<f64>) {
    resize(to, from.len());
    to.copy_from(from);
}

/// Gives a vector so many entries, zeros where they were not so many, in its own memory if there is room.
pub(super) fn resize(vector: &mut DVector<f64>, size: usize) {
    if vector.len() != size {
        let mut entries = Lent::from(Vec::from(std::mem::replace(vector, Spare::nothing()).data));
        entries.make_room(size);
        entries.resize(size, 0.0);
        *vector = entries.into_inner().into();
    }
}

/// R of one contact row \[1/kg\], zero if the problem is hard or its compliance acts on edges.
pub fn compliance(problem: &ContactProblem, row: usize) -> f64 {
    problem.row_compliance(row)
}

/// (W + R) r \[m/s\] for impulses r \[N·s\]; a compliance on edges is not part of it.
pub fn law_product(problem: &ContactProblem, impulse: &DVector<f64>) -> DVector<f64> {
    let mut product = problem.apply(impulse);
    for (row, y) in product.iter_mut().enumerate() {
        *y += compliance(problem, row) * impulse[row];
    }
    product
}

/// μ of the cone that the law uses at contact k: 0 without friction.
pub fn cone_friction(problem: &ContactProblem, k: usize) -> f64 {
    problem.law().cone_friction(problem.friction()[k])
}

/// Replaces every contact's impulse by its projection on the second-order cone.
pub fn project(problem: &ContactProblem, impulse: &mut DVector<f64>) {
    for (k, contact) in impulse.as_mut_slice().chunks_exact_mut(problem.rows_per_contact()).enumerate() {
        second_order::project(contact, cone_friction(problem, k));
    }
}

/// The error of a solver for convex laws that is given another one.
pub fn not_convex(solver: &str, law: Law) -> Error {
    Error::refused(solver, format!("does not solve the law `{}`", law.name()))
}

/// Whether a solver of convex programs over second-order cones takes a problem with this law and symmetry.
pub fn takes_convex(law: Law, symmetric: bool) -> bool {
    symmetric && matches!(law, Law::Frictionless | Law::Associated)
}

/// Refuses what [`takes_convex`] does not take.
///
/// # Errors
/// [`Error::Solver`] with the law, or with the relative asymmetry.
pub fn require_convex(solver: &str, problem: &ContactProblem) -> Result<()> {
    if !takes_convex(problem.law(), true) {
        return Err(not_convex(solver, problem.law()));
    }
    require_symmetry(solver, problem)
}

/// Refuses another law than [`takes_convex`] takes, and a W that is asymmetric by more than [`SLIGHTLY`].
///
/// # Errors
/// [`Error::Solver`] with the law, or with the relative asymmetry.
pub fn require_nearly_convex(solver: &str, problem: &ContactProblem) -> Result<()> {
    if !takes_convex(problem.law(), true) {
        return Err(not_convex(solver, problem.law()));
    }
    require_near_symmetry(solver, problem)
}

/// Refuses a W that is asymmetric by more than [`SLIGHTLY`], in the name of a solver for symmetric ones whose answer is judged by the W
/// that was given.
///
/// # Errors
/// [`Error::Solver`] with the relative asymmetry.
pub fn require_near_symmetry(solver: &str, problem: &ContactProblem) -> Result<()> {
    at_most(solver, problem, SLIGHTLY)
}

/// Refuses an asymmetric W in the name of a solver that minimises ½rᵀWr, whose gradient is W r only if W is symmetric.
///
/// # Errors
/// [`Error::Solver`] with the relative asymmetry.
pub fn require_symmetry(solver: &str, problem: &ContactProblem) -> Result<()> {
    at_most(solver, problem, crate::tolerance::solvers::SYMMETRY)
}

fn at_most(solver: &str, problem: &ContactProblem, most: f64) -> Result<()> {
    let asymmetry = problem.asymmetry();
    if asymmetry <= most {
        return Ok(());
    }
    Err(Error::refused(solver, format!("needs a symmetric W, and this one has relative asymmetry {asymmetry:.1e}")))
}
