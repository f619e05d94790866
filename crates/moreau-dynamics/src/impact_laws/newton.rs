//! Newton's law, U_n⁺ = −e U_n⁻, in the three readings that “at every contact” has.
//!
//! ```text
//!     together       P = −W⁻¹(I + E) U⁻                     every contact reverses its velocity, whatever the sign of P
//!     uncoupled      P_i = −(1 + e_i) U_i⁻/W_ii             every contact acts as if it were alone
//!     along a path   U_n(p) = −e U_n⁻                       one contact with friction, Routh's path
//! ```

use super::impact::check_restitution;
use super::routh::Path;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result, elimination};
use nalgebra::DVector;

/// The impact with U⁺ = −E U⁻ at every contact at once, without friction. Impulses may pull.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\]; [`Error::Unsupported`] if W is singular, because the ratios then contradict each
/// other or do not determine the impulses.
///
/// ```
/// use moreau_contact::problem::PlanarProblem;
/// use moreau_dynamics::impact_laws::newton::{together, uncoupled};
/// use moreau_exact::scalar::{Rational, ratio};
/// use nalgebra::{dmatrix, dvector};
///
/// // three equal balls in a row of contacts: one arrives at 1 m/s
/// let [one, two, zero]: [Rational; 3] = [ratio(1, 1), ratio(2, 1), ratio(0, 1)];
/// let row = PlanarProblem::new(dmatrix![two.clone(), -one.clone(); -one.clone(), two], dvector![-one.clone(), zero.clone()]);
/// let elastic = [one.clone(), one.clone()];
/// assert_eq!(together(&row, &elastic)?.after, dvector![one.clone(), zero]);
/// assert_eq!(uncoupled(&row, &elastic)?.after, dvector![one.clone(), -one]); // the second contact now approaches
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn together<T: Scalar>(impact: &PlanarProblem<T>, restitution: &[T]) -> Result<Response<T>> {
    check_restitution(restitution, impact.velocity.len())?;
    let change = DVector::from_fn(impact.velocity.len(), |i, _| -(T::one() + restitution[i].clone()) * impact.velocity[i].clone());
    let singular = || Error::Unsupported("Newton's law prescribes every velocity, which needs a nonsingular W".into());
    elimination::solve(&impact.delassus, &change).map(|impulse| impact.response(impulse)).ok_or_else(singular)
}

/// The impact with P_i = −(1 + e_i) U_i⁻/W_ii at every approaching contact. Each impulse is computed as if its contact were alone, and all
/// are applied at once.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\].
pub fn uncoupled<T: Scalar>(impact: &PlanarProblem<T>, restitution: &[T]) -> Result<Response<T>> {
    check_restitution(restitution, impact.velocity.len())?;
    let impulse = DVector::from_fn(impact.velocity.len(), |i, _| {
        let approach = impact.velocity[i].clone();
        let alone = -(T::one() + restitution[i].clone()) * approach.clone() / impact.delassus[(i, i)].clone();
        if approach < T::zero() { alone } else { T::zero() }
    });
    Ok(impact.response(impulse))
}

/// The impact of one planar contact with Coulomb friction. The impulse grows along Routh's path until U_n = −e U_n⁻.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\].
pub fn along<T: Scalar>(path: &Path<T>, restitution: &T) -> Result<Response<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    let target = -restitution.clone() * path.impact().velocity[0].clone();
    Ok(path.outcome(&path.reaching(&target)))
}
