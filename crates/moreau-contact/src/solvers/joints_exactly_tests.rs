//! Drawn problems with joints, decided in fractions in another way: what is told of them as proved is so.

use super::super::{Auto, ContactSolver, Solvers, solve_jointed};
use super::*;
use crate::certificate::feasibility::nonnegative_solution;
use crate::problem::{ConstraintKind, Law};
use moreau_exact::Error;
use moreau_exact::error::Failure;

/// Whole numbers below `most`, from a fixed seed.
fn numbers(mut seed: u64) -> impl FnMut(usize) -> usize {
    move |most| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as usize) % most
    }
}

/// One to three contacts of one row and one to three rods, on a W whose rows often depend on each other but for rounding, or by a little.
fn drawn(seed: u64) -> JointedProblem {
    let mut below = numbers(seed);
    let (contacts, rods, velocities) = (1 + below(3), 1 + below(3), 1 + below(3));
    let mut kinds = vec![ConstraintKind::Contact; contacts];
    kinds.extend(vec![ConstraintKind::Bilateral { rows: 1 }; rods]);
    let size = kinds.len();
    let unit = [1.0, 0.1, 0.25][below(3)];
    let mut jacobian = DMatrix::from_fn(size, velocities, |_, _| unit * [0.0, 1.0, -1.0, 3.0, 0.7][below(5)]);
    if below(2) == 0 {
        // one row is a multiple of another
        let (from, to, times) = (below(size), below(size), [1.0, -1.0, 3.0, 0.1][below(4)]);
        let copied = jacobian.row(from) * times;
        jacobian.row_mut(to).copy_from(&copied);
    }
    let mass = [1.0, 2.0, 3.0, 10.0][below(4)];
    let w = &jacobian * jacobian.transpose() / mass;
    let free = if below(3) > 0 {
        &jacobian * DVector::from_fn(velocities, |_, _| unit * (below(7) as f64 - 3.0))
    } else {
        DVector::from_fn(size, |_, _| unit * (below(5) as f64 - 2.0))
    };
    JointedProblem::new(1, kinds, w, free).unwrap().law(Law::Frictionless, vec![0.0; size]).unwrap()
}

/// Whether W as it is stored has a solution: of every choice of pressed contacts whether impulses of both signs at the rods and ≥ 0 at
/// these contacts leave y = 0 at both and y ≥ 0 elsewhere. Nothing is eliminated.
fn has_solution(problem: &JointedProblem) -> bool {
    let (size, contacts) = (problem.rows(), problem.pushing().len());
    let w = problem.delassus().map(exact);
    (0..1_usize << contacts).any(|pressed| {
        let is_pressed = |k: usize| pressed >> k & 1 == 1;
        let open: Vec<usize> = (0..contacts).filter(|k| !is_pressed(*k)).collect();
        let mut columns: Vec<DVector<Rational>> = (0..contacts).filter(|k| is_pressed(*k)).map(|k| w.column(k).into_owned()).collect();
        columns.extend((contacts..size).flat_map(|rod| [w.column(rod).into_owned(), -w.column(rod)]));
        columns.extend(open.iter().map(|k| DVector::from_fn(size, |row, _| if row == *k { -Rational::ONE } else { Rational::ZERO })));
        let right = -problem.free_velocity().map(exact);
        nonnegative_solution(&DMatrix::from_columns(&columns), &right).point().is_some()
    })
}

#[test]
fn that_there_is_no_solution_is_told_only_where_there_is_none() {
    let (mut told, mut wrongly_of_what_is_left, mut solved) = (0, 0, 0);
    let enumeration = Solvers::own().by_name("enumeration").unwrap();
    for seed in 0..3000 {
        let problem = drawn(seed);
        let Ok(left) = super::super::WithoutJoints::new(&problem) else { continue };
        let has = has_solution(&problem);
        let solvers: [&dyn ContactSolver; 2] = [&Auto, &*enumeration];
        for solver in solvers {
            let word = |answer: &Result<_, Error>| matches!(answer, Err(Error::Solver { failure: Failure::Infeasible, .. }));
            let answer = solve_jointed(&problem, solver, None);
            assert!(!(word(&answer) && has), "{seed}: {answer:?}");
            told += usize::from(word(&answer));
            solved += usize::from(answer.is_ok() && has);
            wrongly_of_what_is_left += usize::from(has && word(&solver.solve(left.contacts(), None)));
        }
        match decided(&problem, left.contacts()) {
            Decided::None(_) => assert!(!has, "{seed}"),
            Decided::Some => assert!(has, "{seed}"),
            Decided::Nothing => {}
        }
    }
    println!("{told} told, {wrongly_of_what_is_left} of what is left alone, {solved} solved");
    assert!(told > 200 && wrongly_of_what_is_left > 20 && solved > 1000, "{told} {wrongly_of_what_is_left} {solved}");
}

#[test]
fn what_is_nearly_dependent_in_doubles_is_solved_in_fractions() {
    // a pin of 1 g on the ground that holds 10⁵ kg: 1e-8 of the second W_ii is left, and both impulses are known by hand
    let pin = |free: DVector<f64>| {
        let w = DMatrix::from_row_slice(2, 2, &[1000.0, -1000.0, -1000.0, 1000.0 + 1.0 / 131_072.0]);
        JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 1 }; 2], w, free).unwrap()
    };
    let held = pin(DVector::from_vec(vec![0.0, -1.0]));
    assert!(super::super::WithoutJoints::new(&held).unwrap_err().to_string().contains("nearly depends"));
    let answer = solve_jointed(&held, &Auto, None).expect("a solution");
    // 1000 (r₁ − r₂) = 0 and r₂/131072 = 1
    assert_eq!(answer.impulse.as_slice(), [131_072.0, 131_072.0]);
    // the same with the first rod twice, whose second impulse is 0, and with a third velocity that no impulse makes of it
    let twice = |third: f64| {
        let rows = [0, 1, 0];
        let w = DMatrix::from_fn(3, 3, |i, j| held.delassus()[(rows[i], rows[j])]);
        let free = DVector::from_vec(vec![0.0, -1.0, third]);
        JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 1 }; 3], w, free).unwrap()
    };
    let answer = solve_jointed(&twice(0.0), &Auto, None).expect("a solution");
    assert!((answer.impulse[0] + answer.impulse[2], answer.impulse[1]) == (131_072.0, 131_072.0), "{}", answer.impulse);
    assert!(matches!(solve_jointed(&twice(0.25), &Auto, None), Err(Error::Invalid { .. })), "refused as before");
}

#[test]
fn joints_whose_w_is_asymmetric_and_has_no_pivot_on_the_diagonal_are_solved() {
    let w = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, -4.0, 0.0]);
    let problem = JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 2 }], w, DVector::from_vec(vec![-3.0, 1.0])).unwrap();
    let answer = solve_jointed(&problem, &Auto, None).expect("a solution");
    assert_eq!(answer.impulse.as_slice(), [0.25, 1.5]);
}
