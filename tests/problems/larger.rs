//! Every solver, and what may not change an answer, on problems of twenty to sixty contacts; those that are stored and asked by default
//! have at most eight.

use super::metamorphic::velocity;
use super::piles::{is_convex, stored_in_turn};
use super::solvers::accepted;
use super::stored;
use super::transform::{in_units, select, selected};
use moreau::ContactProblem;
use moreau::solvers::{ALL, Auto, ContactSolver, NonsmoothNewton};
use nalgebra::DVector;

/// Iterations of a solver that has a limit.
const ITERATIONS: usize = 100;
/// Difference of two accepted velocities, of the largest one.
const SAME: f64 = 1e-5;

/// The largest velocity that is given or found.
fn scale(problem: &ContactProblem, velocity: &DVector<f64>) -> f64 {
    problem.free_velocity().amax().max(velocity.amax())
}

#[test]
fn every_solver_answers_a_pile_certified_or_says_honestly_that_it_does_not() {
    let (mut solved, mut asked) = (0, 0);
    for problem in stored_in_turn([7, 4, 14]) {
        assert!((20..=60).contains(&problem.contacts()), "{}: {} contacts", problem.name(), problem.contacts());
        let mut known: Option<DVector<f64>> = None;
        for name in ALL.names() {
            let solver = ALL.with_iterations(name, Some(ITERATIONS)).or_else(|_| ALL.by_name(name)).expect("listed");
            let answer = solver.solve(&problem, None);
            let is_accepted = accepted(&problem, &answer);
            let takes = solver.takes(problem.law(), problem.rows_per_contact(), true);
            assert!(takes || !is_accepted, "{name} on {}: it says that it does not take it", problem.name());
            asked += usize::from(takes);
            if !is_accepted {
                assert!(name != "auto", "{}: {answer:?}", problem.name());
                continue;
            }
            solved += 1;
            let answer = answer.expect("accepted").velocity;
            if is_convex(problem.law()) {
                let apart = known.as_ref().map_or(0.0, |known| (known - &answer).amax());
                assert!(apart <= SAME * scale(&problem, &answer), "{name} on {}: u differs by {apart} m/s", problem.name());
                known = Some(answer);
            }
        }
    }
    assert!(2 * solved > asked, "{solved} of {asked}: the test looks at little");
}

#[test]
fn the_order_units_and_a_contact_that_stands_twice_change_nothing_in_a_pile() {
    for problem in stored_in_turn([5, 3, 10]) {
        let n = problem.contacts();
        assert!((15..=25).contains(&n), "{}: {n} contacts", problem.name());
        let before = velocity(&problem).unwrap_or_else(|| panic!("{}: no answer", problem.name()));
        // 7 has no factor in common with the numbers of contacts
        let shuffled: Vec<usize> = (0..n).map(|k| (7 * k + 3) % n).collect();
        let twice: Vec<usize> = (0..n).chain([n / 2]).collect();
        let orders = [("in another order", shuffled), ("one twice", twice)];
        let mut others: Vec<_> =
            orders.map(|(what, order)| (what, selected(&problem, &order), select(&problem, &order, &before))).into_iter().collect();
        others.push(("in other units", in_units(&problem, 1e-3, 1e3), &before * 1e-3));
        for (what, other, wanted) in others {
            let after = velocity(&other).unwrap_or_else(|| panic!("{}, {what}: no answer", problem.name()));
            let apart = (&after - &wanted).amax();
            // Coulomb's law may have several velocities
            let is_same = !is_convex(problem.law()) || apart <= SAME * scale(&other, &wanted);
            assert!(is_same, "{}, {what}: u differs by {apart} m/s", problem.name());
        }
    }
}

/// The four that the equations end.
const UNEVEN: [&str; 4] = ["uneven-8", "uneven-9", "uneven-10", "uneven-11"];

/// Boxes that slide on points all but in a plane: at these all starts of Newton's method fail, one after the other, and Fischer and
/// Burmeister's equations end them before the first one would have failed.
#[test]
fn what_newtons_method_fails_at_is_ended_before_all_of_its_starts() {
    let mut seen = 0;
    for (_, problem, _) in stored(11).filter(|(stored, ..)| UNEVEN.contains(&stored.name)) {
        let newton = NonsmoothNewton::default().solve(&problem, None);
        if accepted(&problem, &newton) {
            continue;
        }
        let (auto, newton) = (Auto.solve(&problem, None), newton.expect("an answer that is refused"));
        assert!(accepted(&problem, &auto), "{}", problem.name());
        let taken = auto.expect("accepted").iterations;
        assert!(taken < newton.iterations, "{}: {taken} of {}", problem.name(), newton.iterations);
        seen += 1;
    }
    assert!(seen >= 3, "{seen} such problems");
}
