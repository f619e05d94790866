//! The methods against the closed forms of the circle and of a linear constraint, and against each other.

use super::*;
use crate::tolerance::stabilisation::{circle_run, on_constraint};
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::tolerance::rounding;
use moreau_forms::stabilised_circle::{biased_energy, biased_offset, projected_energy};
use nalgebra::{DMatrix, dvector};

const STEPS: usize = 500;

fn circle() -> Pendulum {
    Pendulum::new(2.0, 0.5, 0.0).expect("valid")
}

/// Energy left after the run from the speed with which a step spans the share w of the radius.
fn energy_left(method: &dyn Stabilisation, w: f64, steps: usize) -> f64 {
    let (system, h) = (circle(), 0.01);
    let start = system.at(0.3, w * 0.5 / h);
    let end = run(method, &system, &start, h, steps).expect("steps");
    system.energy(&end) / system.energy(&start)
}

#[test]
fn projection_and_gear_gupta_leimkuhler_take_energy_as_one_over_one_plus_n_w_squared() {
    for w in [0.2, 0.02] {
        let bound = circle_run(STEPS);
        assert!((energy_left(&CoordinateProjection, w, STEPS) - projected_energy(w, STEPS)).abs() <= bound);
        assert!((energy_left(&GearGuptaLeimkuhler, w, STEPS) - projected_energy(w, STEPS)).abs() <= bound);
        // the velocity is that before the projection which the next step makes
        assert!((energy_left(&PositionProjection, w, STEPS) - projected_energy(w, STEPS - 1)).abs() <= bound);
    }
}

#[test]
fn a_bias_settles_at_its_offset_and_takes_no_more_energy() {
    let (system, h, w) = (circle(), 0.01, 0.02);
    for share in [0.2, 0.6, 1.0] {
        let method = Baumgarte::error_reduction(share, h).expect("valid");
        let start = system.at(0.3, w * 0.5 / h);
        let end = run(&method, &system, &start, h, STEPS).expect("steps");
        assert!((system.violation(&end.position)[0] / 0.5 - biased_offset(w, share)).abs() <= circle_run(STEPS));
        for steps in [STEPS, 2 * STEPS] {
            assert!((energy_left(&method, w, steps) - biased_energy(w, share)).abs() <= circle_run(steps));
        }
    }
}

#[test]
fn without_stabilisation_the_radius_follows_its_recursion() {
    let (system, h, w) = (circle(), 0.01, 0.05);
    let start = system.at(0.3, w * 0.5 / h);
    let end = run(&VelocityLevel, &system, &start, h, STEPS).expect("steps");
    let squared = (0..STEPS).fold(1.0, |squared: f64, _| squared + w * w / squared);
    assert!((system.violation(&end.position)[0] / 0.5 + 1.0 - squared.sqrt()).abs() <= circle_run(STEPS));
}

#[test]
fn position_and_coordinate_projection_give_the_same_positions_under_load() {
    let (system, h) = (Pendulum::new(1.0, 1.0, 9.81).expect("valid"), 0.01);
    let mut one = system.at(1.5, 0.0);
    let mut other = one.clone();
    for steps in 1..=STEPS {
        one = PositionProjection.step(&system, &one, h).expect("a step");
        other = CoordinateProjection.step(&system, &other, h).expect("a step");
        assert!((&one.position - &other.position).amax() <= circle_run(steps), "after {steps} steps");
    }
    assert!((&one.velocity - &other.velocity).amax() > circle_run(STEPS), "the velocities shown differ");
}

#[test]
fn gear_gupta_leimkuhler_satisfies_its_own_equations() {
    let (system, h) = (Pendulum::new(2.0, 0.5, 9.81).expect("valid"), 0.02);
    let start = system.at(1.0, 2.0);
    let end = GearGuptaLeimkuhler.step(&system, &start, h).expect("a step");
    let normal = &end.position / end.position.norm();
    let tangent = dvector![-normal[1], normal[0]];
    // along the tangent at q⁺ neither multiplier acts
    let impulse = (&end.velocity - &start.velocity) * 2.0 - system.force(&start.position) * h;
    let shift = &end.position - &start.position - &end.velocity * h;
    assert!(impulse.dot(&tangent).abs() <= rounding(64, 8.0) && shift.dot(&tangent).abs() <= rounding(64, 1.0));
    assert!(end.velocity.dot(&normal).abs() <= rounding(16, 4.0));
    assert!(system.violation(&end.position)[0].abs() <= on_constraint(0.5));
}

/// A point that must stay on the line x = 0: g(q) = x.
struct Line;

impl Constrained for Line {
    fn mass_matrix(&self) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0])
    }
    fn force(&self, _position: &DVector<f64>) -> DVector<f64> {
        dvector![3.0, -1.0]
    }
    fn violation(&self, position: &DVector<f64>) -> DVector<f64> {
        position.rows(0, 1).into_owned()
    }
    fn jacobian(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_row_slice(1, 2, &[1.0, 0.0])
    }
    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        position[1] - 3.0 * position[0]
    }
}

#[test]
fn on_a_linear_constraint_the_violation_follows_its_two_by_two_step_under_any_load() {
    let h = 0.125;
    let method = Baumgarte { damping: 2.0, frequency: 3.0 };
    let law = ViolationStep { damping: 2.0 * 2.0 * h, stiffness: 9.0 * h * h };
    let mut state = State { time: 0.0, position: dvector![1.0, 0.0], velocity: dvector![-0.5, 2.0] };
    let mut expected = [1.0, -0.5 * h];
    for steps in 1..=40 {
        state = method.step(&Line, &state, h).expect("a step");
        expected = law.advance(&expected);
        assert!((state.position[0] - expected[0]).abs() <= rounding(32 * steps, 4.0));
        assert!((state.velocity[0] * h - expected[1]).abs() <= rounding(32 * steps, 4.0));
    }
}

fn law(damping: Rational, stiffness: Rational) -> ViolationStep<Rational> {
    ViolationStep { damping, stiffness }
}

#[test]
fn a_violation_decays_inside_the_triangle_and_neither_on_its_edges_nor_outside() {
    let beside = ratio(1, 1_000_000);
    for k in 1..20 {
        let a = ratio(k, 10);
        let edge = ratio(4, 1) - ratio(2, 1) * &a;
        assert!(law(a.clone(), &edge - &beside).decays() && law(a.clone(), beside.clone()).decays());
        assert!(!law(a.clone(), edge.clone()).decays() && !law(a.clone(), &edge + &beside).decays() && !law(a, ratio(0, 1)).decays());
    }
    assert!(!law(ratio(0, 1), ratio(1, 1)).decays());
}

#[test]
fn one_over_h_for_both_parameters_ends_every_violation_in_two_steps() {
    let ends = law(ratio(1, 1), ratio(1, 1));
    for start in [[ratio(1, 1), ratio(0, 1)], [ratio(3, 7), ratio(-2, 1)]] {
        assert_eq!(ends.advance(&ends.advance(&start)), [ratio(0, 1), ratio(0, 1)]);
    }
}

#[test]
fn parameters_outside_their_range_are_refused() {
    assert!(Baumgarte::error_reduction(0.0, 0.01).is_err() && Baumgarte::error_reduction(1.5, 0.01).is_err());
    assert!(Pendulum::new(0.0, 1.0, 0.0).is_err() && Pendulum::new(1.0, -1.0, 0.0).is_err() && Pendulum::new(1.0, 1.0, f64::NAN).is_err());
}
