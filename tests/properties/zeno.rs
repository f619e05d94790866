//! Property family `zeno`: balls of any mass, gravity and height, e ∈ (0, 0.95], rules A, B, D, θ ∈ {½, 1}.

use crate::cases;
use moreau::checks::zeno::{DroppedBall, absorption, events_grow};
use moreau::defects::zeno::{RULE_C, sinking};
use moreau::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
use proptest::prelude::*;

/// A ball, a scheme, and a step of V/(g·`fall`): `fall` steps from the start to the first impact.
fn drops() -> impl Strategy<Value = (DroppedBall, MoreauJean, f64)> {
    let ball = (0.01..100.0f64, 1.0..30.0f64, 0.01..10.0f64, 0.01..=0.95f64);
    let scheme = (prop::sample::select(&Activation::ALL), prop::sample::select(&[0.5, 1.0]));
    (ball, scheme, 3.0..150.0f64).prop_map(|((mass, gravity, height, restitution), (activation, theta), fall)| {
        let ball = DroppedBall { mass, gravity, height, restitution };
        let h = ball.impact_speed() / (gravity * fall);
        (ball, MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly }, h)
    })
}

proptest! {
    #![proptest_config(cases(1200))]

    #[test]
    fn fixed_steps_carry_the_ball_past_the_accumulation_point((ball, scheme, h) in drops()) {
        for finding in absorption(&scheme, &scheme, &ball, h, 50).expect("the ball can be stepped") {
            prop_assert!(finding.holds(), "{}: {finding}", scheme.name());
        }
    }

    #[test]
    fn an_event_driven_integrator_needs_ever_more_events((ball, _, _) in drops()) {
        for finding in events_grow(&ball, 20) {
            prop_assert!(finding.holds(), "{finding}");
        }
    }
}

proptest! {
    // Each case takes a thousand steps.
    #![proptest_config(cases(250))]

    #[test]
    fn rule_c_sinks_through_the_floor(
        (mass, gravity, height) in (0.01..100.0f64, 1.0..30.0f64, 0.01..10.0f64),
        restitution in 0.01..0.9f64,
        fall in 3.0..10.0f64,
    ) {
        let ball = DroppedBall { mass, gravity, height, restitution };
        let finding = sinking(&RULE_C, &ball, ball.impact_speed() / (gravity * fall)).expect("the ball can be stepped");
        prop_assert!(finding.holds(), "{finding}");
    }
}

/// Under φ + h v_free ≤ 0 with θ = ½ a ball from 4.81 steps of fall never reaches the floor: a penetration bound taken
/// from the first impact alone would be negative.
#[test]
fn regression_the_penetration_bound_is_not_negative() {
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.8917 };
    let scheme = MoreauJean { theta: 0.5, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    for finding in absorption(&scheme, &scheme, &ball, 0.1 / 4.81, 50).expect("the ball can be stepped") {
        assert!(finding.holds(), "{finding}");
    }
}
