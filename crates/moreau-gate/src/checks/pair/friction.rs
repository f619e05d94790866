//! What friction does when two bodies meet, whatever the normal impulse was.
//!
//! ```text
//!     slip all the time      ‖p_t‖ = μ p_n                    every law whose friction is on its cone while it slips
//!     stick at the end       W_t p_t = u_t                    Coulomb's; what yields along the surface may not
//!     p_t opposed to the slip
//! ```

use crate::Bench;
use crate::Expectation;
use crate::checks::pair::meeting::{GAP, SPEED, steps};
use crate::description::{Friction, Kind};
use crate::model::sliding::replayed;
use crate::model::{Model, convex};
use crate::tolerance::pair as tolerance;
use moreau_contact::cones::polyhedral;
use moreau_forms::sliding_contact::SlidingState;
use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

/// p_t/p_n; 0 where nothing presses.
pub(super) fn ratio([normal, across]: [f64; 2]) -> f64 {
    if normal == 0.0 { 0.0 } else { across / normal }
}

/// (p_n, p_t) over the reduced mass \[m/s\] of solid spheres that approach along their line of centres with [`SPEED`] and slip with `slip`,
/// under a convex law. Two solid spheres answer as one of their reduced mass on a floor does; W_t = 7/2 W_n of both.
pub(super) fn spheres_replayed(bench: &Bench, h: f64, [mass, radius]: [f64; 2], friction: f64, slip: f64) -> Option<[f64; 2]> {
    let contact = replayed(bench.description(), h, [mass, radius], friction, [0.0; 2])?;
    let start = SlidingState { gap: GAP, normal_velocity: -SPEED, velocity: 0.0, surface: -slip };
    let end = contact.motion(start, steps(h))[steps(h)];
    Some([end.normal_velocity + SPEED, -end.velocity])
}

/// Whether a slipping contact's friction is on the cone of its own normal impulse: not where it lags behind it, nor where the law softens
/// it with that impulse.
pub(super) fn on_the_cone(bench: &Bench) -> bool {
    let option = bench.description().options.get("approximation").and_then(serde_json::Value::as_str);
    let regularised = matches!(Model::of(bench.description()), Model::DrakeRegularised { .. });
    !(regularised && option != Some("tamsi"))
}

/// Whether a contact that can hold both bodies ends without slip: not one that yields along the surface.
pub(super) fn sticks(bench: &Bench) -> bool {
    bench.description().contact_model.kind == Kind::Rigid
}

/// [low, high] of ‖p_t‖/(μ p_n) under slip, where the declared friction is that of a pyramid or the contact is softer along some edges.
pub(super) fn pyramid(bench: &Bench) -> Option<[f64; 2]> {
    match (Model::of(bench.description()), bench.description().friction) {
        (Model::StewartTrinkle { directions }, _) => Some([1.0 - polyhedral::strength_error(directions), 1.0]),
        // all four edges press, those across the slip and the one against it without friction along it
        (Model::Mujoco(_), Friction::Pyramid) => Some([0.0, 1.0]),
        (_, Friction::Pyramid) => Some([FRAC_1_SQRT_2, SQRT_2]),
        _ => None,
    }
}

/// ‖p_t‖/p_n = μ, and what the declared friction gives instead; the measured components are off by `turned` of themselves.
pub(super) fn slipping(bench: &Bench, friction: f64, turned: f64) -> (Expectation, Option<Expectation>) {
    let allowed = (tolerance::ratio(bench.epsilon()) + turned) * friction;
    let law = pyramid(bench).map(|[low, high]| {
        let (low, high) = (low * friction, high * friction);
        Expectation::equal(0.5 * (low + high), 0.5 * (high - low) + allowed, "friction of the declared pyramid")
    });
    (Expectation::equal(friction, allowed, "μ, whatever the normal impulse"), law)
}

/// ‖p_t‖ over what stops the slip; the levers are off by `lever` of themselves, and the measured component by `turned`.
pub(super) fn sticking(bench: &Bench, lever: f64, turned: f64) -> (Expectation, Option<Expectation>) {
    let allowed = tolerance::stick(lever, bench.epsilon()) + turned;
    let mixing = match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.force_mixing,
        _ => 0.0,
    };
    let law = (mixing > 0.0).then(|| Expectation::equal(1.0 - 0.5 * mixing, allowed + 0.5 * mixing, "the declared force mixing"));
    (Expectation::equal(1.0, allowed, "u_t/W_t, whatever the normal impulse"), law)
}

/// Prediction of a replayed ratio; the levers of the replay are off by `lever` of themselves, and the measured components by `turned`.
pub(super) fn of_the_replay(value: f64, lever: f64, turned: f64, bench: &Bench) -> Expectation {
    Expectation::equal(value, value * (tolerance::stick(lever, bench.epsilon()) + turned), "replay of the declared law's discrete map")
}

/// Angle \[rad\] between friction and the slip it opposes.
pub(super) fn opposed(bench: &Bench) -> (Expectation, Option<Expectation>) {
    let most = match (Model::of(bench.description()), bench.description().friction) {
        (Model::StewartTrinkle { directions }, _) => PI / directions as f64,
        (_, Friction::Pyramid) => 0.25 * PI,
        _ => 0.0,
    };
    let allowed = tolerance::direction(bench.epsilon());
    let law = (most > 0.0).then(|| Expectation::at_most(most, allowed, "the next edge of the declared pyramid"));
    (Expectation::at_most(0.0, allowed, "friction is opposed to the slip"), law)
}

/// Whether a contact opens by its slip, so that it may end before it sticks.
pub(super) fn opens(bench: &Bench) -> bool {
    convex(&Model::of(bench.description()))
}
