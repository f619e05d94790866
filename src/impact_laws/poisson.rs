//! Poisson's law: the impulse of restitution is e times the impulse of compression.
//!
//! ```text
//!     compression    0 ≤ U_c ⟂ P_c ≥ 0 ,            U_c = U⁻ + W P_c
//!     restitution    0 ≤ U⁺ ⟂ P_r − E P_c ≥ 0 ,     U⁺ = U_c + W P_r
//!     along a path   P_n = (1 + e) p_c ,  U_n(p_c) = 0
//! ```
//! Without friction P_c + P_r minimises the kinetic energy ½PᵀWP + PᵀU⁻ among P ≥ (1 + E)P_c; see [`two_problems`].

use super::impact::check_restitution;
use super::routh::Path;
use super::{Impact, Outcome};
use crate::scalar::Scalar;
use crate::{Error, Result};
use nalgebra::DVector;

/// The end of compression and the end of restitution.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoPhases<T: Scalar> {
    /// P_c and U_c.
    pub compression: Outcome<T>,
    /// P_c + P_r and U⁺.
    pub end: Outcome<T>,
}

/// Two frictionless complementarity problems, any number of contacts and coefficients.
///
/// A contact may take more than e P_c in restitution, if its neighbours would otherwise drive it into the ground. No energy is
/// gained: P_r minimises f(P) = ½PᵀWP + PᵀU_c over P ≥ E P_c, which is the change of energy since compression, P = P_c is one of
/// the candidates, and f(P_c) is minus what compression took, U_cᵀP_c = 0.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\]; [`Error::Solver`] if a complementarity problem is not solved.
///
/// # Source
/// Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts* (1996).
pub fn two_problems<T: Scalar>(impact: &Impact<T>, restitution: &[T]) -> Result<TwoPhases<T>> {
    let contacts = impact.before.len();
    check_restitution(restitution, contacts)?;
    let zero = DVector::from_element(contacts, T::zero());
    let compression = impact.outcome(impact.unilateral(&zero)?);
    let least = compression.impulse.map_with_location(|i, _, p| p * restitution[i].clone());
    let released = Impact::new(impact.delassus.clone(), &compression.after + &impact.delassus * &least);
    let surplus = released.unilateral(&zero)?;
    let end = impact.outcome(&compression.impulse + least + surplus);
    Ok(TwoPhases { compression, end })
}

/// Two planar problems with Coulomb friction, on the velocities at the end of each phase; rows (normal, tangent) per contact.
///
/// Restitution hands out P_rn = e P_cn and Coulomb's law on U_t⁺; where the sliding turns round within a phase this is not
/// Routh's path.
///
/// # Errors
/// As [`two_problems`]; [`Error::Solver`] also if a contact would need more than e P_cn in restitution.
pub fn two_frictional_problems<T: Scalar>(impact: &Impact<T>, friction: &T, restitution: &T) -> Result<TwoPhases<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    let zero = DVector::from_element(2, T::zero());
    let compression = impact.outcome(impact.coulomb(std::slice::from_ref(friction), &zero)?);
    let normal = compression.impulse[0].clone() * restitution.clone();
    let free = compression.after[1].clone() + impact.delassus[(1, 0)].clone() * normal.clone();
    let bound = friction.clone() * normal.clone();
    let stick = -free / impact.delassus[(1, 1)].clone();
    let tangential = clamp(stick, &bound);
    let end = impact.outcome(&compression.impulse + DVector::from_vec(vec![normal, tangential]));
    if end.after[0] < T::zero() {
        return Err(Error::solver("poisson", "restitution with e times the impulse of compression would end inside the ground"));
    }
    Ok(TwoPhases { compression, end })
}

/// One planar contact with Coulomb friction: the impulse grows along Routh's path until P_n = (1 + e) p_c.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\].
pub fn along<T: Scalar>(path: &Path<T>, restitution: &T) -> Result<Outcome<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    Ok(path.outcome(&((T::one() + restitution.clone()) * path.compression_end())))
}

/// The number in \[−bound, bound\] nearest to x.
fn clamp<T: Scalar>(x: T, bound: &T) -> T {
    if x > *bound {
        bound.clone()
    } else if x < -bound.clone() {
        -bound.clone()
    } else {
        x
    }
}
