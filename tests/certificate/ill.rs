//! The named cases that a certificate with one scale for all contacts accepts, and answers whose parts contradict each other.

use crate::exact::{Exact, Known, zero};
use crate::family::answer;
use crate::rule::{Answer, CERTIFY, OWN_DATA, judge};
use moreau::certificate::residuals;
use moreau::problem::{ContactProblem, Dynamics, Law, Solution};
use moreau::scalar::{Rational, exact, ratio};
use nalgebra::{DMatrix, DVector};

/// Contacts of separate bodies with these masses and these free velocities (n, t₁, …), μ = ½.
fn blocks(law: Law, masses: &[i64], free: &[&[(i64, i64)]]) -> ContactProblem {
    let bodies = (0..masses.len()).map(|body| [Some(body), None]).collect();
    blocks_of(&Known::Bodies(bodies), law, masses, free)
}

fn blocks_of(known: &Known, law: Law, masses: &[i64], free: &[&[(i64, i64)]]) -> ContactProblem {
    let rows = free[0].len();
    let size = rows * masses.len();
    let numbers: Vec<Rational> = free.iter().flat_map(|contact| contact.iter().map(|&(p, q)| ratio(p, q))).collect();
    let exact = Exact {
        rows,
        law,
        friction: vec![ratio(1, 2); masses.len()],
        delassus: DMatrix::from_fn(size, size, |i, j| if i == j { ratio(1, masses[i / rows]) } else { zero() }),
        free: numbers,
        shift: vec![zero(); size],
        soft: vec![zero(); size],
        edge_soft: None,
    };
    exact.rounded("blocks", known)
}

fn certified(problem: &ContactProblem, solution: &Solution) -> bool {
    residuals(problem, solution).expect("sizes fit").is_solution(CERTIFY.tolerance)
}

fn accepted(problem: &ContactProblem, impulse: &[f64]) -> bool {
    certified(problem, &answer(problem, DVector::from_row_slice(impulse)))
}

/// Both blocks fall at 1/16 m/s and slide at 1 m/s, more than friction can stop.
const SLIDING: [&[(i64, i64)]; 2] = [&[(-1, 16), (1, 1)], &[(-1, 16), (1, 1)]];

#[test]
fn a_light_block_without_friction_beside_a_heavy_contact_is_refused() {
    for heavy in [1_000_000, 100_000_000, 10_000_000_000] {
        let problem = blocks(Law::Coulomb, &[heavy, 1], &SLIDING);
        let (normal, friction) = (heavy as f64 / 16.0, -(heavy as f64) / 32.0);
        assert!(accepted(&problem, &[normal, friction, 1.0 / 16.0, -1.0 / 32.0]), "the answer at {heavy} kg");
        for (name, light) in [("no", 0.0), ("reversed", 1.0 / 32.0), ("half the", -1.0 / 64.0)] {
            assert!(!accepted(&problem, &[normal, friction, 1.0 / 16.0, light]), "{name} friction beside {heavy} kg");
        }
        assert!(!accepted(&problem, &[normal, friction, 0.0, 0.0]), "no contact at all beside {heavy} kg");
    }
}

#[test]
fn a_stored_velocity_of_a_light_block_that_is_wrong_is_refused() {
    let problem = blocks(Law::Coulomb, &[100_000_000, 1], &[&[(-1_000_000, 1), (10_000_000, 1)], SLIDING[1]]);
    let mut solution = answer(&problem, DVector::from_vec(vec![1e14, -0.5e14, 1.0 / 16.0, -1.0 / 32.0]));
    assert!(certified(&problem, &solution));
    solution.velocity[3] *= 1.0 + 2f64.powi(-10);
    assert!(!certified(&problem, &solution));
}

#[test]
fn an_answer_turned_on_the_cone_is_refused_however_fast_it_slides() {
    for speed in [1, 1_000, 1_000_000] {
        for law in [Law::Coulomb, Law::Associated] {
            // y_t = speed·(3, 4); the associated law lifts by μ‖y_t‖
            let lift = if law == Law::Associated { 5 * speed } else { 0 };
            let problem = blocks(law, &[1], &[&[(lift - 20, 2), (3 * speed + 3, 1), (4 * speed + 4, 1)]]);
            let impulse = |turn: f64| {
                let (sine, cosine) = turn.sin_cos();
                [10.0, -3.0 * cosine + 4.0 * sine, -4.0 * cosine - 3.0 * sine]
            };
            assert!(accepted(&problem, &impulse(0.0)), "{law:?} at {speed}");
            for turn in [1e-6, -1e-6, 1e-3, 3.0] {
                assert!(!accepted(&problem, &impulse(turn)), "{law:?} turned by {turn} at {speed}");
            }
        }
    }
}

/// Where friction sticks, y_n = μ‖y_t‖ is no more excused than any other velocity, by the certificate and by the rule.
#[test]
fn a_slip_that_is_nothing_excuses_no_velocity_however_large_the_coefficient_is() {
    for mu in [10.0, 1e3, 1e6, 1e9] {
        let problem = blocks(Law::Associated, &[1], &[&[(-1, 1), (0, 1), (0, 1)]]);
        let problem = problem.into_builder().friction(vec![mu]).build().expect("a coefficient");
        for (lift, is_right) in [(0.0, true), (2f64.powi(-28), true), (2f64.powi(-25), false), (2f64.powi(-10), false), (1.0, false)] {
            let impulse = [1.0 + lift, 0.6 * lift / mu, -0.8 * lift / mu];
            assert_eq!(accepted(&problem, &impulse), is_right, "{lift} m/s at {mu}");
            let (known, impulse) = (Exact::of(&problem), impulse.map(exact));
            let net = known.net(&impulse);
            let ratio = judge(&known, &[vec![0]], &Answer { impulse: &impulse, net: &net }, CERTIFY)[0];
            assert!(if is_right { ratio.most < 0.5 } else { ratio.least > 2.0 }, "{lift} m/s at {mu}: {ratio:?}");
        }
    }
}

/// W_tt is 10⁵ and more times W_nn, so that 10⁻⁸ of what r moves along the tangent is a normal velocity that decides r_n, and by it where a
/// light contact goes.
#[test]
fn a_slip_beside_a_fast_tangent_excuses_no_normal_velocity_whatever_the_coefficient_is() {
    for (mu, along, part) in [(1e6, 1024.0, 0.00390625), (0.5, 1024.0, 0.00390625), (1.5, 16384.0, 0.015625)] {
        let w = part * part;
        // y = (y_n, y_n/μ) at the first contact with r_n = 1, the second one opens at 1 + part
        let y_n = 0.6 * w;
        let rows = [[w, 0.0, part, 0.0], [0.0, along, 0.0, 0.0], [part, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        let free = DVector::from_vec(vec![y_n - w, y_n / mu, 1.0, 0.0]);
        let delassus = DMatrix::from_fn(4, 4, |i, j| rows[i][j]);
        let problem = ContactProblem::new(delassus, free).law(Law::Associated).rows_per_contact(2).friction(vec![mu, 0.5]);
        let problem = problem.build().expect("sizes fit");
        // stuck, y = 0
        let right = (w - y_n) / w;
        let slides = y_n / mu / along;
        assert!(accepted(&problem, &[right, -slides, 0.0, 0.0]), "{mu}");
        assert!(!accepted(&problem, &[1.0, 0.0, 0.0, 0.0]), "{mu}");
    }
}

#[test]
fn parts_that_contradict_the_impulse_are_refused_beside_a_heavy_contact() {
    let problem = blocks(Law::PolyhedralCoulomb { directions: 2 }, &[100_000_000, 1], &SLIDING);
    let impulse = DVector::from_vec(vec![6.25e6, -3.125e6, 1.0 / 16.0, -1.0 / 32.0]);
    let slip = 1.0 - 1.0 / 32.0;
    let given = |beta: f64, sigma: f64| {
        let mut given = answer(&problem, impulse.clone());
        given.beta = Some(DVector::from_vec(vec![0.0, 3.125e6, 0.0, beta]));
        given.sigma = Some(DVector::from_vec(vec![slip, sigma]));
        given
    };
    assert!(certified(&problem, &given(1.0 / 32.0, slip)));
    assert!(!certified(&problem, &given(0.0, slip)), "β does not add up to the friction");
    assert!(!certified(&problem, &given(1.0 / 32.0, 2.0 * slip)), "σ is not the speed of the slip");
    assert!(!certified(&problem, &given(1.0 / 32.0, 0.0)), "σ = 0 while it slides");
}

/// Two changes by a thousandth that data of other contacts and other rows excuse, unless they widen their own contact alone.
#[test]
fn what_the_data_of_the_group_forgive() {
    let delta = 1.0 + 2f64.powi(-10);
    // an associated law lifts by μ‖y_t‖, so that q_n is as large as the slip is fast
    let fast = blocks(Law::Associated, &[1], &[&[(5_000_000 - 20, 2), (3_000_003, 1), (4_000_004, 1)]]);
    assert!(accepted(&fast, &[10.0, -3.0, -4.0]));
    assert_eq!(accepted(&fast, &[10.0 * delta, -3.0 * delta, -4.0 * delta]), !OWN_DATA, "r grows while it slides fast");
    // one point of a body leaves at 10⁶ m/s while the other carries
    let known = Known::Jacobian(Dynamics { mass: DMatrix::identity(4, 4), jacobian: DMatrix::from_element(4, 4, 1.0) });
    let leaving = blocks_of(&known, Law::Coulomb, &[1, 1], &[&[(1_000_000, 1), (0, 1)], &[(-1, 1), (0, 1)]]);
    assert!(accepted(&leaving, &[0.0, 0.0, 1.0, 0.0]));
    assert_eq!(accepted(&leaving, &[0.0, 0.0, delta, 0.0]), !OWN_DATA, "r grows while another point leaves fast");
}
