//! The residuals of an answer, contact by contact: which contacts are wrong, and by how much.
//!
//! ```text
//!     accepted_k   every residual of contact k ≤ max(τ · scale, floor)
//! ```
//! [`residuals`](fn@super::residuals) keeps each residual where it is worst; an answer is accepted where every contact is.

use super::judge::Judge;
use super::part::Part;
use crate::problem::{ContactProblem, Solution};
use moreau_exact::Result;

/// The six residuals of one contact, in the order of [`Judged::entries`](super::Judged::entries).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactResiduals {
    /// dist(r, K) \[N·s\], dist(ŷ, K*) \[m/s\], |r·ŷ| \[J\], the natural maps of Signorini's pair and of friction \[N·s\], and
    /// |u − (W r + u_free)| of the stored u \[m/s\].
    pub parts: [Part; 6],
}

impl ContactResiduals {
    /// Whether the contact is within the limit max(τ · scale, floor) of each of its residuals.
    pub fn accepts(&self, tolerance: f64) -> bool {
        self.parts.iter().all(|part| part.relative() <= tolerance)
    }
}

/// The residuals of every contact of an answer. Those of a contact that has no impulse and plainly opens are 0.
///
/// # Errors
/// Those of [`residuals`](fn@super::residuals).
/// Two balls of 1 kg fall at 1 m/s; the second impulse is too small:
/// ```
/// use moreau_contact::certificate::by_contact;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
///
/// let balls = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, -1.0]).rows_per_contact(1).build()?;
/// let contacts = by_contact(&balls, &Solution::new("by hand", dvector![1.0, 0.5], dvector![0.0, -0.5], 0))?;
/// assert!(contacts[0].accepts(1e-8) && !contacts[1].accepts(1e-8));
/// assert_eq!(contacts[1].parts[1].value, 0.5); // dual: it goes on at 0.5 m/s
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn by_contact(problem: &ContactProblem, solution: &Solution) -> Result<Vec<ContactResiduals>> {
    super::judge::check_sizes(problem, solution)?;
    let mut contacts = vec![ContactResiduals::default(); problem.contacts()];
    Judge::default().judge_seen(problem, solution, |contact, entry, part| {
        let place = &mut contacts[contact].parts[entry];
        // the stored velocity has a residual for each of its rows
        *place = if *place == Part::default() { part } else { place.worse(part) };
    })?;
    Ok(contacts)
}

#[cfg(test)]
mod tests {
    use super::by_contact;
    use crate::certificate::residuals;
    use crate::problem::{ContactProblem, Law, Solution};
    use crate::tolerance::certificate::CERTIFY;
    use nalgebra::{DMatrix, DVector};

    /// A point that opens, one that sticks and one that slides, each of 1 kg, μ = ½: the answers are written down.
    fn points() -> (ContactProblem, [f64; 9]) {
        let free = DVector::from_row_slice(&[2.0, 3.0, -2.0, -1.0, 0.3, 0.2, -1.0, 1.8, -2.4]);
        let problem = ContactProblem::new(DMatrix::identity(9, 9), free).law(Law::Coulomb).friction(vec![0.5; 3]).build();
        (problem.expect("sizes fit"), [0.0, 0.0, 0.0, 1.0, -0.3, -0.2, 1.0, -0.3, 0.4])
    }

    #[test]
    fn a_wrong_impulse_is_told_at_its_contact_alone_and_the_worst_contact_is_that_of_the_residuals() {
        let (problem, right) = points();
        for wrong in [None, Some(0), Some(4), Some(6), Some(8)] {
            let mut impulse = DVector::from_row_slice(&right);
            wrong.into_iter().for_each(|row| impulse[row] += 0.25);
            let velocity = problem.velocity(&impulse);
            let solution = Solution::new("by hand", impulse, velocity, 0);
            let contacts = by_contact(&problem, &solution).expect("sizes fit");
            let refused: Vec<usize> = (0..3).filter(|k| !contacts[*k].accepts(CERTIFY)).collect();
            assert_eq!(refused, wrong.map(|row: usize| row / 3).into_iter().collect::<Vec<_>>());
            let worst = contacts.iter().flat_map(|contact| contact.parts.map(|part| part.relative())).fold(0.0, f64::max);
            let whole = residuals(&problem, &solution).expect("sizes fit");
            assert_eq!(worst, whole.judged.relative());
        }
    }

    #[test]
    fn friction_is_judged_however_large_its_coefficient_is() {
        for mu in [1.0, 100.0, 1e6, 1e12, 1e15] {
            // the impulse 1/μ bears a friction of 1 N·s, which slows the point of 1 kg from 2 to 1 m/s
            let free = DVector::from_row_slice(&[-1.0 / mu, 0.0, 2.0]);
            let problem = ContactProblem::new(DMatrix::identity(3, 3), free).friction(vec![mu]).build().expect("sizes fit");
            let accepts = |impulse: [f64; 3]| {
                let impulse = DVector::from_row_slice(&impulse);
                let velocity = problem.velocity(&impulse);
                by_contact(&problem, &Solution::new("by hand", impulse, velocity, 0)).expect("sizes fit")[0].accepts(CERTIFY)
            };
            assert!(accepts([1.0 / mu, 0.0, -1.0]), "{mu}");
            let pressed = [1.0, 0.0, -0.5, -0.99].map(|friction| [1.0 / mu, 0.0, friction]);
            for wrong in pressed.into_iter().chain([[0.0, 0.0, -1.0], [0.0; 3]]) {
                assert!(!accepts(wrong), "{wrong:?} at {mu}");
            }
        }
    }

    /// y_n = μ‖y_t‖ of a slip that is nothing beside its own scale is a velocity of its own.
    #[test]
    fn where_associated_friction_sticks_a_large_coefficient_lifts_nothing() {
        for mu in [2.0, 10.0, 1e3, 1e6, 1e9] {
            let accepts = |free: [f64; 3], impulse: [f64; 3]| {
                let problem = ContactProblem::new(DMatrix::identity(3, 3), DVector::from_row_slice(&free));
                let problem = problem.law(Law::Associated).friction(vec![mu]).build().expect("sizes fit");
                let impulse = DVector::from_row_slice(&impulse);
                let velocity = problem.velocity(&impulse);
                by_contact(&problem, &Solution::new("by hand", impulse, velocity, 0)).expect("sizes fit")[0].accepts(CERTIFY)
            };
            let falls = [-1.0, 0.0, 0.0];
            assert!(accepts(falls, [1.0, 0.0, 0.0]) && accepts(falls, [1.0 + 1e-9, 1e-9 / mu, 0.0]), "{mu}");
            for lift in [1e-7, 1e-4, 1e-2, 1.0] {
                assert!(!accepts(falls, [1.0 + lift, lift / mu, 0.0]), "{lift} m/s at {mu}");
            }
            // at the edge of the cone it slides, however slowly, and opens by it
            for slip in [1e-3, 1e-9] {
                let free = [mu * slip - 1.0, -slip - mu, 0.0];
                assert!(accepts(free, [1.0, mu, 0.0]), "{slip} m/s at {mu}");
            }
            // without an impulse it is open
            assert!(accepts([2.0 * mu, 1.0, 0.0], [0.0; 3]) && accepts([mu, 1.0, 0.0], [0.0; 3]), "{mu}");
        }
    }

    #[test]
    fn a_stored_velocity_that_is_wrong_is_told_at_its_contact() {
        let (problem, right) = points();
        let impulse = DVector::from_row_slice(&right);
        let mut velocity = problem.velocity(&impulse);
        velocity[5] += 0.5;
        let contacts = by_contact(&problem, &Solution::new("by hand", impulse, velocity, 0)).expect("sizes fit");
        assert_eq!([0, 1, 2].map(|k: usize| contacts[k].parts[5].value), [0.0, 0.5, 0.0]);
        assert!(contacts[0].accepts(CERTIFY) && !contacts[1].accepts(CERTIFY));
    }
}
