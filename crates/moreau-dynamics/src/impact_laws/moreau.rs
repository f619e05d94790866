//! Moreau's law, −P ∈ N(U⁺ + e U⁻): complementarity, and Coulomb's law, on a mixture of the velocities before and after.
//!
//! ```text
//!     frictionless     0 ≤ U⁺ + E U⁻ ⟂ P ≥ 0
//!     normal only      Coulomb on (U_n⁺ + e U_n⁻, U_t⁺)
//!     full vector      Coulomb on U⁺ + e U⁻ ,     ΔT = PᵀŪ/(1+e) − ½(1−e)/(1+e) PᵀWP ≤ 0 ,   Ū = U⁺ + e U⁻
//! ```
//! PᵀŪ ≤ 0 under Coulomb's law on Ū, so the full vector never gains energy; normal-only may.

use super::impact::{check_restitution, coulomb, unilateral};
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::Result;
use moreau_exact::scalar::Scalar;
use nalgebra::DVector;

/// The impact of frictionless contacts, any number of them, each with its own coefficient.
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] for e outside \[0, 1\]; [`moreau_exact::Error::Solver`] if the complementarity problem has no solution,
/// which dependent contacts with different coefficients may bring about.
pub fn frictionless<T: Scalar>(impact: &PlanarProblem<T>, restitution: &[T]) -> Result<Response<T>> {
    check_restitution(restitution, impact.velocity.len())?;
    let shift = impact.velocity.map_with_location(|i, _, u| u * restitution[i].clone());
    Ok(impact.response(unilateral(impact, &shift)?))
}

/// The impact of planar contacts with Coulomb friction, with e on the normal components only, as time-stepping codes do it.
///
/// # Errors
/// As [`frictionless`], and if there are not two rows per contact.
pub fn normal_only<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], restitution: &T) -> Result<Response<T>> {
    two_coefficients(impact, friction, restitution, &T::zero())
}

/// The impact of planar contacts with Coulomb friction, with e on both components.
///
/// # Errors
/// As [`normal_only`].
pub fn full_vector<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], restitution: &T) -> Result<Response<T>> {
    two_coefficients(impact, friction, restitution, restitution)
}

/// The impact of planar contacts with Coulomb's law on (U_n⁺ + e_n U_n⁻, U_t⁺ + e_t U_t⁻).
///
/// # Errors
/// As [`normal_only`].
pub fn two_coefficients<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], normal: &T, tangential: &T) -> Result<Response<T>> {
    check_restitution(&[normal.clone(), tangential.clone()], 2)?;
    let shift: DVector<T> = impact.velocity.map_with_location(|i, _, u| u * if i % 2 == 0 { normal.clone() } else { tangential.clone() });
    let mixed = impact.shifted(&shift);
    Ok(impact.response(coulomb(&mixed, friction, &DVector::from_element(friction.len(), T::zero()))?))
}
