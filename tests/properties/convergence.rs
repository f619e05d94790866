//! Property family `convergence`: measured orders against derived ones.

use crate::cases;
use moreau::checks::Finding;
use moreau::checks::convergence::{
    Horizon, Incline, Stop, anitescu_hop, anitescu_slide, ball_errors, bouncing_ball, coulomb_slide, plastic_ball, sticking,
};
use moreau::closed_forms::BouncingBall;
use moreau::schemes::{Activation, Anitescu, MoreauJean, RestitutionRule, StewartTrinkle};
use moreau::tolerance::convergence::Impacts;
use proptest::prelude::*;

fn all_hold(title: &str, findings: &[Finding]) {
    assert!(!findings.is_empty(), "{title}: nothing was measured");
    for finding in findings {
        println!("{title}: {finding}");
    }
    for finding in findings {
        assert!(finding.holds(), "{title}: {finding}");
    }
}

fn moreau_jean() -> impl Iterator<Item = MoreauJean> {
    Activation::ALL
        .into_iter()
        .flat_map(|activation| [0.5, 1.0].map(|theta| MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly }))
}

fn ball(restitution: f64, horizon: Horizon) {
    for scheme in moreau_jean() {
        let title = format!("{horizon:?} e={restitution} {scheme:?}");
        all_hold(&title, &bouncing_ball(&scheme, &scheme, restitution, horizon).expect("the ball can be stepped"));
    }
}

#[test]
fn moreau_jean_through_one_impact_has_the_derived_orders_and_constants() {
    ball(0.8, Horizon::OneImpact);
}

#[test]
fn moreau_jean_through_the_zeno_point_stays_within_the_derived_bounds() {
    ball(0.5, Horizon::Zeno);
}

#[test]
fn moreau_jean_on_the_elastic_ball_stays_within_the_derived_bounds() {
    ball(1.0, Horizon::Elastic);
}

#[test]
fn a_plastic_ball_stopped_below_the_floor_has_order_one_and_above_it_order_one_half() {
    for scheme in moreau_jean() {
        let theta = scheme.theta;
        let stop = match scheme.activation {
            Activation::Gap => Stop::Below { theta, forecast: 0.0 },
            Activation::HalfStepForecast if theta == 0.5 => Stop::Below { theta, forecast: 0.5 },
            Activation::HalfStepForecast => Stop::Above { theta, forecast: 0.5 },
            Activation::FreeVelocityForecast => Stop::Above { theta, forecast: 1.0 },
        };
        all_hold(&format!("plastic {scheme:?}"), &plastic_ball(&scheme, stop).expect("the ball can be stepped"));
    }
}

#[test]
fn stewart_trinkle_and_anitescu_land_a_plastic_ball_on_the_floor() {
    all_hold("plastic Stewart–Trinkle", &plastic_ball(&StewartTrinkle::default(), Stop::On).expect("the ball can be stepped"));
    all_hold("plastic Anitescu", &plastic_ball(&Anitescu, Stop::On).expect("the ball can be stepped"));
}

fn incline(friction: f64, velocity: f64) -> Incline {
    Incline { gravity: 9.81, angle: 0.349, friction, velocity, duration: 0.5 }
}

#[test]
fn a_sticking_block_does_not_creep_under_either_scheme() {
    all_hold("stick Stewart–Trinkle", &sticking(&StewartTrinkle::default(), &incline(0.5, 0.0)).expect("runs"));
    all_hold("stick Anitescu", &sticking(&Anitescu, &incline(0.5, 0.0)).expect("runs"));
}

#[test]
fn a_sliding_block_has_order_one_with_the_constant_in_closed_form() {
    for velocity in [0.0, 1.0] {
        all_hold("slide Stewart–Trinkle", &coulomb_slide(&StewartTrinkle::default(), &incline(0.3, velocity)).expect("runs"));
        all_hold("slide Anitescu", &anitescu_slide(&Anitescu, &incline(0.3, velocity)).expect("runs"));
    }
}

#[test]
fn anitescu_hops_from_a_closed_gap_by_a_height_that_does_not_vanish_with_h() {
    all_hold("hop", &anitescu_hop(&Anitescu, &incline(0.3, 1.0)).expect("runs"));
}

proptest! {
    #![proptest_config(cases(1000))]

    /// The upper bounds hold for every step, whatever the phase of the impact.
    #[test]
    fn one_impact_stays_below_the_derived_constants_for_any_restitution_theta_and_phase(
        restitution in 0.3..=1.0f64,
        theta in 0.5..=1.0f64,
        activation in prop::sample::select(&Activation::ALL),
        intervals in 100.0..400.0f64,
    ) {
        let forecast = match activation {
            Activation::Gap => 0.0,
            Activation::HalfStepForecast => 0.5,
            Activation::FreeVelocityForecast => 1.0,
        };
        let horizon = 1.0 + restitution;
        let expected = Impacts { theta, forecast, restitution, shifts: 1, impacts: Some(1), horizon };
        let scheme = MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly };
        let ball = BouncingBall::new(9.81, 1.0, restitution).expect("valid");
        let (fall, speed) = (ball.first_impact_time(), ball.impact_speed(1));
        let h = fall / intervals;
        let errors = ball_errors(&scheme, restitution, horizon, h).expect("the ball can be stepped");
        for (name, constant, bounds) in [
            ("position sup", errors.position / (speed * h), expected.position(intervals)),
            ("velocity L1", errors.velocity_l1 / (speed * h), expected.velocity_l1(intervals)),
            ("velocity sup", errors.velocity_sup / speed, expected.velocity_sup(intervals)),
            ("graph distance", errors.graph * fall / h, expected.graph(intervals)),
        ] {
            prop_assert!(constant <= bounds.upper, "{name}: {constant} above {}", bounds.upper);
        }
    }
}
