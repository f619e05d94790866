//! What is proved of an answer to a problem with joints, and of the problem: the proofs for contacts, with y = 0 at the bilateral rows.
//!
//! ```text
//!     contact, limit   (r′, y′) in the law            bilateral   y′ = 0 ,  r′ = r
//!     y′ = (W + R) r′ + u_free + shift + δ            backward: δ in fractions, rounded outward
//!     y_b = 0 among the equations                     forward: the impulses of the joints are enclosed with those of the contacts
//!     (Aᵀp)_b = 0 ,  p_b of any sign                  no solution: p·y = 0 at the joints, A = W + R
//! ```
//! Nothing is eliminated: the proofs are of W as the problem stores it. Two solutions have y_b = y_b′ = 0, so that the joints add nothing
//! to (r − r′)·(y − y′), by which uniqueness is decided. Counting all solutions is not carried over.

use super::backward::{self, Backward, HeldAs};
use super::forward::{self, ContactState, Forward, Radius, Reason};
use super::impulse_set::{ImpulseSet, impulse_set};
use super::infeasible::{self, Infeasible};
use super::uniqueness::{Uniqueness, uniqueness};
use crate::problem::{ByRows, JointedProblem, Solution};
use crate::tolerance::proof::enlarged;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// What was decided about a solution near an answer, and the dimension of the impulses that give its velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct NearJointed {
    /// Numbers of contacts are places in the `kinds`, dependent rows those of all rows.
    pub near: Forward,
    /// None where no solution is proved, or deciding a rank takes too long.
    pub impulses: Option<ImpulseSet>,
}

/// Proves the backward error of impulses r of all rows; the sizes are constraint by constraint.
///
/// # Errors
/// [`Error::Invalid`] if r has another size or a number that is not finite, or the proof takes more memory than is allowed.
/// ```
/// use moreau_contact::certificate::jointed_proof::backward_jointed;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::{ConstraintKind, JointedProblem};
/// use moreau_contact::Law;
///
/// // a bob on a rod hits a wall; W of binary numbers
/// let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
/// let bob = JointedProblem::new(1, kinds, dmatrix![1.0, 0.5; 0.5, 1.0], dvector![-3.0, -1.5])?.law(Law::Frictionless, vec![0.0; 2])?;
/// assert_eq!(backward_jointed(&bob, &dvector![3.0, 0.0])?.velocity, [0.0, 0.0]); // exact as it stands
/// assert_eq!(backward_jointed(&bob, &dvector![3.0, 0.25])?.velocity, [0.125, 0.25]);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn backward_jointed(problem: &JointedProblem, impulse: &DVector<f64>) -> Result<Backward> {
    problem.require_rows("impulse", impulse.len())?;
    let rows = ByRows::new(problem)?;
    let found = backward::of_rows(rows.contacts(), &rows.spread(impulse), Some(&rows))?;
    let size = |of: &[f64], k: usize| backward::length(rows.parts(k).map(|i| of[i]));
    let all = 0..problem.kinds().len();
    let state = |k: usize| rows.parts(k).next().map_or(HeldAs::Joined, |i| found.states[i]);
    Ok(Backward {
        velocity: all.clone().map(|k| size(&found.velocity, k)).collect(),
        impulse: all.clone().map(|k| size(&found.impulse, k)).collect(),
        states: all.map(state).collect(),
    })
}

/// Proves that the problem has a solution near an answer; the bounds are constraint by constraint.
///
/// # Errors
/// [`Error::Invalid`] if the answer has another size than the problem or an impulse that is not finite, or the proof takes more memory than
/// is allowed; near a velocity that is not finite nothing is proved.
/// ```
/// use moreau_contact::certificate::jointed_proof::forward_jointed;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::{ConstraintKind, JointedProblem, Solution};
/// use moreau_contact::Law;
///
/// let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
/// let bob = JointedProblem::new(1, kinds, dmatrix![1.0, 0.5; 0.5, 1.0], dvector![-3.0, -1.5])?.law(Law::Frictionless, vec![0.0; 2])?;
/// let impulse = dvector![3.0, 1e-9];
/// let answer = Solution::new("by hand", impulse.clone(), bob.velocity(&impulse), 0);
/// let near = forward_jointed(&bob, &answer)?.near.proved().expect("a solution is near");
/// assert!(near.velocity[1] >= 1e-9 && near.velocity[1] < 1.001e-9); // as far as the answer was moved
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn forward_jointed(problem: &JointedProblem, answer: &Solution) -> Result<NearJointed> {
    problem.require_rows("impulse", answer.impulse.len())?;
    problem.require_rows("velocity", answer.velocity.len())?;
    if answer.impulse.iter().any(|number| !number.is_finite()) {
        return Err(Error::invalid("impulse", "has a number that is not finite", "give one finite number per row"));
    }
    if answer.velocity.iter().any(|number| !number.is_finite()) {
        return Ok(NearJointed { near: Forward::NotProved(Reason { text: backward::TOO_FAST.into(), contact: None }), impulses: None });
    }
    let rows = ByRows::new(problem)?;
    let spread = Solution::new("", rows.spread(&answer.impulse), rows.spread(&answer.velocity), 0);
    match forward::of_rows(&rows, &spread) {
        Forward::NotProved(Reason { text, contact }) => {
            let contact = contact.map(|i| rows.constraint(i));
            Ok(NearJointed { near: Forward::NotProved(Reason { text, contact }), impulses: None })
        }
        Forward::Proved(radius) => {
            let impulses = impulse_set(rows.contacts(), &spread, &radius);
            Ok(NearJointed { near: Forward::Proved(by_constraint(problem, &rows, &radius)), impulses })
        }
    }
}

/// Bounds of contacts as bounds of constraints.
fn by_constraint(problem: &JointedProblem, rows: &ByRows, radius: &Radius) -> Radius {
    let size = |of: &[f64], k: usize| {
        let sum = |sum: f64, i: usize| if sum == 0.0 { of[i] } else { enlarged(sum.hypot(of[i]), 1) };
        rows.parts(k).fold(0.0, sum)
    };
    let all = 0..problem.kinds().len();
    Radius {
        velocity: all.clone().map(|k| size(&radius.velocity, k)).collect(),
        impulse: all.clone().map(|k| size(&radius.impulse, k)).collect(),
        states: all.map(|k| rows.parts(k).next().map_or(ContactState::Joined, |i| radius.states[i])).collect(),
        dependent: radius.dependent.iter().filter_map(|row| rows.row(*row)).collect(),
        // behind them are the velocities of rows that were added
        bodies: problem.dynamics().zip(radius.bodies.as_ref()).map(|(own, all)| all[..own.mass.nrows()].to_vec()),
    }
}

/// A witness that the problem has no solution, one number per row of all; none if the search finds none.
///
/// # Errors
/// [`Error::Invalid`] if the proof takes more memory than is allowed.
/// ```
/// use moreau_contact::certificate::jointed_proof::infeasible_jointed;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::{ConstraintKind, JointedProblem};
///
/// // one rod twice, and two velocities along it
/// let rods = |other: f64| {
///     JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 1 }; 2], dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, other])
/// };
/// assert!(infeasible_jointed(&rods(-1.0)?)?.is_none());
/// assert!(infeasible_jointed(&rods(-1.5)?)?.is_some());
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn infeasible_jointed(problem: &JointedProblem) -> Result<Option<Infeasible>> {
    let rows = ByRows::new(problem)?;
    let joined: Vec<bool> = (0..rows.contacts().contacts()).map(|i| rows.is_joined(i)).collect();
    let found = infeasible::of_rows(rows.contacts(), &joined);
    Ok(found.map(|found| Infeasible { witness: DVector::from_vec(rows.gather(found.witness.as_slice())), ..found }))
}

/// Whether all solutions have the same velocities.
///
/// # Errors
/// [`Error::Invalid`] if the proof takes more memory than is allowed.
/// ```
/// use moreau_contact::certificate::jointed_proof::uniqueness_jointed;
/// use moreau_contact::certificate::uniqueness::Uniqueness;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::{ConstraintKind, JointedProblem};
///
/// let rods = |between: f64| {
///     let kinds = vec![ConstraintKind::Bilateral { rows: 1 }; 2];
///     JointedProblem::new(1, kinds, dmatrix![1.0, between; between, 1.0], dvector![-1.0, -1.0])
/// };
/// assert!(matches!(uniqueness_jointed(&rods(0.5)?)?, Uniqueness::Solution(_)));
/// assert!(matches!(uniqueness_jointed(&rods(1.0)?)?, Uniqueness::Velocity(_) | Uniqueness::Unknown(_))); // the impulses are not
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn uniqueness_jointed(problem: &JointedProblem) -> Result<Uniqueness> {
    Ok(uniqueness(ByRows::new(problem)?.contacts()))
}

#[cfg(test)]
#[path = "jointed_proof_tests.rs"]
mod tests;
