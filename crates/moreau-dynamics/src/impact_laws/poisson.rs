//! Poisson's law: the impulse of restitution is e times the impulse of compression.
//!
//! ```text
//!     compression    0 ≤ U_c ⟂ P_c ≥ 0 ,            U_c = U⁻ + W P_c
//!     restitution    0 ≤ U⁺ ⟂ P_r − E P_c ≥ 0 ,     U⁺ = U_c + W P_r
//!     along a path   P_n = (1 + e) p_c ,  U_n(p_c) = 0
//! ```
//! Without friction P_c + P_r minimises the change of kinetic energy ½PᵀWP + PᵀU⁻ among P ≥ (1 + E)P_c; see [`two_problems`].

use super::impact::{check_restitution, coulomb, unilateral};
use super::routh::Path;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::Result;
use moreau_exact::scalar::Scalar;
use nalgebra::DVector;

/// The end of compression and the end of restitution.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoPhases<T: Scalar> {
    /// P_c and U_c.
    pub compression: Response<T>,
    /// P_c + P_r and U⁺.
    pub end: Response<T>,
}

/// The impact of frictionless contacts by one complementarity problem per phase, for any number of contacts and coefficients.
///
/// A contact may take more than e P_c in restitution, if its neighbours would otherwise drive it into the ground. No energy is
/// gained. P_r minimises f(P) = ½PᵀWP + PᵀU_c over P ≥ E P_c, which is the change of energy since compression. P = P_c is one of
/// the candidates. Because of U_cᵀP_c = 0, f(P_c) = ½P_cᵀWP_c is the energy that compression took.
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] for e outside \[0, 1\]; [`moreau_exact::Error::Solver`] if a complementarity problem is not solved.
///
/// # Source
/// Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts* (1996).
pub fn two_problems<T: Scalar>(impact: &PlanarProblem<T>, restitution: &[T]) -> Result<TwoPhases<T>> {
    let contacts = impact.velocity.len();
    check_restitution(restitution, contacts)?;
    let zero = DVector::from_element(contacts, T::zero());
    let compression = impact.response(unilateral(impact, &zero)?);
    let least = compression.impulse.map_with_location(|i, _, p| p * restitution[i].clone());
    let released = PlanarProblem::new(impact.delassus.clone(), &compression.after + &impact.delassus * &least);
    let surplus = unilateral(&released, &zero)?;
    let end = impact.response(&compression.impulse + least + surplus);
    Ok(TwoPhases { compression, end })
}

/// The impact of planar contacts with Coulomb friction by one problem per phase, on the velocities at the end of the phase. Each contact
/// has the rows (normal, tangent).
///
/// In restitution 0 ≤ U_n⁺ ⟂ P_rn − e P_cn ≥ 0, and Coulomb's law holds between P_r and U_t⁺. If the sliding reverses within
/// a phase, this is not Routh's path. Several contacts with unequal coefficients may gain energy.
///
/// # Errors
/// As [`two_problems`], and if there are not two rows per contact.
pub fn two_frictional_problems<T: Scalar>(impact: &PlanarProblem<T>, friction: &[T], restitution: &[T]) -> Result<TwoPhases<T>> {
    check_restitution(restitution, friction.len())?;
    let none = DVector::from_element(friction.len(), T::zero());
    let compression = impact.response(coulomb(impact, friction, &none)?);
    let least = DVector::from_fn(friction.len(), |k, _| restitution[k].clone() * compression.impulse[2 * k].clone());
    let released = PlanarProblem::new(impact.delassus.clone(), compression.after.clone());
    let end = impact.response(&compression.impulse + coulomb(&released, friction, &least)?);
    Ok(TwoPhases { compression, end })
}

/// The impact of one planar contact with Coulomb friction. The impulse grows along Routh's path until P_n = (1 + e) p_c.
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] for e outside \[0, 1\].
pub fn along<T: Scalar>(path: &Path<T>, restitution: &T) -> Result<Response<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    Ok(path.outcome(&((T::one() + restitution.clone()) * path.compression_end())))
}
