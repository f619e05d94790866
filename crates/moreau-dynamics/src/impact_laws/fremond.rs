//! Frémond's law: friction opposes the mean of the sliding velocities before and after.
//!
//! ```text
//!     0 ≤ U_n⁺ + e U_n⁻ ⟂ P_n ≥ 0 ,     −P_t ∈ μ P_n ∂‖·‖ ( ½(U_t⁺ + U_t⁻) )
//!     ΔT = Σ ½(1 − e) P_n U_n⁻ − Σ μ P_n ½|U_t⁺ + U_t⁻| ≤ 0     if U_n⁻ ≤ 0 wherever P_n > 0
//! ```
//! The work of an impulse is P times the mean velocity, so friction on the mean never feeds energy in, at any number of contacts.

use super::moreau::two_coefficients;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::Result;
use moreau_exact::scalar::Scalar;

/// The impact of planar contacts with rows (normal, tangent), by Coulomb's law on (U_n⁺ + e U_n⁻, U_t⁺ + U_t⁻). The second entry is twice
/// the mean of the sliding velocities.
///
/// # Errors
/// As [`two_coefficients`].
///
/// # Source
/// Frémond, *Non-Smooth Thermomechanics* (2002), percussions that derive from a function of the mean velocity; in the form of
/// Siconos' `FremondImpactFrictionNSL` at θ = ½.
pub fn planar<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], restitution: &T) -> Result<Response<T>> {
    two_coefficients(impact, friction, restitution, &T::one())
}
