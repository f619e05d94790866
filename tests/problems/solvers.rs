//! Every solver on every problem of its kind: an answer that is certified, or an honest status.

use super::{is_campaign, stored};
use moreau::certificate::residuals;
use moreau::problems::{Ended, Known, solution};
use moreau::solvers::Solvers;
use moreau::tolerance::certificate::CERTIFY;
use moreau::{ContactProblem, Error, Solution};

/// Contacts of the problems that every solver is asked by default.
const ASKED: usize = 8;
/// Iterations of a solver that has a limit: honest statuses need no patience.
const ITERATIONS: usize = 300;

/// Whether an answer is certified; that there is none must be the solver's own word.
pub fn accepted(problem: &ContactProblem, answer: &moreau::Result<Solution>) -> bool {
    match answer {
        Ok(answer) => residuals(problem, answer).is_ok_and(|judged| judged.is_solution(CERTIFY)),
        Err(Error::Solver { reason, .. }) => {
            assert!(!reason.is_empty());
            false
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn every_solver_answers_certified_or_says_honestly_that_it_does_not() {
    let (most, solvers) = (if is_campaign() { 100 } else { ASKED }, Solvers::own());
    let (mut solved, mut asked) = (0, 0);
    for (_, problem, record) in stored(most) {
        let known: Vec<Solution> = record.answers.iter().map(|answer| solution(&problem, &record, answer)).collect();
        let scale = known.iter().map(|one| one.velocity.amax()).fold(problem.free_velocity().amax(), f64::max);
        for name in solvers.names() {
            let solver = solvers.with_iterations(name, Some(ITERATIONS)).or_else(|_| solvers.by_name(name)).expect("listed");
            let answer = solver.solve(&problem, None);
            let takes = solver.takes(problem.law(), problem.rows_per_contact(), problem.asymmetry() == 0.0);
            asked += usize::from(takes);
            if !accepted(&problem, &answer) {
                continue;
            }
            solved += 1;
            assert!(record.uniqueness.velocity != Known::None, "{name} on {}: there is no solution", record.name);
            let answer = answer.expect("accepted");
            if record.uniqueness.velocity == Known::Unique || record.uniqueness.count.is_some() {
                let distance = known.iter().map(|one| (&one.velocity - &answer.velocity).amax()).fold(f64::INFINITY, f64::min);
                assert!(distance <= 1e-4 * scale, "{name} on {}: u differs by {distance} m/s", record.name);
            }
        }
    }
    assert!(2 * solved > asked, "{solved} of {asked}: the test looks at little");
}

/// Which of these points press is decided by a hundred millionth of the speed; algorithms that go by residuals end in front of it.
#[test]
fn boxes_that_slide_on_points_all_but_in_a_plane_are_solved_by_auto_and_not_by_what_it_begins_with() {
    let solvers = Solvers::own();
    let (mut slides, mut failed) = (0, 0);
    for (_, problem, record) in stored(12).filter(|(_, _, record)| record.group == "uneven") {
        slides += 1;
        let solved = |name: &str| accepted(&problem, &solvers.by_name(name).expect("listed").solve(&problem, None));
        assert!(solved("auto"), "{}", record.name);
        failed += ["pgs", "nonsmooth-newton", "proximal-newton"].into_iter().filter(|name| !solved(name)).count();
    }
    assert_eq!(slides, 6);
    // all 18 here; the last bits of another processor may lead one of them to the end
    assert!(failed >= 12, "{failed} of 18: they are no longer hard");
}

#[test]
fn the_records_say_of_no_solver_that_it_solved_what_has_no_solution() {
    let mut unsolvable = 0;
    for (_, _, record) in stored(usize::MAX) {
        if record.uniqueness.velocity == Known::None {
            unsolvable += 1;
            assert!(record.solvers.iter().all(|outcome| outcome.ended != Ended::Solved), "{}", record.name);
        }
    }
    assert!(unsolvable >= 5, "{unsolvable} problems without a solution");
}
