//! Equations of sliding that depend exactly on each other: under the associated law in the plane, on edges and on sides of polygons.

use super::tests::{is_exact, table};
use super::*;
use crate::certificate::planted::with;
use crate::problem::Law;
use crate::tolerance::sharpness::{MANY, REDUNDANT, roundings};
use moreau_exact::scalar::exact;

const MU: f64 = 0.5;
const SQUARE: [Law; 2] = [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 4 }];

/// A body of unit mass, and moment of inertia ½, on four feet at heights of their own.
fn beam() -> (DMatrix<f64>, DMatrix<f64>) {
    let feet = [[-1.0, 0.5], [-0.5, 0.25], [0.5, 0.5], [1.0, 0.75]];
    let rows = feet.into_iter().flat_map(|[x, height]| [[0.0, 1.0, x], [1.0, 0.0, height]]);
    (DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 1.0, 0.5])), DMatrix::from_row_iterator(8, 3, rows.flatten()))
}

/// A problem whose bodies have these velocities under these impulses, with its solution, exact in numbers; posed by M̂ and H or by W.
fn posed(
    made: [&DMatrix<f64>; 2],
    moved: &[f64],
    impulse: DVector<f64>,
    shift: DVector<f64>,
    law: Law,
    by_mass: bool,
) -> (ContactProblem, Solution) {
    let [mass, jacobian] = made;
    let moved = DVector::from_row_slice(moved);
    let pushed = jacobian.tr_mul(&impulse);
    let free = DVector::from_fn(moved.len(), |i, _| moved[i] - pushed[i] / mass[(i, i)]);
    let (rows, contacts) = (jacobian.nrows() / 4, 4);
    let build = |made: crate::problem::ContactProblemBuilder| {
        made.rows_per_contact(rows).law(law).friction(vec![MU; contacts]).shift(shift.clone()).build().expect("sizes fit")
    };
    let problem = build(ContactProblem::from_dynamics(mass.clone(), jacobian.clone(), &free));
    let problem = if by_mass { problem } else { build(ContactProblem::new(problem.dense().clone(), problem.free_velocity().clone())) };
    let velocity = jacobian * moved;
    let answer = Solution::new("by construction", impulse, velocity, 0);
    assert!(is_exact(&problem, &answer));
    (problem, answer)
}

/// The beam as it slides forth and rises as the associated law asks, one foot with this shift.
fn sliding_beam(shift: [f64; 2], by_mass: bool) -> (ContactProblem, Solution) {
    let (mass, jacobian) = beam();
    let impulse = DVector::from_iterator(8, [1.0, 2.0, 1.5, 0.5].into_iter().flat_map(|n| [n, -MU * n]));
    let mut all = DVector::zeros(8);
    all.rows_mut(2, 2).copy_from_slice(&shift);
    posed([&mass, &jacobian], &[2.0, 1.0, 0.0], impulse, all, Law::Associated, by_mass)
}

/// The table as it slides along x, on an edge, or along both axes, on a side; a foot with this shift.
fn sliding_table(law: Law, diagonal: bool, shift: [f64; 3], by_mass: bool) -> (ContactProblem, Solution) {
    let probe = table(MU, [0.0; 6], 0.0);
    let made = probe.dynamics().expect("it is made of them");
    let parts = if diagonal { [0.25, 0.5, 0.75, 0.5] } else { [1.0; 4] };
    let normals = [1.0, 0.5, 1.5, 1.0].into_iter().zip(parts);
    let impulse = DVector::from_iterator(12, normals.flat_map(|(n, part)| [n, -MU * n * part, -MU * n * (1.0 - part)]));
    let lift = if law == SQUARE[1] { MU } else { 0.0 };
    let moved = [1.0, f64::from(u8::from(diagonal)), lift, 0.0, 0.0, 0.0];
    let mut all = DVector::zeros(12);
    all.rows_mut(3, 3).copy_from_slice(&shift);
    posed([&made.mass, &made.jacobian], &moved, impulse, all, law, by_mass)
}

/// The radius of an answer that is exact, all sliding.
fn proved((problem, answer): (ContactProblem, Solution)) -> Option<Radius> {
    let radius = forward(&problem, &answer).expect("finite numbers").proved()?;
    assert_eq!(radius.states, [ContactState::Sliding; 4]);
    assert!(radius.velocity.iter().all(|bound| *bound <= 4.0 * roundings(MANY)), "{radius:?}");
    Some(radius)
}

#[test]
fn feet_that_slide_and_rise_depend_on_each_other_in_the_plane() {
    for by_mass in [true, false] {
        // v_n − μ v_t of all feet is a line over x − μ h: two of four say the others
        for shift in [[0.0, 0.0], [MU * 0.25, 0.25]] {
            let radius = proved(sliding_beam(shift, by_mass)).expect("it slides");
            assert_eq!(radius.dependent.len(), 2, "{shift:?}");
        }
        let (problem, answer) = sliding_beam([-MU * 0.25, 0.25], by_mass);
        let Forward::NotProved(reason) = forward(&problem, &answer).expect("finite numbers") else { panic!("inconsistent") };
        assert!(reason.text.contains("free velocities"), "{reason:?}");
    }
}

#[test]
fn edges_and_sides_of_polygons_depend_on_each_other() {
    for (law, by_mass) in SQUARE.into_iter().flat_map(|law| [(law, true), (law, false)]) {
        let lift = |along: f64| if law == SQUARE[1] { MU * along } else { 0.0 };
        for shift in [[0.0; 3], [lift(0.25), 0.25, 0.0]] {
            let radius = proved(sliding_table(law, false, shift, by_mass)).expect("it slides on an edge");
            assert_eq!(radius.dependent.len(), 1, "{law:?}: four normals, three motions");
        }
        for shift in [[0.0; 3], [lift(0.25), 0.25, 0.25]] {
            let radius = proved(sliding_table(law, true, shift, by_mass)).expect("it slides on a side");
            assert_eq!(radius.dependent.len(), 3, "{law:?}: four normals and four directions across, five motions");
        }
        let (problem, answer) = sliding_table(law, true, [lift(0.25), 0.25, 0.5], by_mass);
        assert!(forward(&problem, &answer).expect("finite numbers").proved().is_none(), "{law:?}: a foot turns");
    }
}

#[test]
fn impulses_of_feet_that_slide_on_a_side_are_within_the_radius_wherever_the_answer_is() {
    for law in SQUARE {
        let (problem, solution) = sliding_table(law, true, [0.0; 3], true);
        let mut answer = solution.clone();
        answer.impulse.iter_mut().enumerate().for_each(|(row, r)| *r += REDUNDANT[1] * (row as f64 - 5.0));
        answer.velocity = problem.velocity(&answer.impulse);
        let radius = forward(&problem, &answer).expect("finite numbers").proved().expect("it slides");
        // all solutions have one velocity, in fractions
        for k in 0..4 {
            let apart = (3 * k..3 * k + 3).map(|row| exact(answer.velocity[row]) - exact(solution.velocity[row]));
            let square = apart.fold(exact(0.0), |sum, apart| sum + apart.clone() * apart);
            assert!(exact(radius.velocity[k]) * exact(radius.velocity[k]) >= square, "{law:?} {k}");
        }
    }
}

/// How often what is known is contradicted: a solution that is not proved, or a problem that is taken for consistent.
fn contradicted() -> usize {
    let is_proved =
        |(problem, answer): &(ContactProblem, Solution)| matches!(forward(problem, answer).expect("finite numbers"), Forward::Proved(_));
    let right = [sliding_beam([MU * 0.25, 0.25], true), sliding_table(SQUARE[0], true, [0.0, 0.25, 0.25], true)];
    let wrong = [sliding_beam([-MU * 0.25, 0.25], true), sliding_table(SQUARE[0], true, [0.0, 0.25, -0.25], true)];
    right.iter().filter(|one| !is_proved(one)).count() + wrong.iter().filter(|one| is_proved(one)).count()
}

#[test]
fn mistakes_in_the_equations_of_sliding_are_contradicted() {
    assert_eq!(with(None, contradicted), 0);
    for plant in [Plant::Way, Plant::Rank] {
        let caught = with(Some(plant), contradicted);
        assert!(caught > 0, "{plant:?}");
    }
}
