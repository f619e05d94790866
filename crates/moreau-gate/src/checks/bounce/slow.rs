//! A ball on the floor at four speeds, and at every time step.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{self, RESTITUTION, SPEED, steps_to_impact, weightless};
use crate::checks::scenery::sphere;
use crate::runner::SWEEP;
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::Body;
use moreau_exact::number::significant;

/// \[m/s\]; a little off 0.02, 0.05, 0.2 and 1 m/s.
pub(super) const SPEEDS: [f64; 4] = [0.021, 0.053, 0.21, 1.07];
/// \[m\]
const RADIUS: f64 = 0.1;
/// Gap before the impact \[m\]: larger than the contact margin of any engine; at none of the speeds a whole number of steps.
pub(super) const GAP: f64 = 0.0473;

pub(super) fn slow(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    SPEEDS.iter().map(|speed| bounced(bench, GAP, *speed, h, format!("restitution at {speed} m/s"))).collect()
}

pub(super) fn every_step(bench: &mut Bench) -> Reply<Vec<Measurement>> {
    SWEEP.iter().map(|h| bounced(bench, scene::GAP, SPEED, *h, format!("restitution at h = {} s", significant(*h)))).collect()
}

/// v⁺/v of the ball.
fn bounced(bench: &mut Bench, gap: f64, speed: f64, h: f64, quantity: String) -> Reply<Measurement> {
    let body = Body { linear_velocity: [0.0, 0.0, -speed], ..sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + gap]) };
    let steps = steps_to_impact(bench, gap, speed, h)?;
    let motion = bench.simulate(&weightless("bouncing ball", body, 0.0), h, steps, steps)?;
    let after = motion.bodies[0].linear_velocity[1][2] / speed;
    let allowed = tolerance::velocity(bench.epsilon());
    let declared = Declared::of(bench, speed, steps as f64 * h, h).map(|law| law.rebound(allowed));
    let newton = Expectation::equal(RESTITUTION, allowed, "v⁺ = −e v");
    Ok(Measurement::new(quantity, "1", after, newton).predicted(declared))
}
