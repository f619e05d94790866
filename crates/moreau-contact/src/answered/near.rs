//! A solution near an answer, proved, and where the impulses of the answer lie on a border, from others with the same velocity.
//!
//! ```text
//!     r′ ∈ { least norm with u ,  interior points } ,    ‖u(r′) − u‖∞ ≤ d · max(|u|, |u_free|)  [m/s] :
//!     forward from r′, and its distances from (r, u)
//! ```
//! Redundant contacts share a load in many ways, and an answer that leaves one of them without any is on the border between opening and
//! pressing. Which impulses a proof begins from decides only whether it ends; what it proves are distances from the answer.

use crate::certificate::forward::{Forward, forward, forward_from};
use crate::problem::{ContactProblem, Solution};
use crate::solvers::{ContactSolver, InteriorPoint, least_norm};
use crate::tolerance::answered::{NEAR_ROWS, SAME_VELOCITY};
use moreau_exact::Result;
use nalgebra::DVector;

/// Proves that the problem has a solution near an answer, from its impulses or from others with its velocity.
///
/// # Errors
/// Those of [`forward`].
/// ```
/// use moreau_contact::answered::near;
/// use moreau_contact::certificate::forward::forward;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::{ContactProblem, Law, Solution};
///
/// // a beam on three feet; one of them carries nothing, though it might
/// let rows = dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, 1.0];
/// let beam = ContactProblem::from_dynamics(dmatrix![1.0, 0.0; 0.0, 1.0], rows, &dvector![-1.0, 0.0]).rows_per_contact(1);
/// let beam = beam.law(Law::Frictionless).friction(vec![0.0; 3]).build()?;
/// let answer = Solution::new("by hand", dvector![0.5, 0.0, 0.5], dvector![0.0, 0.0, 0.0], 0);
/// assert!(forward(&beam, &answer)?.proved().is_none());
/// assert!(near(&beam, &answer)?.proved().is_some());
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn near(problem: &ContactProblem, answer: &Solution) -> Result<Forward> {
    let first = forward(problem, answer)?;
    if problem.rows() > NEAR_ROWS || matches!(first, Forward::Proved(_)) {
        return Ok(first);
    }
    let others: [&dyn Fn() -> Result<Solution>; 2] = [&|| least_norm(problem, answer), &|| InteriorPoint::default().solve(problem, None)];
    for other in others {
        // that there are no such impulses is no reason against a proof from others
        let Ok(found) = other() else { continue };
        if has_velocity(problem, answer, &found.impulse) {
            let again = forward_from(problem, answer, &found.impulse)?;
            if matches!(again, Forward::Proved(_)) {
                return Ok(again);
            }
        }
    }
    Ok(first)
}

/// Whether impulses give the velocity of the answer.
fn has_velocity(problem: &ContactProblem, answer: &Solution, impulse: &DVector<f64>) -> bool {
    let scale = answer.velocity.amax().max(problem.free_velocity().amax());
    (problem.velocity(impulse) - &answer.velocity).amax() <= SAME_VELOCITY * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::sharpness::{MANY, roundings};
    use nalgebra::{DMatrix, dmatrix, dvector};

    /// A table of mass and moments of inertia 1 on feet at these places of the ground, which lands at 1 m/s.
    fn table(places: &[[f64; 2]], mu: f64) -> ContactProblem {
        let mut jacobian = DMatrix::zeros(3 * places.len(), 6);
        for (k, [x, z]) in places.iter().enumerate() {
            let rows = [[0.0, 1.0, 0.0, *z, 0.0, -x], [1.0, 0.0, 0.0, 0.0, *z, 0.0], [0.0, 0.0, 1.0, 0.0, -x, 0.0]];
            rows.iter().enumerate().for_each(|(i, row)| (0..6).for_each(|j| jacobian[(3 * k + i, j)] = row[j]));
        }
        let free = dvector![0.0, -1.0, 0.0, 0.0, 0.0, 0.0];
        ContactProblem::from_dynamics(DMatrix::identity(6, 6), jacobian, &free).friction(vec![mu; places.len()]).build().unwrap()
    }

    #[test]
    fn a_table_that_stands_on_two_of_its_four_feet_is_proved_from_the_impulses_that_all_of_them_may_have() {
        let square = table(&[[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]], 0.5);
        let mut impulse = DVector::zeros(12);
        (impulse[0], impulse[9]) = (0.5, 0.5);
        let answer = Solution::new("by hand", impulse, DVector::zeros(12), 0);
        assert!(forward(&square, &answer).unwrap().proved().is_none(), "two feet are on a border");
        let radius = near(&square, &answer).unwrap().proved().expect("four feet carry it");
        assert!(radius.worst().unwrap().1 <= roundings(MANY), "{radius:?}");
        // the solution that is proved carries a quarter at each foot, and its distance is said
        assert!(radius.impulse.iter().all(|moved| *moved >= 0.25), "{radius:?}");
    }

    #[test]
    fn an_answer_with_another_velocity_is_not_proved_from_impulses_that_do_not_have_it() {
        let square = table(&[[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]], 0.5);
        for moved in [1e-3, 1e-6] {
            let mut impulse = DVector::zeros(12);
            (impulse[0], impulse[9]) = (0.5 + moved, 0.5 + moved);
            let answer = Solution::new("by hand", impulse.clone(), square.velocity(&impulse), 0);
            let distance = answer.velocity.amax();
            assert!(near(&square, &answer).unwrap().proved().is_none_or(|radius| radius.worst().unwrap().1 >= distance), "{moved}");
        }
    }

    #[test]
    fn no_impulses_save_what_has_no_solution() {
        // two rows are one, and what they close with is not
        let closing = ContactProblem::from_dynamics(dmatrix![1.0], dmatrix![1.0; -1.0], &dvector![-1.0]).rows_per_contact(1);
        let wedged = closing.free_velocity(dvector![-1.0, -1.0]).friction(vec![0.0; 2]).build().unwrap();
        let answer = Solution::new("by hand", dvector![1e6, 1e6], dvector![-1.0, -1.0], 0);
        assert!(near(&wedged, &answer).unwrap().proved().is_none());
    }
}
