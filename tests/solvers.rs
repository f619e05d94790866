//! Every solver says beforehand what it is for, and refuses the rest as such.

use moreau::contact::delassus::delassus;
use moreau::error::Failure;
use moreau::problem::{Compliance, Coordinates, Dynamics};
use moreau::solvers::watch::{Interrupt, watched};
use moreau::solvers::{ALL, ContactSolver};
use moreau::{ContactProblem, Error, Law};
use nalgebra::{DMatrix, DVector};

const CONTACTS: usize = 2;

/// Two contacts on six velocities that close at 1 m/s while they slide; hard.
fn hard(law: Law, rows: usize, symmetric: bool) -> ContactProblem {
    let jacobian = DMatrix::from_fn(rows * CONTACTS, 6, |i, j| if i == j { 1.0 } else { 0.1 * ((i + 2 * j) % 3) as f64 });
    let mass = DMatrix::from_diagonal(&DVector::from_fn(6, |k, _| 1.0 + k as f64 / 8.0));
    let mut w = delassus(&mass, &jacobian).expect("a positive mass");
    let dynamics = symmetric.then_some(Dynamics { mass, jacobian });
    if !symmetric {
        w[(0, rows)] += 1.0 / 8.0;
        w[(rows, 0)] -= 1.0 / 8.0;
    }
    ContactProblem::new(w, DVector::from_fn(rows * CONTACTS, |row, _| if row % rows == 0 { -1.0 } else { 0.5 }))
        .name("two")
        .law(law)
        .rows_per_contact(rows)
        .friction(vec![if law == Law::Frictionless { 0.0 } else { 0.5 }; CONTACTS])
        .dynamics(dynamics)
        .build()
        .unwrap()
}

/// The problem hard, with compliance of its rows and, where its law has edges, with compliance of these.
fn variants(law: Law, rows: usize, symmetric: bool) -> Vec<ContactProblem> {
    let soft = |coordinates, entries: usize| {
        hard(law, rows, symmetric)
            .into_builder()
            .compliance(Compliance { coordinates, diagonal: DVector::from_element(CONTACTS * entries, 0.25) })
            .build()
            .unwrap()
    };
    let edges = match law {
        Law::PolyhedralAssociated { directions } => Some(soft(Coordinates::Edge, directions)),
        _ => None,
    };
    [hard(law, rows, symmetric), soft(Coordinates::Contact, rows)].into_iter().chain(edges).collect()
}

/// Whether the solver refuses it as a problem that is not for it; it may answer or end in another way.
fn refuses(solver: &dyn ContactSolver, problem: &ContactProblem) -> bool {
    matches!(solver.solve(problem, None), Err(Error::Solver { failure: Failure::Refused, .. }))
}

#[test]
fn a_solver_refuses_what_it_does_not_take_and_takes_some_problem_of_each_kind_that_it_does() {
    let (mut taken, mut left) = (0, 0);
    for name in ALL.names() {
        let solver = ALL.by_name(name).expect("listed");
        for rows in [2, 3] {
            let directions = if rows == 2 { 2 } else { 4 };
            let polyhedral = [Law::PolyhedralCoulomb { directions }, Law::PolyhedralAssociated { directions }];
            for law in [Law::Frictionless, Law::Coulomb, Law::Associated].into_iter().chain(polyhedral) {
                for symmetric in [true, false] {
                    let refused: Vec<_> = variants(law, rows, symmetric).iter().map(|one| refuses(solver.as_ref(), one)).collect();
                    let takes = solver.takes(law, rows, symmetric);
                    let kept = if takes { !refused.iter().all(|no| *no) } else { refused.iter().all(|no| *no) };
                    assert!(kept, "{name}, {law:?}, {rows} rows, symmetric: {symmetric}: takes {takes}, refuses {refused:?}");
                    if takes { taken += 1 } else { left += 1 }
                }
            }
        }
    }
    assert!(taken > 50 && left > 50, "{taken} kinds taken, {left} left");
}

#[test]
fn a_solver_that_is_ended_at_once_gives_an_answer_of_the_problem_s_size_or_none() {
    let ended = Interrupt::default();
    ended.now();
    let mut answers = 0;
    for (law, rows) in [(Law::Frictionless, 3), (Law::Coulomb, 2), (Law::Coulomb, 3), (Law::Associated, 3)] {
        for problem in variants(law, rows, true) {
            for name in ALL.names() {
                let (answer, _) = watched(&ended, || ALL.by_name(name).expect("listed").solve(&problem, None));
                if let Ok(answer) = answer {
                    assert_eq!((answer.impulse.len(), answer.velocity.len()), (problem.rows(), problem.rows()), "{name}, {law:?}");
                    answers += 1;
                }
            }
        }
    }
    assert!(answers > 40, "{answers}");
}

#[test]
fn a_ray_a_breakdown_and_a_refusal_are_told_apart() {
    let ended = |name: &str, problem: &ContactProblem| match ALL.by_name(name).expect("listed").solve(problem, None) {
        Err(Error::Solver { failure, solver, .. }) if solver == name => failure,
        other => panic!("{name}: {other:?}"),
    };
    let points = |w: &[f64]| {
        let (delassus, free_velocity) = (DMatrix::from_diagonal(&DVector::from_row_slice(w)), DVector::from_element(w.len(), -1.0));
        ContactProblem::new(delassus, free_velocity).name("points").law(Law::Frictionless).rows_per_contact(1).build().unwrap()
    };
    // W = 0 stops nothing; a mass of 1e320 kg needs an impulse beyond the numbers
    assert_eq!(ended("lemke", &points(&[0.0])), Failure::Ray);
    assert_eq!(ended("clarabel", &points(&[0.0, 1.0])), Failure::Ray);
    assert_eq!(ended("pgs", &points(&[1e-320])), Failure::Breakdown);
    assert_eq!(ended("pgs", &points(&[0.0])), Failure::Refused);
    assert_eq!(ended("lemke", &hard(Law::Coulomb, 3, true)), Failure::Refused);
}

#[test]
fn a_start_changes_the_way_of_those_solvers_that_take_one_and_of_no_other() {
    let problems: Vec<_> = [(Law::Frictionless, 1), (Law::Coulomb, 2), (Law::Associated, 3)]
        .into_iter()
        .flat_map(|(law, rows)| variants(law, rows, true).into_iter())
        .collect();
    for name in ALL.names() {
        let solver = ALL.by_name(name).expect("listed");
        let changes = problems.iter().any(|problem| {
            let Ok(cold) = solver.solve(problem, None) else { return false };
            // the answer itself, and far from it
            let far = DVector::from_fn(problem.rows(), |row, _| if row % problem.rows_per_contact() == 0 { 3.0 } else { 0.125 });
            [cold.impulse.clone(), far].iter().any(|start| match solver.solve(problem, Some(start)) {
                Ok(warm) => (warm.iterations, &warm.impulse) != (cold.iterations, &cold.impulse),
                Err(_) => true,
            })
        });
        assert_eq!(changes, solver.takes_start(), "{name}");
    }
}
