//! The last judgement of this thread: a step whose answer its solver had judged is certified by the same judgement, not by a second one of
//! the same bits.
//!
//! It is kept by the judge and by nobody else, so that no solver can say what its answer is worth; and it is of one problem and one answer:
//! another problem, or another number in r or u, is judged.

use super::judged::Judged;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::solvers::KEPT;
use std::cell::RefCell;

/// What was judged last.
#[derive(Default)]
struct Last {
    /// The number of the problem, if anything was judged.
    problem: Option<u64>,
    impulse: Vec<f64>,
    velocity: Vec<f64>,
    judged: Judged,
}

thread_local! {
    static LAST: RefCell<Last> = RefCell::default();
}

/// Whether a judgement may be kept: r and u are all that was judged, and they are not too many.
fn is_kept(problem: &ContactProblem, solution: &Solution) -> bool {
    problem.contacts() <= KEPT && solution.beta.is_none() && solution.sigma.is_none()
}

/// Keeps a judgement.
pub(super) fn remember(problem: &ContactProblem, solution: &Solution, judged: Judged) {
    if !is_kept(problem, solution) {
        return;
    }
    // at the end of a thread there may be nothing left to keep it
    let _ = LAST.try_with(|last| {
        let last = &mut *last.borrow_mut();
        (last.problem, last.judged) = (Some(problem.number()), judged);
        for (kept, numbers) in [(&mut last.impulse, &solution.impulse), (&mut last.velocity, &solution.velocity)] {
            kept.clear();
            kept.extend_from_slice(numbers.as_slice());
        }
    });
}

/// The judgement of this answer to this problem, if it was the last one.
pub(super) fn recall(problem: &ContactProblem, solution: &Solution) -> Option<Judged> {
    let is_same = |last: &Last| {
        last.problem == Some(problem.number())
            && last.impulse == solution.impulse.as_slice()
            && last.velocity == solution.velocity.as_slice()
    };
    let found = LAST.try_with(|last| {
        let last = last.borrow();
        is_same(&last).then_some(last.judged)
    });
    found.ok().flatten().filter(|_| is_kept(problem, solution))
}

#[cfg(test)]
mod tests {
    use super::super::Judge;
    use super::*;
    use nalgebra::{DMatrix, DVector, dvector};

    fn falling() -> ContactProblem {
        ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap()
    }

    /// What a mistaken memory would say of another answer or another problem: each is planted by asking for it right after the answer that
    /// is kept.
    #[test]
    fn another_answer_or_another_problem_is_judged() {
        let (problem, right) = (falling(), Solution::new("", dvector![1.0, -0.5], dvector![0.0, 1.5], 0));
        let judged = Judge::default().judge(&problem, &right).unwrap();
        assert_eq!((judged.relative(), recall(&problem, &right)), (0.0, Some(judged)));
        assert_eq!(recall(&problem.clone(), &right), Some(judged), "a copy is the same problem");
        let mut softer = problem.clone();
        softer.soften(dvector![1.0, 1.0], DVector::zeros(2));
        assert!(recall(&softer, &right).is_none() && recall(&falling(), &right).is_none());
        let above = |x: f64| f64::from_bits(x.to_bits() + 1);
        for (impulse, velocity) in [(dvector![above(1.0), -0.5], dvector![0.0, 1.5]), (dvector![1.0, -0.5], dvector![0.0, above(1.5)])] {
            assert!(recall(&problem, &Solution::new("", impulse, velocity, 0)).is_none());
        }
        let mut with_speeds = right.clone();
        with_speeds.sigma = Some(dvector![0.0]);
        assert!(recall(&problem, &with_speeds).is_none());
        let wrong = Solution::new("", dvector![0.0, 0.0], dvector![-1.0, 2.0], 0);
        let judged = Judge::default().judge_once(&problem, &wrong).unwrap();
        assert!(judged.relative() > 0.1 && judged == Judge::default().judge(&problem, &wrong).unwrap());
        assert!(recall(&problem, &right).is_none(), "only the last one is kept");
    }
}
