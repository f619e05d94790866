//! Newton's method from the impulses of the step before.
//!
//! A step changes what some contacts do. Where contacts close, plain sweeps find most of that for the price of a part of one factor; the
//! factor of the first step of Newton's method then serves for most of the others.
//!
//! A pile at rest hardly changes from step to step, and a factor of it costs hundreds of sweeps: there sweeps are measured, and one or two
//! end most steps that kept impulses do not.

use super::super::{ContactSolver, NonsmoothNewton, ProjectedGaussSeidel, workspace};
use super::stages::{is_iterated, is_taken_in_rounds};
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::newton::{CONTACTS_OF_A_SWEEP, REUSES, SWEEPS_FROM_KEPT};
use crate::tolerance::solvers::{FEWEST_IN_ISLANDS, SHORT_STEPS};
use nalgebra::DVector;

/// A few sweeps and a few steps from what is kept of the step before; where contacts are few, sweeps end it to the last bit.
pub(super) fn solve(problem: &ContactProblem, kept: &DVector<f64>, stop: f64) -> Option<Solution> {
    if problem.contacts() < FEWEST_IN_ISLANDS || !is_iterated(problem) {
        return None;
    }
    let (most, begun) = if is_taken_in_rounds(problem) {
        let most = problem.contacts() / CONTACTS_OF_A_SWEEP;
        (most, measured(problem, kept, stop, most))
    } else {
        (SWEEPS_FROM_KEPT, closes(problem, kept, stop).then(|| swept(problem, kept)).flatten())
    };
    if begun.as_ref().is_some_and(|begun| begun.iterations < most) {
        // the last sweep moved nothing, or what was measured is small enough
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

/// Plain sweeps until what is left is at most `stop`, for problems in which a factor costs as much as hundreds of them.
fn measured(problem: &ContactProblem, kept: &DVector<f64>, stop: f64, most: usize) -> Option<Solution> {
    ProjectedGaussSeidel { sweeps: most, tolerance: stop, ..Default::default() }.solve(problem, Some(kept)).ok()
}

/// Plain sweeps, of which none is measured; none for a law that they do not solve.
fn swept(problem: &ContactProblem, kept: &DVector<f64>) -> Option<Solution> {
    ProjectedGaussSeidel { sweeps: SWEEPS_FROM_KEPT, tolerance: -1.0, memory: 0 }.solve(problem, Some(kept)).ok()
}

#[cfg(test)]
mod tests {
    use super::super::rounds::in_rounds;
    use super::*;
    use crate::certificate::residuals;
    use crate::operator::{BlockSparse, wall};
    use crate::problem::Law;
    use crate::solvers::watch;
    use crate::tolerance::newton::{FIRST_ROUND, ROUNDS};
    use crate::tolerance::solvers::{ENOUGH, STOP};
    use nalgebra::{DMatrix, Vector3};

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

    /// Balls of 1 kg in layers, each on three of the layer below or on the floor, that fall together at 1 m/s and jostle each other: three
    /// contacts and six velocities each.
    fn fallen(side: usize, layers: usize) -> ContactProblem {
        let (place, floor) = (|x: usize, y: usize, z: usize| (z * side + y) * side + x, [0.0, 0.0, 1.0]);
        let mut contacts: Vec<([f64; 3], [Option<usize>; 2])> = Vec::new();
        for (x, y, z) in (0..side * side * layers).map(|k| (k % side, k / side % side, k / (side * side))) {
            let ball = Some(place(x, y, z));
            match z.checked_sub(1) {
                None => (0..3).for_each(|_| contacts.push((floor, [ball, None]))),
                Some(below) => {
                    for (i, j) in [(0, 0), (1, 0), (0, 1)] {
                        let towards = [0.5 - i as f64, 0.5 - j as f64, 0.5f64.sqrt()];
                        let length = towards.iter().map(|x| x * x).sum::<f64>().sqrt();
                        let other = Some(place((x + i) % side, (y + j) % side, below));
                        contacts.push((towards.map(|x| x / length), [ball, other]));
                    }
                }
            }
        }
        // n, t₁ and t₂ with what each moves of a ball of radius ½ whose moment of inertia is 0.1 kg m²: e and arm × e
        let rows = |normal: &[f64; 3]| {
            let normal = Vector3::from(*normal);
            let across = normal.cross(&Vector3::new(1.0, 0.3, 0.0)).normalize();
            [normal, across, normal.cross(&across)]
        };
        let moved = |one: &[f64; 3], other: &[f64; 3], signs: f64| {
            let (a, b) = (rows(one), rows(other));
            let turned = |normal: &[f64; 3], e: &Vector3<f64>| (Vector3::from(*normal) * -0.5).cross(e);
            // a contact turns both of its balls the same way
            DMatrix::from_fn(3, 3, |i, j| signs * a[i].dot(&b[j]) + turned(one, &a[i]).dot(&turned(other, &b[j])) * 10.0)
        };
        let mut blocks = Vec::new();
        for (i, (one, own)) in contacts.iter().enumerate() {
            for (j, (other, theirs)) in contacts.iter().enumerate() {
                let of = |ball: Option<usize>, pair: &[Option<usize>; 2]| ball.and_then(|_| pair.iter().position(|b| *b == ball));
                let shared = own.iter().enumerate().filter_map(|(a, ball)| of(*ball, theirs).map(|b| if a == b { 1.0 } else { -1.0 }));
                let block = shared.map(|signs| moved(one, other, signs)).reduce(|one, other| one + other);
                blocks.extend(block.map(|block| (i, j, block)));
            }
        }
        let w = BlockSparse::new(3, contacts.len(), blocks).expect("blocks of these contacts");
        let free = DVector::from_fn(3 * contacts.len(), |row, _| {
            let (normal, pair) = &contacts[row / 3];
            let falls = if pair[1].is_none() { -rows(normal)[row % 3][2] } else { 0.0 };
            falls + 0.02 * ((row * row) % 17) as f64 - 0.16
        });
        let contacts = w.contacts();
        ContactProblem::new(w, free).friction(vec![0.5; contacts]).build().expect("valid")
    }

    #[test]
    fn what_falls_together_is_taken_in_rounds_where_there_are_many_contacts_and_few_of_a_body() {
        let problem = fallen(6, 4);
        let zero = DVector::zeros(problem.rows());
        let answer = in_rounds(&problem, &zero, [FIRST_ROUND, ROUNDS], [STOP, ENOUGH]).expect("some hundred contacts");
        let relative = |answer: &Solution| residuals(&problem, answer).expect("sizes fit").judged.relative();
        assert!(relative(&answer) <= ENOUGH, "{:e}", relative(&answer));
        let short = solve(&problem, &zero, STOP).expect("some hundred contacts");
        assert!(relative(&short) > ENOUGH, "what a few steps solve tests nothing");
        for start in [None, Some(&zero)] {
            assert!(crate::solvers::Auto.solve(&problem, start).is_ok_and(|answer| relative(&answer) <= ENOUGH));
        }
        let few = fallen(3, 2);
        assert!(!is_taken_in_rounds(&few));
    }

    /// Balls in layers whose loads have changed by a millionth: from the impulses before a few sweeps end it to a tolerance ten times as
    /// small, and no factor is made.
    #[test]
    fn a_pile_that_hardly_changes_is_ended_by_a_few_sweeps() {
        let problem = fallen(6, 4);
        let before = crate::solvers::Auto.solve(&problem, Some(&DVector::zeros(problem.rows()))).expect("it has an answer");
        let kept = DVector::from_fn(problem.rows(), |row, _| before.impulse[row] * (1.0 + 1e-6 * ((row * row) % 7) as f64));
        let relative = |solution: &Solution| residuals(&problem, solution).expect("sizes fit").judged.relative();
        let tolerance = 1e-7;
        assert!(relative(&Solution::new("kept", kept.clone(), problem.velocity(&kept), 0)) > tolerance, "kept impulses are no answer");
        let answer = solve(&problem, &kept, tolerance).expect("some hundred contacts");
        assert!(relative(&answer) <= tolerance, "{:e}", relative(&answer));
        assert!(answer.solver == "pgs" && answer.iterations < problem.contacts() / CONTACTS_OF_A_SWEEP, "{}", answer.iterations);
    }

    #[test]
    fn contacts_that_are_few_are_left_to_others() {
        let problem = crate::solvers::test_problems::four_corners(Law::Coulomb, 0.1, 0.0);
        assert!(solve(&problem, &DVector::zeros(12), STOP).is_none());
    }
}
