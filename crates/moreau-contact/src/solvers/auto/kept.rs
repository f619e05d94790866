//! Newton's method from the impulses of the step before.
//!
//! A step changes what some contacts do. Where contacts close, plain sweeps find most of that for the price of a part of one factor; the
//! factor of the first step of Newton's method then serves for most of the others.

use super::super::{ContactSolver, NonsmoothNewton, ProjectedGaussSeidel, workspace};
use super::stages::is_iterated;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::newton::{REUSES, SWEEPS_FROM_KEPT};
use crate::tolerance::solvers::{FEWEST_IN_ISLANDS, SHORT_STEPS};
use nalgebra::DVector;

/// A few sweeps and a few steps from what is kept of the step before; where contacts are few, sweeps end it to the last bit.
pub(super) fn solve(problem: &ContactProblem, kept: &DVector<f64>, stop: f64) -> Option<Solution> {
    if problem.contacts() < FEWEST_IN_ISLANDS || !is_iterated(problem) {
        return None;
    }
    let begun = closes(problem, kept, stop).then(|| swept(problem, kept)).flatten();
    if begun.as_ref().is_some_and(|begun| begun.iterations < SWEEPS_FROM_KEPT) {
        // the last sweep moved nothing
        return begun;
    }
    let newton = NonsmoothNewton { steps: SHORT_STEPS, starts: 1, tolerance: stop, reuses: REUSES, ..Default::default() };
    let ended = newton.solve(problem, Some(begun.as_ref().map_or(kept, |begun| &begun.impulse))).ok();
    let sweeps = begun.map_or(0, |begun| {
        let sweeps = begun.iterations;
        begun.leave();
        sweeps
    });
    ended.map(|ended| Solution { iterations: sweeps + ended.iterations, ..ended })
}

/// Whether a contact closes that was kept open, or pressed too little: for rounding alone sweeps do nothing.
fn closes(problem: &ContactProblem, kept: &DVector<f64>, stop: f64) -> bool {
    let mut memory = workspace::borrow(problem);
    memory.propose(kept.as_slice());
    memory.closes(problem, stop)
}

/// Plain sweeps, of which none is measured; none for a law that they do not solve.
fn swept(problem: &ContactProblem, kept: &DVector<f64>) -> Option<Solution> {
    ProjectedGaussSeidel { sweeps: SWEEPS_FROM_KEPT, tolerance: -1.0, memory: 0 }.solve(problem, Some(kept)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::operator::wall;
    use crate::problem::Law;
    use crate::solvers::watch;
    use crate::tolerance::solvers::{ENOUGH, STOP};

    /// A wall of bricks whose contacts close at 1 m/s, and slip at this speed.
    fn pushed(law: Law, slip: f64) -> ContactProblem {
        let w = wall(3, 3, 1.0);
        let contacts = w.contacts();
        let free = DVector::from_fn(3 * contacts, |row, _| match row % 3 {
            0 => -1.0 - 0.01 * (row % 7) as f64,
            1 => slip,
            _ => 0.1 * slip * (row % 5) as f64,
        });
        ContactProblem::new(w, free).law(law).friction(vec![0.5; contacts]).build().expect("valid")
    }

    #[test]
    fn a_step_that_changes_what_contacts_do_is_solved_from_the_one_before() {
        for law in [Law::Coulomb, Law::Associated] {
            let before = crate::solvers::Auto.solve(&pushed(law, 1.0), None).expect("it has an answer");
            for slip in [1.0 + 1e-12, 1.001, 0.999] {
                let problem = pushed(law, slip);
                let answer = solve(&problem, &before.impulse, STOP).expect("a step from the one before");
                assert!(residuals(&problem, &answer).expect("sizes fit").is_solution(ENOUGH), "{law:?} {slip}");
            }
        }
    }

    /// Where nothing closes Newton's method begins at once; where something does sweeps come first, and few iterates are looked at.
    #[test]
    fn sweeps_are_made_only_where_contacts_close() {
        let problem = pushed(Law::Coulomb, 0.4);
        let answer = crate::solvers::Auto.solve(&problem, None).expect("it has an answer");
        let of = |part: f64| {
            let kept = &answer.impulse * part;
            let (found, seen) = watch::watched(&watch::Interrupt::default(), || solve(&problem, &kept, STOP).expect("solved"));
            assert!(part < 1.0 || residuals(&problem, &found).expect("sizes fit").is_solution(ENOUGH), "{part}");
            (found.iterations, seen.history.len())
        };
        let (few, _) = of(1.0 + 1e-9);
        let (many, looks) = of(0.5);
        assert!(few <= SHORT_STEPS && many > SWEEPS_FROM_KEPT && looks < many - SWEEPS_FROM_KEPT + 1, "{few} {many} {looks}");
    }

    #[test]
    fn contacts_that_are_few_are_left_to_others() {
        let problem = crate::solvers::test_problems::four_corners(Law::Coulomb, 0.1, 0.0);
        assert!(solve(&problem, &DVector::zeros(12), STOP).is_none());
    }
}
