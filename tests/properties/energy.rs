//! Property family `energy`: the first impact in floats, the elastic invariant in exact rationals.

use crate::cases;
use moreau::checks::energy::{elastic_invariant, impact, worked_ball, worked_example};
use moreau::checks::zeno::DroppedBall;
use moreau::exact_particle::{Ball, BallState};
use moreau::scalar::{Rational, ratio};
use moreau::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
use proptest::prelude::*;

fn positive_rational() -> impl Strategy<Value = Rational> {
    (1..=60i64, 1..=12i64).prop_map(|(p, q)| ratio(p, q))
}

proptest! {
    #![proptest_config(cases(1200))]

    #[test]
    fn an_impact_keeps_e_of_the_velocity_and_e_squared_of_the_energy(
        (mass, gravity, height) in (0.01..100.0f64, 1.0..30.0f64, 0.01..10.0f64),
        restitution in 0.01..=1.0f64,
        activation in prop::sample::select(&Activation::ALL),
        theta in 0.5..=1.0f64,
        fall in 3.0..150.0f64,
    ) {
        let ball = DroppedBall { mass, gravity, height, restitution };
        let scheme = MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly };
        let h = ball.impact_speed() / (gravity * fall);
        for finding in impact(&scheme, &scheme, &ball, h).expect("the ball reaches the floor") {
            prop_assert!(finding.holds(), "{}: {finding}", scheme.name());
        }
    }

    #[test]
    fn the_elastic_ball_conserves_its_scheme_energy_exactly(
        (mass, gravity) in (positive_rational(), positive_rational()),
        steps_of_fall in 1..=8i64,
        theta in (0..=12i64).prop_map(|k| ratio(k, 12)),
        activation in prop::sample::select(&Activation::ALL),
        h in (1..=100i64).prop_map(|k| ratio(1, k)),
    ) {
        let ball = Ball { mass, gravity: gravity.clone(), restitution: ratio(1, 1) };
        let height = gravity * &h * &h * ratio(steps_of_fall * steps_of_fall, 2);
        let start = BallState { position: height, velocity: ratio(0, 1) };
        for finding in elastic_invariant(&ball, &start, &theta, activation, &h, 40) {
            prop_assert!(finding.holds(), "{finding}");
        }
    }
}

#[test]
fn the_worked_contact_step_of_the_chapter_is_exact() {
    for finding in worked_example(&worked_ball()) {
        assert!(finding.holds(), "{finding}");
    }
}
