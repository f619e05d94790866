//! What impact laws ask of the problem of an impact: impulses that only push, and Coulomb's law above given impulses.

use moreau_contact::problem::PlanarProblem;
use moreau_contact::solvers::lemke::solution;
use moreau_exact::number::counted;
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// P with 0 ≤ U⁺ + shift ⟂ P ≥ 0.
///
/// # Errors
/// [`Error::Solver`] if Lemke's method ends on a ray. Exact arithmetic excludes that for W = H M⁻¹Hᵀ if U⁻ + shift lies in the range
/// of H, as with one coefficient for all contacts. Contacts that depend on each other and have different coefficients may have no
/// solution.
pub(super) fn unilateral<T: Scalar>(impact: &PlanarProblem<T>, shift: &DVector<T>) -> Result<DVector<T>> {
    solution(&impact.shifted(shift).frictionless())
}

/// P of planar Coulomb friction on the velocities U⁺ with at least these normal impulses, 0 ≤ U_n⁺ ⟂ P_n − least ≥ 0; rows (normal,
/// tangent) per contact: the Stewart–Trinkle problem with both senses of the tangent, whose friction bound starts at μ least.
///
/// # Errors
/// [`Error::Invalid`] if there are not two rows per coefficient; [`Error::Solver`] if Lemke's method ends on a ray.
pub(super) fn coulomb<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], least: &DVector<T>) -> Result<DVector<T>> {
    let given = DVector::from_fn(impact.velocity.len(), |i, _| match least.get(i / 2) {
        Some(least) if i % 2 == 0 => least.clone(),
        _ => T::zero(),
    });
    let mut problem = impact.shifted(&(&impact.delassus * &given)).coulomb(friction)?;
    let bounds = problem.generators.ncols();
    for (k, mu) in friction.iter().enumerate() {
        problem.lcp.vector[bounds + k] = mu.clone() * least[k].clone();
    }
    Ok(given + problem.solve()?)
}

/// Refuses coefficients outside \[0, 1\] or in the wrong number.
pub(super) fn check_restitution<T: Scalar>(restitution: &[T], contacts: usize) -> Result<()> {
    if restitution.len() != contacts || restitution.iter().any(|e| !(*e >= T::zero() && *e <= T::one())) {
        return Err(Error::invalid(
            "restitution",
            "is not a list of numbers in [0, 1], one per contact",
            format!("give {} from 0 to 1", counted(contacts, "number")),
        ));
    }
    Ok(())
}
