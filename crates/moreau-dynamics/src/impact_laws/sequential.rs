//! One impact after the other: Newton's law at a single approaching contact at a time, until none of the order approaches.
//!
//! ```text
//!     P_i += −(1 + e) U_i/W_ii ,   U += W_·i P_i     for the contacts in the given order, again and again
//! ```

use super::impact::check_restitution;
use crate::tolerance::impact_laws::SEQUENCE_LIMIT;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The impacts of frictionless contacts one after the other, visited cyclically in this order. A contact that is not in the order takes no
/// impulse and may still approach in the end.
///
/// # Errors
/// [`Error::Invalid`] for e outside \[0, 1\] or an order that names a contact that does not exist; [`Error::Solver`] if contacts
/// still approach after [`SEQUENCE_LIMIT`] rounds: the sequence may be infinite.
///
/// ```
/// use moreau_contact::problem::PlanarProblem;
/// use moreau_dynamics::impact_laws::sequential::sequential;
/// use nalgebra::{dmatrix, dvector};
///
/// let cradle = PlanarProblem::new(dmatrix![2.0, -1.0; -1.0, 2.0], dvector![-1.0, 0.0]); // three balls, two contacts
/// let end = sequential(&cradle, &1.0, &[0, 1])?;
/// assert_eq!(end.after, dvector![0.0, 1.0]); // the last ball alone leaves
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn sequential<T: Scalar>(impact: &PlanarProblem<T>, restitution: &T, order: &[usize]) -> Result<Response<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    let contacts = impact.velocity.len();
    if let Some(stranger) = order.iter().find(|&&i| i >= contacts) {
        return Err(Error::invalid("order", format!("names contact {stranger}"), format!("there are {contacts}")));
    }
    let mut now = impact.response(DVector::from_element(contacts, T::zero()));
    for _ in 0..SEQUENCE_LIMIT {
        if order.iter().all(|&i| now.after[i] >= T::zero()) {
            return Ok(now);
        }
        for &i in order.iter() {
            if now.after[i] < T::zero() {
                now.impulse[i] -= (T::one() + restitution.clone()) * now.after[i].clone() / impact.delassus[(i, i)].clone();
                now = impact.response(now.impulse);
            }
        }
    }
    Err(Error::limit("sequential", format!("contacts still approach after {SEQUENCE_LIMIT} rounds")))
}
