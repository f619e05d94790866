//! How sharp the bounds are, and why there is none where there is none.

use crate::energy_balance::table::ROWS;
use crate::energy_balance::*;
use crate::schemes::by_name;
use moreau_checks::Finding;
use moreau_contact::solvers::{Auto, LemkePivoting};
use moreau_dynamics::mechanics::{Mechanism, OscillatorWithStop, Plane, PointMass, State};
use moreau_dynamics::schemes::{Activation, Scheme, step};
use moreau_exact::tolerance::rounding;
use nalgebra::dvector;

/// A ball of 2 kg at this height and speed, one step of a scheme.
fn ball_step(name: &str, parameters: &SchemeParameters, e: f64, at: [f64; 2], h: f64) -> Judged {
    let ball = PointMass::ball_on_floor(2.0, 10.0, e);
    let before = State { time: 0.0, position: dvector![at[0]], velocity: dvector![at[1]] };
    let scheme = by_name(name, *parameters).expect("listed");
    let made = step(scheme.as_ref(), &LemkePivoting, &ball, &before, h).expect("one contact");
    let taken = Taken { mechanism: &ball, before: &before, step: &made, h };
    Balance::of(name, parameters).expect("listed").judge(&taken).expect("judged")
}

fn rise(judged: &Judged) -> (f64, f64) {
    let total = judged.findings.iter().find(|finding| finding.name == TOTAL).expect("a bound");
    assert!(total.holds(), "{total}");
    (total.measured, total.expectation.value)
}

#[test]
fn the_gain_of_discretised_gravity_is_reached_by_a_ball_that_half_rests() {
    // Q = x² + h x·c is least where the impulse is half of m g h: (1+e) v + ½ g h = 0, v = −½ g h/(1+e), and y_n = 0 asks v_free + r/m = −e
    // v
    let h = 0.125;
    for (e, theta) in [(0.0, 0.5), (0.0, 1.0), (0.25, 0.5), (0.5, 0.25), (1.0, 0.5)] {
        let parameters = SchemeParameters { theta, activation: Activation::Gap, ..SchemeParameters::default() };
        let speed = 0.5 * 10.0 * h / (1.0 + e);
        let (measured, bound) = rise(&ball_step("moreau-jean", &parameters, e, [0.0, speed], h));
        let closed = (1.0 - e) / (1.0 + e) * 2.0 * (10.0 * h) * (10.0 * h) / 8.0;
        assert!(
            (bound - closed).abs() <= rounding(32, 4.0) && (measured - closed).abs() <= rounding(64, 8.0),
            "{e} {theta}: {measured} {closed}"
        );
        // any other speed gains less
        for other in [-2.0, 0.5 * speed, 1.5 * speed, 0.0] {
            let (measured, _) = rise(&ball_step("moreau-jean", &parameters, e, [0.0, other], h));
            assert!(measured <= closed + rounding(64, 8.0) && (e == 1.0 || measured < closed - 0.01), "{e} {theta} {other}: {measured}");
        }
    }
}

#[test]
fn a_spring_reaches_its_bound_too() {
    let (h, e, theta) = (0.125, 0.5, 0.5);
    let body = OscillatorWithStop::new(2.0, 8.0, 0.0, 0.5, e).expect("valid");
    let parameters = SchemeParameters { theta, activation: Activation::Gap, ..SchemeParameters::default() };
    let scheme = by_name("moreau-jean", parameters).expect("listed");
    // −(1+e) r·u⁻ = Q̂ is least at r = −½ M̂(v_free − v)
    let sharpest = (0..=200).map(|k| {
        let before = State { time: 0.0, position: dvector![0.5], velocity: dvector![f64::from(k) / 400.0 - 0.25] };
        let made = step(scheme.as_ref(), &LemkePivoting, &body, &before, h).expect("one contact");
        let taken = Taken { mechanism: &body, before: &before, step: &made, h };
        let judged = Balance::of("moreau-jean", &parameters).expect("listed").judge(&taken).expect("judged");
        let (measured, bound) = rise(&judged);
        measured / bound
    });
    let sharpest = sharpest.fold(f64::NEG_INFINITY, f64::max);
    assert!((0.999..=1.0 + rounding(64, 1.0)).contains(&sharpest), "{sharpest}");
}

/// A point between two walls, hit at once, without friction and gravity.
fn cornered(restitutions: [f64; 2]) -> f64 {
    let wall = |normal, e| Plane::new(normal, 0.0, 0.0, e).expect("a unit normal");
    let walls = vec![wall(dvector![0.0, 1.0], restitutions[0]), wall(dvector![0.96, -0.28], restitutions[1])];
    let point = PointMass::new("cornered", 1.0, dvector![0.0, 0.0], walls).expect("valid");
    let before = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![-1.0, -0.1] };
    let parameters = SchemeParameters { activation: Activation::Gap, ..SchemeParameters::default() };
    let made =
        step(&MoreauJean { activation: Activation::Gap, ..MoreauJean::default() }, &Auto, &point, &before, 0.01).expect("two contacts");
    let taken = Taken { mechanism: &point, before: &before, step: &made, h: 0.01 };
    let judged = Balance::of("moreau-jean", &parameters).expect("listed").judge(&taken).expect("judged");
    assert!(judged.findings.iter().all(Finding::holds), "{:?}", judged.findings);
    assert!(made.impulses.iter().all(|one| one.impulse[0] > 0.0));
    point.energy(&made.state) - point.energy(&before)
}

#[test]
fn an_impact_without_friction_and_gravity_gains_with_no_pair_of_restitutions() {
    // ΔT = −½ Σ (1 − e_k) r_n |u_n⁻|
    let gained = [[0.5, 0.5], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]].map(cornered);
    assert!(gained[1].abs() <= rounding(32, 1.0), "{gained:?}");
    assert!([0, 2, 3].into_iter().all(|k| gained[k] < 0.0), "{gained:?}");
}

#[test]
fn schemes_of_every_row_hold_their_row_on_an_impact_and_on_a_depth() {
    let parameters = SchemeParameters::default();
    for row in &ROWS {
        let balance = Balance::of(row.scheme, &parameters).expect("listed");
        for (e, at) in [(0.5, [0.002, -1.0]), (0.0, [-0.001, -0.1]), (1.0, [0.02, -3.0]), (0.5, [3.0, 0.0])] {
            let ball = PointMass::ball_on_floor(2.0, 10.0, e);
            let before = State { time: 0.0, position: dvector![at[0]], velocity: dvector![at[1]] };
            let scheme: Box<dyn Scheme> = by_name(row.scheme, parameters).expect("listed");
            // event-driven motion starts outside the floor: what starts inside is put onto it, against gravity
            let outside = at[0] >= 0.0 || row.scheme != "event-driven";
            let Some(made) = step(scheme.as_ref(), &Auto, &ball, &before, 0.01).ok().filter(|_| outside) else { continue };
            let judged = balance.judge(&Taken { mechanism: &ball, before: &before, step: &made, h: 0.01 }).expect("judged");
            assert_eq!(judged.findings.is_empty(), !balance.is_theorem(), "{}", row.scheme);
            assert!(judged.findings.iter().all(Finding::holds), "{} at {at:?}: {:?}", row.scheme, judged.findings);
        }
    }
}
