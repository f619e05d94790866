//! What the scenes of this family share: one body over the floor without gravity, and the steps until its impact is over.

use crate::checks::scenery::over_floor;
use crate::model::Model;
use crate::{Bench, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Scene};

/// e.
pub(super) const RESTITUTION: f64 = 0.5;
/// \[m/s\]; no engine's threshold of restitution.
pub(super) const SPEED: f64 = 2.5;
/// Gap before an impact of a body of some metres \[m\]: larger than the contact margin of any engine, also one that grows with the body.
/// At [`SPEED`] it is no whole number of steps, because rounding would then decide the step of the impact.
pub(super) const GAP: f64 = 0.1937;
/// Steps within which an impact has been found and is over, from the step in which the gap closes.
pub(super) const PATIENCE: usize = 3;

/// One body over the floor without gravity.
pub(super) fn weightless(name: &str, body: Body, friction: f64) -> Scene {
    let mut scene = Scene { gravity: [0.0; 3], ..over_floor(name, vec![body], friction) };
    scene.material.restitution = RESTITUTION;
    scene
}

/// Steps of h \[s\] from the start until an impact over `gap` \[m\] at `speed` \[m/s\] is over. Declared damping c delays it to
/// T = −ln(1 − c·gap/v)/c, and a step of it by at most h more for each 1/c.
///
/// # Errors
/// `unsupported` if declared damping stops the body before it arrives.
pub(super) fn steps_to_impact(bench: &Bench, gap: f64, speed: f64, h: f64) -> Reply<usize> {
    let damping = Model::of(bench.description()).damping().map_or(0.0, |(linear, _)| linear);
    let lost = damping * gap / speed;
    if lost >= 1.0 {
        return Err(Refusal::unsupported("the declared damping stops the body before its impact"));
    }
    let time = if damping > 0.0 { -(-lost).ln_1p() / damping } else { gap / speed };
    Ok((time / h + damping * time).ceil() as usize + PATIENCE)
}
