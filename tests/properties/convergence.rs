//! Property family `convergence`: measured orders against derived ones.

use moreau::checks::Finding;
use moreau::checks::convergence::{
    Horizon, Incline, Stop, anitescu_hop, anitescu_slide, bouncing_ball, coulomb_slide, plastic_ball, sticking,
};
use moreau::schemes::{Activation, Anitescu, MoreauJean, RestitutionRule, StewartTrinkle};

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
