//! Answers of several solvers from several starts, always the same ones: where there are several solutions, some of them are met.
//!
//! ```text
//!     from zero:    every solver that takes the law
//!     from r:       s r ,   s (r_n, Q r_t)  with Q a quarter, a half, three quarters of a turn     all contacts together
//!                   r_k = 0 ,   r_k turned ,   r_k = 2 r_k                                          contact by contact
//! ```
//! with r an answer. Every answer is judged; nothing is proved here.

use crate::certificate::residuals;
use crate::problem::{ContactProblem, Solution};
use crate::solvers::Solvers;
use crate::tolerance::answered::{FIRM, STARTED_CONTACTS, STARTED_ROWS};
use nalgebra::DVector;

/// Solvers that are asked from zero, one of each family.
const COLD: [&str; 9] = ["auto", "lemke", "nonsmooth-newton", "interior-point", "convex-subproblems", "admm", "bb", "apgd", "newton"];

/// Solvers that are asked from other starts: those that stay near them.
const WARM: [&str; 2] = ["nonsmooth-newton", "auto"];

/// Certified answers to a problem, in the order of solvers and starts; `given` are answers to start from, too. None for more than
/// [`STARTED_ROWS`] rows.
pub fn from_several_starts(problem: &ContactProblem, given: &[Solution], solvers: &Solvers) -> Vec<Solution> {
    if problem.rows() > STARTED_ROWS {
        return Vec::new();
    }
    let is_firm = |answer: &Solution| residuals(problem, answer).is_ok_and(|residuals| residuals.is_solution(FIRM));
    let ask = |name: &str, start: Option<&DVector<f64>>| solvers.by_name(name).ok()?.solve(problem, start).ok().filter(is_firm);
    let mut found: Vec<Solution> = given.iter().filter(|answer| is_firm(answer)).cloned().collect();
    found.extend(COLD.iter().filter_map(|name| ask(name, None)));
    let bases = different(&found);
    for start in bases.iter().flat_map(|base| starts(problem, &base.impulse)) {
        found.extend(WARM.iter().filter_map(|name| ask(name, Some(&start))));
    }
    found
}

/// One of each velocity, as far as numbers tell.
fn different(answers: &[Solution]) -> Vec<Solution> {
    let mut kept: Vec<Solution> = Vec::new();
    for answer in answers {
        let scale = answer.velocity.amax();
        if kept.iter().all(|other| (&other.velocity - &answer.velocity).amax() > crate::tolerance::answered::DIFFERENT * scale) {
            kept.push(answer.clone());
        }
    }
    kept
}

/// Impulses to start from, made of those of an answer.
fn starts(problem: &ContactProblem, impulse: &DVector<f64>) -> Vec<DVector<f64>> {
    let (rows, contacts) = (problem.rows_per_contact(), problem.contacts());
    let mut made = Vec::new();
    for scale in [0.25, 4.0] {
        made.push(impulse * scale);
    }
    for turns in 1..4 {
        let mut turned = impulse.clone();
        (0..contacts).for_each(|k| turn(turned.as_mut_slice(), k * rows, rows, turns));
        made.push(turned);
    }
    for k in 0..contacts.min(STARTED_CONTACTS) {
        let at = k * rows;
        let mut open = impulse.clone();
        open.rows_mut(at, rows).fill(0.0);
        let mut pressed = impulse.clone();
        pressed[at] = 2.0 * impulse[at].max(impulse.amax() / contacts as f64);
        let mut turned = pressed.clone();
        turn(turned.as_mut_slice(), at, rows, 2);
        made.extend([open, pressed, turned]);
    }
    made
}

/// Turns the tangential impulse of the contact whose first row this is by quarters of a turn; in the plane by halves.
fn turn(impulse: &mut [f64], at: usize, rows: usize, quarters: usize) {
    match rows {
        2 => impulse[at + 1] = -impulse[at + 1],
        3 => {
            for _ in 0..quarters {
                (impulse[at + 1], impulse[at + 2]) = (-impulse[at + 2], impulse[at + 1]);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::several::distinct;
    use crate::certificate::spatial::velocities;
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn painleve_s_three_solutions_are_met_and_one_where_there_is_one() {
        for (free, count) in [([1.0, 4.0], 3), ([-1.0, 1.0], 1)] {
            let w = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
            let rod = ContactProblem::new(w, dvector![free[0], free[1]]).rows_per_contact(2).friction(vec![1.0]).build().unwrap();
            let answers = from_several_starts(&rod, &[], &Solvers::own());
            let again = from_several_starts(&rod, &[], &Solvers::own());
            assert_eq!(answers, again, "the same answers in the same order");
            let found = distinct(&rod, &answers).unwrap();
            assert!(found.len() <= count && (found.len() > 1) == (count > 1), "{free:?}: {found:?}");
        }
    }

    #[test]
    fn no_solver_from_any_start_meets_a_velocity_that_is_not_in_the_list_of_all() {
        // every answer, beside the list: it has no more velocities than the list alone, and fewer are seen if the list is not whole
        let outside = |problem: &ContactProblem, list: &[Solution], answers: &[Solution]| {
            let together: Vec<Solution> = list.iter().chain(answers).cloned().collect();
            distinct(problem, &together).unwrap().len() - list.len()
        };
        let (mut state, mut answered, mut missing) = (3_u64, 0, 0);
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        for (contacts, friction) in [(1, 3.0), (1, 1.5), (1, 3.0), (2, 2.0), (2, 0.75), (2, 3.0), (3, 0.5), (3, 1.5)] {
            let h = DMatrix::from_fn(3 * contacts, 3 * contacts + 1, |_, _| next());
            let free = DVector::from_fn(3 * contacts, |_, _| 2.0 * next());
            let problem = ContactProblem::new(&h * h.transpose(), free).friction(vec![friction; contacts]).build().unwrap();
            let all = velocities(&problem).unwrap();
            assert!(all.exactly().is_some(), "{contacts} {friction} {:?}", all.undecided);
            let list: Vec<Solution> = all.found.into_iter().map(|(answer, _)| answer).collect();
            let answers = from_several_starts(&problem, &[], &Solvers::own());
            answered += answers.len();
            assert_eq!(outside(&problem, &list, &answers), 0, "{contacts} {friction}");
            missing += (0..list.len())
                .map(|left_out| outside(&problem, &[&list[..left_out], &list[left_out + 1..]].concat(), &answers))
                .sum::<usize>();
        }
        assert!(answered > 50 && missing >= 8, "{answered} answers, {missing} missed when one of the list is taken away");
    }

    #[test]
    fn a_turn_keeps_the_length_and_four_quarters_are_none() {
        let mut impulse = [5.0, 3.0, -4.0];
        turn(&mut impulse, 0, 3, 1);
        assert_eq!(impulse, [5.0, 4.0, 3.0]);
        turn(&mut impulse, 0, 3, 3);
        assert_eq!(impulse, [5.0, 3.0, -4.0]);
    }

    #[test]
    fn large_problems_are_left_out() {
        let size = STARTED_ROWS + 3 - STARTED_ROWS % 3;
        let problem = ContactProblem::new(DMatrix::identity(size, size), DVector::from_element(size, -1.0));
        let problem = problem.friction(vec![0.5; size / 3]).build().unwrap();
        assert!(from_several_starts(&problem, &[], &Solvers::own()).is_empty());
    }
}
