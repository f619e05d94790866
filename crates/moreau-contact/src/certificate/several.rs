//! Solutions that are proved to be different: answers whose enclosures in u are disjoint.
//!
//! ```text
//!     ‖u − u′‖ > ε_k + ε′_k  at some contact k     ⟹     the solutions near the two answers have different velocities
//! ```
//! with the radii ε of [`forward`]. Of k answers any two of which are apart, k solutions with different velocities are near: *at least k*.

use super::forward::{Forward, Radius, forward};
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::proof::{AGAIN, enlarged};
use moreau_exact::Result;

/// An answer with a solution near that none of the others has.
#[derive(Clone, Debug, PartialEq)]
pub struct Distinct {
    /// Its place among the answers.
    pub answer: usize,
    /// How far its solution is at most.
    pub radius: Radius,
}

/// Answers near which there are solutions with different velocities, as many as one pass through them finds.
///
/// # Errors
/// As [`forward`].
/// ```
/// use moreau_contact::certificate::several::distinct;
/// use moreau_contact::nalgebra::{DMatrix, DVector, dvector};
/// use moreau_contact::{ContactProblem, Solution};
///
/// // Painlevé: a normal impulse pushes it along twice as much as away
/// let rod = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]), dvector![1.0, 4.0]);
/// let rod = rod.rows_per_contact(2).friction(vec![1.0]).build()?;
/// let answer = |r: DVector<f64>| Solution::new("by hand", r.clone(), rod.velocity(&r), 0);
/// let open = || answer(dvector![0.0, 0.0]);
/// assert_eq!(distinct(&rod, &[open(), open(), answer(dvector![3.0, -2.0])])?.len(), 2); // it lifts off, or is jammed
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn distinct(problem: &ContactProblem, answers: &[Solution]) -> Result<Vec<Distinct>> {
    let mut found: Vec<Distinct> = Vec::new();
    let mut tried: Vec<usize> = Vec::new();
    let near = |one: &Solution, other: &Solution| {
        let scale = one.velocity.amax().max(problem.free_velocity().amax());
        (&one.velocity - &other.velocity).amax() <= AGAIN * scale
    };
    for (place, answer) in answers.iter().enumerate() {
        // what was proved already, or failed to be, is not tried again
        if tried.iter().any(|other| near(answer, &answers[*other])) {
            continue;
        }
        tried.push(place);
        let Forward::Proved(radius) = forward(problem, answer)? else { continue };
        if found.iter().all(|other| apart(problem.rows_per_contact(), [answer, &answers[other.answer]], [&radius, &other.radius])) {
            found.push(Distinct { answer: place, radius });
        }
    }
    Ok(found)
}

/// Whether the enclosures of two answers are disjoint at some contact.
pub(super) fn apart(rows: usize, answers: [&Solution; 2], radii: [&Radius; 2]) -> bool {
    let [one, other] = answers.map(|answer| &answer.velocity);
    (0..radii[0].velocity.len()).any(|k| {
        let difference = (k * rows..(k + 1) * rows).fold(0.0_f64, |sum, row| sum.hypot(one[row] - other[row]));
        // the difference is rounded a few times, far below the half of it
        0.5 * difference > enlarged(radii[0].velocity[k] + radii[1].velocity[k], 2)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::patterns::solutions;
    use moreau_exact::scalar::Scalar;
    use nalgebra::{DMatrix, DVector};

    /// Two rods of Painlevé beside each other that hardly feel each other.
    fn rods(free: [f64; 4]) -> ContactProblem {
        let mut w = DMatrix::zeros(4, 4);
        for k in [0, 2] {
            w.view_mut((k, k), (2, 2)).copy_from(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]));
        }
        (w[(0, 2)], w[(2, 0)]) = (1.0 / 16.0, 1.0 / 16.0);
        ContactProblem::new(w, DVector::from_row_slice(&free)).rows_per_contact(2).friction(vec![1.0; 2]).build().unwrap()
    }

    fn answer(problem: &ContactProblem, impulse: DVector<f64>) -> Solution {
        let velocity = problem.velocity(&impulse);
        Solution::new("", impulse, velocity, 0)
    }

    #[test]
    fn as_many_are_apart_as_all_patterns_find_and_never_more_of_answers_that_repeat_or_are_moved() {
        for free in [[1.0, 4.0, 1.0, 4.0], [-1.0, 1.0, 1.0, 4.0], [-1.0, 1.0, -1.0, 1.0]] {
            let problem = rods(free);
            let all = solutions(&problem).unwrap();
            assert!(all.continuum.is_none());
            let mut answers: Vec<Solution> =
                all.found.iter().map(|one| answer(&problem, one.impulse.map(|r| Scalar::to_f64(&r)))).collect();
            for moved in answers.clone() {
                for part in [1.0 + 1e-12, 1.0 + 1e-5, 1.001, 0.0] {
                    answers.push(answer(&problem, &moved.impulse * part));
                }
            }
            answers.push(answer(&problem, DVector::from_element(4, 0.3)));
            let found = distinct(&problem, &answers).unwrap();
            assert_eq!(found.len(), all.found.len(), "{free:?}: {found:?}");
            answers.reverse();
            assert!(distinct(&problem, &answers).unwrap().len() <= all.found.len());
        }
    }

    #[test]
    fn enclosures_that_meet_are_one_solution() {
        let problem = rods([-1.0, 1.0, -1.0, 1.0]);
        let one = answer(&problem, solutions(&problem).unwrap().found[0].impulse.map(|r| Scalar::to_f64(&r)));
        let radius = forward(&problem, &one).unwrap().proved().unwrap();
        let mut other = one.clone();
        other.velocity[1] += 1.0;
        let wide = |velocity: f64| Radius { velocity: vec![velocity; 2], ..radius.clone() };
        // planted: radii that reach each other, in every way
        assert!(apart(2, [&one, &other], [&radius, &radius]));
        assert!(!apart(2, [&one, &other], [&wide(0.3), &wide(0.3)]) && !apart(2, [&one, &other], [&wide(0.6), &radius]));
        assert!(!apart(2, [&one, &one], [&radius, &radius]));
    }
}
