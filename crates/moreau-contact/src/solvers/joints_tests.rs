//! Joints against closed forms, exact rationals and a convex program over all impulses; redundant and contradicting ones.

use super::super::{Auto, Solvers};
use super::*;
use crate::certificate::joints::jointed_residuals;
use crate::contact::delassus::delassus;
use crate::problem::{ConstraintKind, Law};
use crate::tolerance::certificate::CERTIFY;
use moreau_exact::elimination::solve;
use moreau_exact::error::Failure;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use nalgebra::{dmatrix, dvector};

const CONTACT: ConstraintKind = ConstraintKind::Contact;
const LIMIT: ConstraintKind = ConstraintKind::Limit;

fn bilateral(rows: usize) -> ConstraintKind {
    ConstraintKind::Bilateral { rows }
}

/// Rows of H on velocities of this mass, with these free velocities.
fn mechanism(kinds: Vec<ConstraintKind>, rows: usize, mass: &DMatrix<f64>, jacobian: &DMatrix<f64>, free: &DVector<f64>) -> JointedProblem {
    JointedProblem::new(rows, kinds, delassus(mass, jacobian).unwrap(), jacobian * free).unwrap()
}

fn certified(problem: &JointedProblem, solver: &dyn ContactSolver) -> Solution {
    let answer = solve_jointed(problem, solver, None).unwrap();
    let found = jointed_residuals(problem, &answer).unwrap();
    assert!(found.is_solution(CERTIFY), "{}: {found:?}", solver.name());
    answer
}

/// A bob of 2 kg at (−3, 1) m/s on a rod along (3, 4)/5 hits a wall with normal (1, 0): the rod and the wall stop it.
fn bob() -> JointedProblem {
    let rows = dmatrix![1.0, 0.0; 0.6, 0.8];
    let problem = mechanism(vec![CONTACT, bilateral(1)], 1, &(DMatrix::identity(2, 2) * 2.0), &rows, &dvector![-3.0, 1.0]);
    problem.law(Law::Frictionless, vec![0.0; 2]).unwrap()
}

#[test]
fn a_bob_on_a_rod_that_hits_a_wall_is_stopped_by_both() {
    // r_n (1, 0) + r_b (3, 4)/5 = −m v = (6, −2): r_b = −2.5, r_n = 6 + 1.5
    let answer = certified(&bob(), &Auto);
    assert!((&answer.impulse - dvector![7.5, -2.5]).amax() < 1e-14 && answer.velocity.amax() < 1e-14, "{answer:?}");
}

#[test]
fn a_bob_that_swings_away_from_the_wall_is_held_by_the_rod_alone() {
    // v = (3, 1): along the rod 13/5, so r_b = −2 · 13/5, and u_n = 3 − 13/5 · 3/5
    let rows = dmatrix![1.0, 0.0; 0.6, 0.8];
    let problem = mechanism(vec![CONTACT, bilateral(1)], 1, &(DMatrix::identity(2, 2) * 2.0), &rows, &dvector![3.0, 1.0]);
    let answer = certified(&problem, &Auto);
    assert!((&answer.impulse - dvector![0.0, -5.2]).amax() < 1e-14, "{answer:?}");
    assert!((&answer.velocity - dvector![3.0 - 2.6 * 0.6, 0.0]).amax() < 1e-14);
}

/// Two bars of 2 m, 1 kg and 2 kg, hinged at the top, lean on each other at 3:4 with their feet on the floor: masses, rows of the feet
/// (normal, tangent) and of the hinge, all rational.
fn roof() -> (DMatrix<Rational>, DMatrix<Rational>) {
    let q = ratio;
    let masses = [q(1, 1), q(1, 1), q(1, 3), q(2, 1), q(2, 1), q(2, 3)];
    let mass = DMatrix::from_fn(6, 6, |i, j| if i == j { masses[i].clone() } else { q(0, 1) });
    // the point c + (a, b) moves with (v_x − ω b, v_z + ω a)
    let rows = [
        [q(0, 1), q(1, 1), q(-4, 5), q(0, 1), q(0, 1), q(0, 1)],
        [q(1, 1), q(0, 1), q(3, 5), q(0, 1), q(0, 1), q(0, 1)],
        [q(0, 1), q(0, 1), q(0, 1), q(0, 1), q(1, 1), q(4, 5)],
        [q(0, 1), q(0, 1), q(0, 1), q(1, 1), q(0, 1), q(3, 5)],
        [q(1, 1), q(0, 1), q(-3, 5), q(-1, 1), q(0, 1), q(3, 5)],
        [q(0, 1), q(1, 1), q(4, 5), q(0, 1), q(-1, 1), q(4, 5)],
    ];
    (mass, DMatrix::from_fn(6, 6, |i, j| rows[i][j].clone()))
}

/// v and r with M (v − v_free) = Hᵀr and H v = 0 for these rows, in fractions: no Delassus operator is formed and no row eliminated.
fn held(
    mass: &DMatrix<Rational>,
    jacobian: &DMatrix<Rational>,
    rows: &[usize],
    free: &DVector<Rational>,
) -> Option<[DVector<Rational>; 2]> {
    let (n, m) = (mass.nrows(), rows.len());
    let system = DMatrix::from_fn(n + m, n + m, |i, j| match (i < n, j < n) {
        (true, true) => mass[(i, j)].clone(),
        (true, false) => -jacobian[(rows[j - n], i)].clone(),
        (false, true) => jacobian[(rows[i - n], j)].clone(),
        (false, false) => Rational::ZERO,
    });
    let momentum = mass * free;
    let right = DVector::from_fn(n + m, |i, _| if i < n { momentum[i].clone() } else { Rational::ZERO });
    let found = solve(&system, &right)?;
    Some([DVector::from_fn(n, |i, _| found[i].clone()), DVector::from_fn(m, |i, _| found[n + i].clone())])
}

fn floats(matrix: &DMatrix<Rational>) -> DMatrix<f64> {
    matrix.map(|x| Scalar::to_f64(&x))
}

#[test]
fn a_roof_of_two_bars_that_lands_without_friction_is_the_one_in_fractions() {
    let (mass, rows) = roof();
    let frictionless = [0, 2, 4, 5].map(|row| rows.row(row).into_owned());
    let jacobian = DMatrix::from_rows(&frictionless);
    let kinds = vec![CONTACT, CONTACT, bilateral(2)];
    let (mut lands, mut leaves) = (0, 0);
    for k in 0..27_i64 {
        let free = DVector::from_vec((0..6).map(|i| ratio((k * (i + 3) + 5 * i) % 9 - 5, 4)).collect::<Vec<_>>());
        // every pattern of the feet; the right one is the only one with r ≥ 0 and u ≥ 0
        let mut solutions = Vec::new();
        for pattern in [vec![2, 3], vec![0, 2, 3], vec![1, 2, 3], vec![0, 1, 2, 3]] {
            let Some([velocity, impulse]) = held(&mass, &jacobian, &pattern, &free) else { continue };
            let u = &jacobian * &velocity;
            let pushes = pattern.iter().zip(impulse.iter()).all(|(row, r)| *row >= 2 || *r >= Rational::ZERO);
            if pushes && u.iter().all(|u| *u >= Rational::ZERO) {
                let full =
                    DVector::from_fn(4, |row, _| pattern.iter().position(|at| *at == row).map_or(0.0, |at| Scalar::to_f64(&impulse[at])));
                solutions.push((u, full, pattern.len()));
            }
        }
        let (u, impulse, size) = solutions.first().expect("W is positive definite").clone();
        if size > 2 {
            lands += 1
        } else {
            leaves += 1
        }
        let free = free.map(|x| Scalar::to_f64(&x));
        let problem = mechanism(kinds.clone(), 1, &floats(&mass), &floats(&jacobian), &free).law(Law::Frictionless, vec![0.0; 3]).unwrap();
        for name in ["auto", "lemke", "pgs", "murty", "nonsmooth-newton"] {
            let answer = certified(&problem, &*Solvers::own().by_name(name).unwrap());
            assert!((&answer.velocity - u.map(|x| Scalar::to_f64(&x))).amax() < 1e-8, "{name}, {k}");
            assert!((&answer.impulse - &impulse).amax() < 1e-7, "{name}, {k}: {} {impulse}", answer.impulse);
        }
    }
    assert!(lands > 5 && leaves > 0, "{lands} land, {leaves} do not");
}

#[test]
fn a_roof_that_sticks_under_coulomb_s_law_has_the_impulses_in_fractions() {
    let (mass, jacobian) = roof();
    let free = DVector::from_vec([0, -1, 0, 0, -1, 0].map(|x| ratio(x, 1)).to_vec());
    let [_, impulse] = held(&mass, &jacobian, &[0, 1, 2, 3, 4, 5], &free).expect("six rows on six velocities");
    let impulse = impulse.map(|x| Scalar::to_f64(&x));
    let (needed, mu) = ((impulse[1] / impulse[0]).abs().max((impulse[3] / impulse[2]).abs()), 2.0);
    assert!(impulse[0] > 0.0 && impulse[2] > 0.0 && needed < mu, "it sticks: {impulse}");
    let problem = mechanism(vec![CONTACT, CONTACT, bilateral(2)], 2, &floats(&mass), &floats(&jacobian), &free.map(|x| Scalar::to_f64(&x)));
    let answer = certified(&problem.law(Law::Coulomb, vec![mu, mu, 0.0]).unwrap(), &Auto);
    assert!((&answer.impulse - &impulse).amax() < 1e-12 && answer.velocity.amax() < 1e-12, "{} {impulse}", answer.impulse);
    // with less than is needed it slides apart, and the impulses differ
    let problem = mechanism(vec![CONTACT, CONTACT, bilateral(2)], 2, &floats(&mass), &floats(&jacobian), &free.map(|x| Scalar::to_f64(&x)));
    let slides = certified(&problem.law(Law::Coulomb, vec![0.5 * needed, 0.5 * needed, 0.0]).unwrap(), &Auto);
    assert!(slides.velocity.amax() > 0.1);
}

#[test]
fn all_bilateral_and_one_body_need_no_solver() {
    let weld = JointedProblem::new(
        3,
        vec![bilateral(2), bilateral(1)],
        dmatrix![2.0, 1.0, 0.0; 1.0, 2.0, 1.0; 0.0, 1.0, 2.0],
        dvector![1.0, 0.0, -1.0],
    );
    let answer = certified(&weld.unwrap(), &Auto);
    assert!((&answer.impulse - dvector![-0.5, 0.0, 0.5]).amax() < 1e-15 && answer.iterations == 0);
    let nothing = JointedProblem::new(3, Vec::new(), DMatrix::zeros(0, 0), DVector::zeros(0)).unwrap();
    assert_eq!(certified(&nothing, &Auto).impulse.len(), 0);
    let free = JointedProblem::new(3, vec![CONTACT], DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).unwrap();
    let answer = certified(&free.law(Law::Coulomb, vec![0.5]).unwrap(), &Auto);
    assert!((&answer.impulse - dvector![1.0, -0.5, 0.0]).amax() < 1e-14, "without joints it is the contact problem");
}

#[test]
fn a_hinge_at_its_stop_beside_a_spatial_contact_is_a_limit() {
    // 3 kg on a slider whose stop it reaches at 2 m/s, and 1 kg that slides on the floor
    let kinds = vec![LIMIT, CONTACT];
    let w = DMatrix::from_diagonal(&dvector![1.0 / 3.0, 1.0, 1.0, 1.0]);
    for (speed, stop) in [(-2.0, 6.0), (2.0, 0.0)] {
        let problem = JointedProblem::new(3, kinds.clone(), w.clone(), dvector![speed, -1.0, 2.0, 0.0]).unwrap();
        let problem = problem.law(Law::Coulomb, vec![0.0, 0.5]).unwrap();
        for name in ["auto", "pgs", "admm", "nonsmooth-newton", "interior-point"] {
            let answer = certified(&problem, &*Solvers::own().by_name(name).unwrap());
            assert!((&answer.impulse - dvector![stop, 1.0, -0.5, 0.0]).amax() < 1e-7, "{name}: {}", answer.impulse);
        }
    }
}

#[test]
fn a_joint_that_repeats_another_takes_no_impulse_and_the_velocity_is_the_same() {
    let rows = dmatrix![1.0, 0.0; 0.6, 0.8; 0.3, 0.4; 0.6, 0.8];
    let (mass, free) = (DMatrix::identity(2, 2) * 2.0, dvector![-3.0, 1.0]);
    let problem = mechanism(vec![CONTACT, bilateral(1), bilateral(2)], 1, &mass, &rows, &free);
    let left = WithoutJoints::new(&problem).unwrap();
    assert_eq!(left.dependent().len(), 2);
    let answer = certified(&problem, &Auto);
    assert!(answer.velocity.amax() < 1e-14 && (answer.impulse[0] - 7.5).abs() < 1e-13);
}

#[test]
fn joints_that_contradict_each_other_or_nearly_depend_are_refused_by_name() {
    let twice = |second: f64, asked: f64| {
        let w = dmatrix![1.0, 0.6, 0.6; 0.6, 1.0, second; 0.6, second, 1.0];
        let problem = JointedProblem::new(1, vec![CONTACT, bilateral(1), bilateral(1)], w, dvector![-1.0, 0.5, asked]).unwrap();
        WithoutJoints::new(&problem).map(|left| left.dependent().len()).map_err(|error| error.to_string())
    };
    assert_eq!(twice(1.0, 0.5), Ok(1));
    assert_eq!(twice(0.9, 0.25), Ok(0));
    let contradiction = twice(1.0, 0.25).expect_err("0.25 m/s apart");
    assert!(
        contradiction.contains("kinds[2]")
            && contradiction.contains("has a row that depends on other bilateral rows and contradicts them by 0.25 m/s"),
        "{contradiction}"
    );
    // of a joint of several rows it is said which
    let w = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 1.0; 0.0, 1.0, 1.0];
    let of_two = JointedProblem::new(1, vec![bilateral(1), bilateral(2)], w, dvector![0.5, 0.5, -1.5]).unwrap();
    let second = WithoutJoints::new(&of_two).map(|_| ()).expect_err("2 m/s apart").to_string();
    assert!(second.contains("`kinds[1]`: has a row, the second of its 2, that depends") && second.contains("by 2 m/s"), "{second}");
    let nearly = twice(1.0 - 1e-10, 0.5).expect_err("10 digits alike");
    assert!(nearly.contains("kinds[2]") && nearly.contains("nearly depends"), "{nearly}");
    // a row that moves others and has no W_ii of its own
    let skew = JointedProblem::new(1, vec![CONTACT, bilateral(1)], dmatrix![1.0, -1.0; 1.0, 0.0], dvector![-1.0, 0.5]).unwrap();
    assert!(WithoutJoints::new(&skew).expect_err("no pivot").to_string().contains("semidefinite"));
}

#[test]
fn a_contact_that_joints_hold_fast_is_open_or_has_no_solution() {
    let held = |free: f64| JointedProblem::new(1, vec![CONTACT, bilateral(1)], dmatrix![1.0, 1.0; 1.0, 1.0], dvector![free, free]).unwrap();
    assert!(certified(&held(-1.0), &Auto).velocity.amax() < 1e-15, "the joint stops it");
    let pushed = held(-1.0).shift(dvector![-0.5, 0.0]).unwrap();
    assert!(solve_jointed(&pushed, &Auto, None).map_or(true, |answer| !jointed_residuals(&pushed, &answer).unwrap().is_solution(CERTIFY)));
}

/// Uniform numbers in \[−1, 1) from a fixed seed.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 11) as f64) / (1u64 << 52) as f64 - 1.0
    }
}

/// Spatial contacts, limits and joints of all sizes on 24 velocities, in any order.
fn random(seed: u64, law: Law) -> JointedProblem {
    let kinds = vec![bilateral(3), CONTACT, LIMIT, bilateral(6), CONTACT, CONTACT, bilateral(1), LIMIT];
    let mut next = numbers(seed);
    let rows = 3 + 3 + 1 + 6 + 3 + 3 + 1 + 1;
    let mut jacobian = DMatrix::from_fn(rows, 24, |_, _| next());
    let mass = DMatrix::from_fn(24, 24, |i, j| if i == j { 1.0 + 0.9 * next() } else { 0.0 });
    let free = DVector::from_fn(24, |_, _| next());
    // units of angles and of light joints do not decide what is independent
    jacobian.row_mut(2).scale_mut(1e-4);
    jacobian.row_mut(9).scale_mut(1e4);
    let friction = kinds.iter().map(|kind| if *kind == CONTACT && law != Law::Frictionless { 0.5 } else { 0.0 }).collect();
    mechanism(kinds, 3, &mass, &jacobian, &free).law(law, friction).unwrap()
}

#[test]
fn every_solver_takes_a_problem_with_joints_or_refuses_it_by_name() {
    let mut taken = std::collections::BTreeSet::new();
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 4 }] {
        for seed in 1..6 {
            let problem = random(seed, law);
            let reference = certified(&problem, &Auto);
            for name in Solvers::own().names() {
                match solve_jointed(&problem, &*Solvers::own().by_name(name).unwrap(), None) {
                    Ok(answer) => {
                        let found = jointed_residuals(&problem, &answer).unwrap();
                        if found.is_solution(CERTIFY) {
                            taken.insert(name);
                            if law.is_convex() {
                                assert!((&answer.velocity - &reference.velocity).amax() < 1e-6, "{name} {law:?} {seed}");
                            }
                        }
                    }
                    Err(Error::Solver { failure, solver, .. }) => {
                        assert!(solver == name || failure != Failure::Refused, "{name}: {failure}")
                    }
                    Err(other) => panic!("{name}: {other}"),
                }
            }
        }
    }
    for name in ["auto", "lemke", "pgs", "psor", "admm", "nonsmooth-newton", "interior-point", "apgd", "bb"] {
        assert!(taken.contains(name), "{name} solves none of them");
    }
}

#[test]
fn the_order_of_constraints_changes_no_velocity() {
    let problem = random(7, Law::Coulomb);
    let answer = certified(&problem, &Auto);
    let order = [5, 2, 7, 0, 4, 6, 1, 3];
    let rows: Vec<usize> = order.iter().flat_map(|k| problem.rows_of(*k)).collect();
    let permuted = JointedProblem::new(
        3,
        order.iter().map(|k| problem.kinds()[*k]).collect(),
        DMatrix::from_fn(rows.len(), rows.len(), |i, j| problem.delassus()[(rows[i], rows[j])]),
        DVector::from_fn(rows.len(), |i, _| problem.free_velocity()[rows[i]]),
    );
    let permuted = permuted.unwrap().law(Law::Coulomb, order.iter().map(|k| problem.friction()[*k]).collect()).unwrap();
    let other = certified(&permuted, &Auto);
    let back = |vector: &DVector<f64>| DVector::from_fn(rows.len(), |i, _| vector[rows.iter().position(|row| *row == i).unwrap()]);
    assert!((back(&other.velocity) - &answer.velocity).amax() < 1e-9 * (1.0 + answer.velocity.amax()));
}

/// min ½rᵀWr + qᵀr over all impulses together, those of joints free: the associated law, without any elimination.
#[cfg(feature = "clarabel")]
fn convex_program(problem: &JointedProblem) -> DVector<f64> {
    use ::clarabel::algebra::CscMatrix;
    use ::clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT};
    let n = problem.rows();
    let (mut cones, mut entries) = (Vec::new(), Vec::new());
    for k in problem.pushing() {
        let rows = problem.rows_of(k);
        if problem.kinds()[k] == LIMIT {
            cones.push(NonnegativeConeT(1));
            entries.push((rows.start, -1.0));
        } else {
            cones.push(SecondOrderConeT(rows.len()));
            entries.extend(rows.clone().map(|row| (row, if row == rows.start { -problem.friction()[k] } else { -1.0 })));
        }
    }
    let constraint = DMatrix::from_fn(entries.len(), n, |i, j| if entries[i].0 == j { entries[i].1 } else { 0.0 });
    let dense = |matrix: &DMatrix<f64>, keep: &dyn Fn(usize, usize) -> bool| {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for j in 0..matrix.ncols() {
            for i in (0..matrix.nrows()).filter(|i| keep(*i, j) && matrix[(*i, j)] != 0.0) {
                rows.push(i);
                values.push(matrix[(i, j)]);
            }
            starts.push(rows.len());
        }
        CscMatrix::new(matrix.nrows(), matrix.ncols(), starts, rows, values)
    };
    let (quadratic, constraint) = (dense(problem.delassus(), &|i, j| i <= j), dense(&constraint, &|_, _| true));
    let settings = DefaultSettingsBuilder::default().verbose(false).tol_gap_abs(1e-12).tol_gap_rel(1e-12).tol_feas(1e-12).build().unwrap();
    let linear: Vec<f64> = problem.free_velocity().iter().copied().collect();
    let zeros = vec![0.0; entries.len()];
    let mut solver = DefaultSolver::new(&quadratic, &linear, &constraint, &zeros, &cones, settings).unwrap();
    solver.solve();
    DVector::from_column_slice(&solver.solution.x)
}

#[cfg(feature = "clarabel")]
#[test]
fn a_convex_program_over_all_impulses_has_the_same_velocities() {
    for seed in 11..21 {
        let mut problem = random(seed, Law::Associated);
        // the interior point needs rows of like size
        let scale = DVector::from_fn(problem.rows(), |row, _| problem.delassus()[(row, row)].sqrt().recip());
        let even = DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| problem.delassus()[(i, j)] * scale[i] * scale[j]);
        let friction = problem.friction().to_vec();
        problem = JointedProblem::new(3, problem.kinds().to_vec(), even, problem.free_velocity().component_mul(&scale)).unwrap();
        problem = problem.law(Law::Associated, friction).unwrap();
        let (ours, theirs) = (certified(&problem, &Auto), problem.velocity(&convex_program(&problem)));
        assert!((&ours.velocity - &theirs).amax() < 1e-6 * (1.0 + theirs.amax()), "{seed}: {} {theirs}", ours.velocity);
    }
}

#[test]
fn a_symmetric_w_stays_symmetric_to_the_last_bit() {
    for seed in 1..10 {
        let left = WithoutJoints::new(&random(seed, Law::Coulomb)).unwrap();
        assert_eq!(left.contacts().dense(), &left.contacts().dense().transpose());
        assert!(left.dependent().is_empty());
    }
}

#[test]
fn a_warm_start_of_all_rows_is_used_and_one_of_another_size_is_refused() {
    let problem = random(3, Law::Coulomb);
    let answer = certified(&problem, &Auto);
    let again = solve_jointed(&problem, &Auto, Some(&answer.impulse)).unwrap();
    assert!(again.iterations == 0 && (&again.velocity - &answer.velocity).amax() < 1e-12);
    assert!(solve_jointed(&problem, &Auto, Some(&dvector![1.0])).expect_err("too short").to_string().contains("warm_start"));
}

/// Three bars in space, (v, ω) each, and four hinges about y: a parallelogram 3 m wide and 2 m high, which moves in one way. Twenty rows on
/// eighteen velocities: three say what others say.
fn four_bars() -> JointedProblem {
    // rows of the point that is (dx, 0, dz) from a centre, and of the rotation about x and z
    let at = |[dx, dz]: [f64; 2]| {
        dmatrix![
            1.0, 0.0, 0.0, 0.0, dz, 0.0;
            0.0, 1.0, 0.0, -dz, 0.0, dx;
            0.0, 0.0, 1.0, 0.0, -dx, 0.0;
            0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
            0.0, 0.0, 0.0, 0.0, 0.0, 1.0
        ]
    };
    let hinges: [&[(usize, [f64; 2])]; 4] =
        [&[(0, [0.0, -1.0])], &[(0, [0.0, 1.0]), (1, [-1.5, 0.0])], &[(1, [1.5, 0.0]), (2, [0.0, 1.0])], &[(2, [0.0, -1.0])]];
    let mut jacobian = DMatrix::zeros(21, 18);
    for (hinge, ends) in hinges.iter().enumerate() {
        for (end, (body, place)) in ends.iter().enumerate() {
            let sign = if end == 0 { 1.0 } else { -1.0 };
            jacobian.view_mut((5 * hinge, 6 * body), (5, 6)).copy_from(&(at(*place) * sign));
        }
    }
    jacobian[(20, 12)] = 1.0; // a stop against the middle of the third bar
    let inertia = [3.0, 3.0, 3.0, 1.0, 1.0, 0.125, 1.0, 1.0, 1.0, 0.125, 0.75, 0.75, 3.0, 3.0, 3.0, 1.0, 1.0, 0.125];
    // the parallelogram turns at −1 rad/s
    let mut free = DVector::zeros(18);
    for (place, velocity) in [(0, -1.0), (4, -1.0), (6, -2.0), (12, -1.0), (16, -1.0)] {
        free[place] = velocity;
    }
    let kinds = vec![bilateral(5), bilateral(5), bilateral(5), bilateral(5), CONTACT];
    let mass = DMatrix::from_diagonal(&DVector::from_row_slice(&inertia));
    mechanism(kinds, 1, &mass, &jacobian, &free).law(Law::Frictionless, vec![0.0; 5]).unwrap()
}

#[test]
fn a_parallelogram_in_space_is_redundant_by_three_and_its_stop_takes_the_momentum() {
    // ½ω²(3 · 4/3 + 3 · 4/3 + 1 · 4) = ½ 12 ω², and the stop moves with ω · 1 m
    let problem = four_bars();
    let left = WithoutJoints::new(&problem).unwrap();
    assert_eq!(left.dependent().len(), 3, "{:?}", left.dependent());
    assert!((left.contacts().entry(0, 0) - 1.0 / 12.0).abs() < 1e-14);
    let answer = certified(&problem, &Auto);
    assert!((answer.impulse[20] - 12.0).abs() < 1e-11 && answer.velocity.amax() < 1e-13, "{answer:?}");
}

#[test]
fn rows_that_are_sums_of_others_change_no_velocity() {
    for seed in 31..51 {
        let problem = random(seed, Law::Coulomb);
        let mut next = numbers(seed + 100);
        // a weld of six rows, each a sum of the ten bilateral rows there are
        let joints: Vec<usize> = problem.bilateral().into_iter().flat_map(|k| problem.rows_of(k)).collect();
        let rows = problem.rows();
        let size = |row: usize| problem.delassus()[(row, row)].sqrt();
        let sums = DMatrix::from_fn(6, rows, |_, row| if joints.contains(&row) { next() / size(row) } else { 0.0 });
        let mut all = DMatrix::zeros(rows + 6, rows);
        all.view_mut((0, 0), (rows, rows)).fill_with_identity();
        all.view_mut((rows, 0), (6, rows)).copy_from(&sums);
        let w = &all * problem.delassus() * all.transpose();
        let kinds = problem.kinds().iter().copied().chain([bilateral(6)]).collect();
        let welded = JointedProblem::new(3, kinds, (&w + w.transpose()) * 0.5, &all * problem.free_velocity()).unwrap();
        let friction = problem.friction().iter().copied().chain([0.0]).collect();
        let welded = welded.law(Law::Coulomb, friction).unwrap();
        assert_eq!(WithoutJoints::new(&welded).unwrap().dependent().len(), 6, "{seed}");
        let (alone, together) = (certified(&problem, &Auto), certified(&welded, &Auto));
        let difference = (together.velocity.rows(0, rows) - &alone.velocity).amax();
        assert!(difference < 1e-7 * (1.0 + alone.velocity.amax()), "{seed}: {difference}");
    }
}

#[test]
fn small_mechanisms_that_joints_hold_wholly_or_in_part_are_solved() {
    let (mut redundant, mut fast) = (0, 0);
    for seed in 1..=200 {
        let mut next = numbers(1000 + seed);
        let mut below = |most: usize| ((next() + 1.0) * 0.5 * most as f64) as usize % most;
        let law = [Law::Coulomb, Law::Associated, Law::Frictionless][below(3)];
        let kinds: Vec<ConstraintKind> =
            (0..1 + below(4)).map(|_| [CONTACT, LIMIT, bilateral(1), bilateral(2), bilateral(3), bilateral(6)][below(6)]).collect();
        let rows: usize = kinds
            .iter()
            .map(|kind| {
                if *kind == CONTACT {
                    2
                } else if let ConstraintKind::Bilateral { rows } = kind {
                    *rows
                } else {
                    1
                }
            })
            .sum();
        let velocities = 1 + below(12);
        let kind_of = |pick: usize, other: f64| [0.0, 0.0, 1.0, -1.0, 0.5, other][pick];
        let mut jacobian = DMatrix::zeros(rows, velocities);
        for entry in jacobian.iter_mut() {
            let pick = below(6);
            *entry = kind_of(pick, 0.1 * (1 + below(20)) as f64);
        }
        let mass = DMatrix::from_fn(velocities, velocities, |i, j| if i == j { (1 + i) as f64 } else { 0.0 });
        let free = DVector::from_fn(velocities, |_, _| 0.1 * below(20) as f64 - 1.0);
        let friction = kinds.iter().map(|kind| if *kind == CONTACT { 0.5 } else { 0.0 }).collect();
        let problem = mechanism(kinds, 2, &mass, &jacobian, &free).law(law, friction).unwrap();
        redundant += usize::from(!WithoutJoints::new(&problem).unwrap().dependent().is_empty());
        let answer = solve_jointed(&problem, &Auto, None).unwrap_or_else(|error| panic!("{seed}: {error}"));
        let found = jointed_residuals(&problem, &answer).unwrap();
        assert!(found.is_solution(CERTIFY), "{seed}: {found:?}");
        fast += usize::from(answer.velocity.amax() > 1e-3);
    }
    assert!(redundant > 40 && fast > 40, "{redundant} redundant, {fast} move");
}
