//! The sweeps by hand, against Lemke, and what they refuse.

use super::*;
use moreau_contact::certificate::{natural_map, residuals};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::solvers::{LemkePivoting, largest_eigenvalue_bound};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_contact::tolerance::solvers as tolerance;
use moreau_exact::tolerance::rounding;
use nalgebra::{DMatrix, dvector};

fn problem(law: Law, rows: usize, friction: f64, delassus: DMatrix<f64>, free: DVector<f64>) -> ContactProblem {
    let contacts = free.len() / rows;
    ContactProblem::new(delassus, free)
        .name("sweeps")
        .law(law)
        .rows_per_contact(rows)
        .friction(vec![if law == Law::Frictionless { 0.0 } else { friction }; contacts])
        .build()
        .unwrap()
}

/// So many sweeps from zero, whatever the residual.
fn swept(problem: &ContactProblem, sweeps: usize) -> DVector<f64> {
    let solver = SequentialImpulses { sweeps, warm_start: 0.0, residual: -1.0 };
    solver.solve(problem, None).expect("a law it takes").impulse
}

/// n equal masses pressed against each other and a wall: W = tridiag(−1, 2, −1), contact k between k and k + 1.
fn chain(contacts: usize) -> ContactProblem {
    let delassus = DMatrix::from_fn(contacts, contacts, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    problem(Law::Frictionless, 1, 0.0, delassus, DVector::from_element(contacts, -1.0))
}

#[test]
fn a_sweep_takes_all_normals_in_order_and_then_friction_bounded_by_them() {
    // D = 2; first r_n = 1/2 and (3 − 1/2)/2 = 5/4, then y_t = 4 + 1/2 + 5/4 asks for −23/8 ≤ −μ/2
    let delassus = DMatrix::from_row_slice(4, 4, &[2.0, 1.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 1.0, 2.0, 1.0, 0.0, 0.0, 1.0, 2.0]);
    let planar = problem(Law::Coulomb, 2, 0.5, delassus, dvector![-1.0, 4.0, -3.0, 0.0]);
    // the last row's y_t = r_n₂ = 5/4 asks for −5/8, its bound
    assert_eq!(swept(&planar, 1), dvector![0.5, -0.25, 1.25, -0.625]);
}

#[test]
fn the_box_brakes_both_axes_by_mu_and_the_cone_brakes_along_the_slip() {
    let mu = 0.25;
    let of = |law, tangents: [f64; 2]| {
        let free = dvector![-1.0, tangents[0], tangents[1]];
        let r = swept(&problem(law, 3, if law == Law::Coulomb { mu } else { mu * 2f64.sqrt() }, DMatrix::identity(3, 3), free), 1);
        [r[1], r[2]]
    };
    let square = Law::PolyhedralCoulomb { directions: 4 };
    let close = |found: [f64; 2], expected: [f64; 2]| {
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() <= rounding(16, 1.0)), "{found:?} against {expected:?}");
    };
    // the box's own axes lie at ±45°: slip along t₁ is at its corner, slip along an axis in the middle of its side
    close(of(square, [3.0, 0.0]), [-mu * 2f64.sqrt(), 0.0]);
    close(of(square, [3.0, 3.0]), [-mu / 2f64.sqrt(), -mu / 2f64.sqrt()]);
    close(of(Law::Coulomb, [3.0, 0.0]), [-mu, 0.0]);
    close(of(Law::Coulomb, [3.0, 4.0]), [-mu * 0.6, -mu * 0.8]);
}

#[test]
fn the_error_of_a_chain_shrinks_by_cos_squared_pi_over_n_plus_1_per_sweep() {
    let (n, chain) = (5, chain(5));
    // every contact is pressed: W r = 1, r_k = k (n + 1 − k)/2
    let exact = DVector::from_fn(n, |k, _| 0.5 * ((k + 1) * (n - k)) as f64);
    let errors: Vec<f64> = (0..40).map(|sweeps| (swept(&chain, sweeps) - &exact).norm()).collect();
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    let rate = (std::f64::consts::PI / (n + 1) as f64).cos().powi(2);
    // the second rate is cos²(2π/6) = 1/4 against 3/4: thirty sweeps on it is (1/3)³⁰ of the first
    assert!(
        (errors[39] / errors[38] - rate).abs() <= 3f64.powi(-30) + rounding(64 * 40, 1.0) / errors[39],
        "{} {rate}",
        errors[39] / errors[38]
    );
}

#[test]
fn a_warm_start_takes_its_share_of_the_normals_and_stays_at_the_solution() {
    let chain = chain(4);
    let solution = swept(&chain, 500);
    let from = |warm_start, sweeps| {
        let solver = SequentialImpulses { sweeps, warm_start, residual: -1.0 };
        solver.solve(&chain, Some(&solution)).expect("a law it takes").impulse
    };
    assert_eq!(from(0.85, 0), &solution * 0.85);
    assert!((from(1.0, 1) - &solution).amax() <= rounding(16, 4.0));
    assert!((from(0.85, 3) - &solution).norm() < 0.2 * (from(0.0, 3) - &solution).norm());
    let planar = problem(Law::Coulomb, 2, 0.5, DMatrix::identity(2, 2), dvector![-1.0, 9.0]);
    let solver = SequentialImpulses { sweeps: 0, warm_start: 0.85, residual: 0.0 };
    assert_eq!(solver.solve(&planar, Some(&dvector![2.0, -1.0])).expect("a law it takes").impulse, dvector![1.7, 0.0]);
}

#[test]
fn the_residual_ends_the_sweeps() {
    let solver = SequentialImpulses { sweeps: 1000, warm_start: 0.0, residual: BULLET_RESIDUAL };
    let iterations = solver.solve(&chain(4), None).expect("a law it takes").iterations;
    let change = |sweeps| 2.0 * (swept(&chain(4), sweeps) - swept(&chain(4), sweeps - 1)).amax();
    assert!(change(iterations).powi(2) <= BULLET_RESIDUAL && change(iterations - 1).powi(2) > BULLET_RESIDUAL, "{iterations}");
}

#[test]
fn the_box_of_a_contact_that_was_pressed_for_one_sweep_keeps_its_friction_and_the_cone_does_not() {
    // the second contact lifts the first: r_n = (1, 19/2) after one sweep, (0, 10) in the end
    let mut delassus = DMatrix::identity(6, 6);
    (delassus[(0, 3)], delassus[(3, 0)]) = (0.5, 0.5);
    let free = dvector![-1.0, 3.0, 0.0, -10.0, 0.0, 0.0];
    let cone = problem(Law::Coulomb, 3, 0.5, delassus.clone(), free.clone());
    assert_eq!(swept(&cone, 50), dvector![0.0, 0.0, 0.0, 10.0, 0.0, 0.0]);
    let square = problem(Law::PolyhedralCoulomb { directions: 4 }, 3, 0.5, delassus, free);
    let solver = SequentialImpulses { sweeps: 50, warm_start: 0.0, residual: 0.0 };
    let kept = solver.solve(&square, None).expect("a law it takes");
    assert!(kept.impulse[0] == 0.0 && (kept.impulse[1] + 0.5).abs() <= rounding(16, 1.0), "{}", kept.impulse);
    assert!(!residuals(&square, &kept).expect("finite").is_solution(CERTIFY));
    let right = LemkePivoting.solve(&square, None).expect("solvable");
    assert!((right.impulse - dvector![0.0, 0.0, 0.0, 10.0, 0.0, 0.0]).amax() <= rounding(64, 10.0));
}

#[test]
fn the_cone_is_scaled_along_the_diagonal_s_slip_which_is_coulomb_s_where_the_diagonal_is_isotropic() {
    let (mu, free) = (0.1, dvector![-1.0, 3.0, 4.0]);
    let answer = |own: f64| {
        let one = problem(Law::Coulomb, 3, mu, DMatrix::from_diagonal(&dvector![1.0, own, 1.0]), free.clone());
        let solver = SequentialImpulses { sweeps: 200, warm_start: 0.0, residual: 0.0 };
        let solution = solver.solve(&one, None).expect("a law it takes");
        (solution.impulse.clone(), residuals(&one, &solution).expect("finite").is_solution(CERTIFY), solution.velocity)
    };
    let (_, solved, _) = answer(1.0);
    assert!(solved);
    // with D = (4, 1) friction opposes D⁻¹u: r₁/r₂ = u₁/(4 u₂)
    let (r, solved, u) = answer(4.0);
    assert!(!solved && (r[1] * 4.0 * u[2] - r[2] * u[1]).abs() <= rounding(64, 4.0), "{r}{u}");
}

#[test]
fn other_laws_are_refused_by_name() {
    for (law, word) in [(Law::Associated, "associated"), (Law::PolyhedralCoulomb { directions: 8 }, "square")] {
        let other = problem(law, 3, 0.5, DMatrix::identity(3, 3), dvector![-1.0, 0.0, 0.0]);
        let message = SequentialImpulses::default().solve(&other, None).expect_err("refused").to_string();
        assert!(message.contains("sequential-impulses") && message.contains(word), "{message}");
    }
}

/// Three contacts on twelve velocities with masses from 1 to 2, from a fixed list of numbers; one velocity opens every contact.
fn scattered(seed: u64) -> ContactProblem {
    let mut state = seed;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let jacobian = DMatrix::from_fn(9, 12, |row, column| match (column, row % 3) {
        (0, 0) => 1.0,
        (0, _) => 0.0,
        _ => number(),
    });
    let mass = DMatrix::from_diagonal(&DVector::from_fn(12, |_, _| 1.5 + 0.5 * number()));
    let mut free = DVector::from_fn(12, |_, _| number());
    free[0] = -1.0;
    let w = delassus(&mass, &jacobian).expect("a positive mass");
    problem(Law::PolyhedralCoulomb { directions: 4 }, 3, 0.2, w, &jacobian * free)
}

#[test]
fn they_answer_the_square_as_lemke_does_unless_a_contact_keeps_friction_without_a_normal_impulse() {
    let (mut same, mut kept) = (0, 0);
    for seed in 0..60 {
        let problem = scattered(seed);
        let sweeps = SequentialImpulses { sweeps: 20_000, residual: 0.0, ..SequentialImpulses::default() };
        let solution = sweeps.solve(&problem, None).expect("a law it takes");
        let stale = solution.impulse.as_slice().chunks(3).any(|r| r[0] == 0.0 && (r[1] != 0.0 || r[2] != 0.0));
        let found = residuals(&problem, &solution).expect("finite");
        assert_eq!(found.is_solution(CERTIFY), !stale, "seed {seed}");
        if stale {
            kept += 1;
            continue;
        }
        let other = LemkePivoting.solve(&problem, None).expect("a solution");
        let residual = found.natural_map + residuals(&problem, &other).expect("finite").natural_map;
        let impulses = (&solution.impulse - &other.impulse).norm() + residual;
        let rho = natural_map::scales(&problem).into_iter().fold(f64::INFINITY, f64::min);
        let noise = rounding(problem.rows(), problem.dense().norm() * solution.impulse.norm());
        let bound = tolerance::agreement(largest_eigenvalue_bound(&problem.law_delassus().unwrap()), residual, impulses, rho) + noise;
        let difference = (&solution.velocity - &other.velocity).norm();
        assert!(difference <= bound, "seed {seed}: {difference:e} > {bound:e}");
        same += 1;
    }
    assert!(same >= 30 && kept >= 1, "{same} agree, {kept} keep friction");
}

#[test]
fn sweeps_whose_word_to_end_is_given_move_nothing_and_say_so() {
    use moreau_contact::solvers::watch::{Interrupt, watched};
    let interrupt = Interrupt::default();
    interrupt.now();
    let (impulse, seen) = watched(&interrupt, || swept(&chain(5), 3));
    assert!(seen.interrupted && impulse == DVector::zeros(5));
}
