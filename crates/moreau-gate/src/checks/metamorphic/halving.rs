//! The same motion at h and at h/2.

use crate::checks::metamorphic::allowance::SAMPLES;
use crate::checks::metamorphic::compare::difference;
use crate::checks::metamorphic::scenes::{DURATION, FRICTION, SPEED, slide};
use crate::checks::scenery::{GRAVITY, distance, schedule, worst};
use crate::tolerance::metamorphic as tolerance;
use crate::{Bench, Expectation, Kind, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// Approach speed of the landing \[m/s\]: √(0.23² + 2 g 0.0037) < 0.36.
const LANDING: f64 = 0.36;

pub(super) fn run(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (steps, every) = schedule(DURATION, SAMPLES, h);
    let coarse = bench.simulate(&block(), h, steps, every)?;
    let fine = bench.simulate(&block(), 0.5 * h, 2 * steps, 2 * every)?;
    let normal_impulse = LANDING + GRAVITY * DURATION;
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let hop = compliant.then_some(LANDING.max(FRICTION * SPEED));
    let velocity = tolerance::halved_velocity(FRICTION, GRAVITY, h) + tolerance::velocity(SPEED, GRAVITY, DURATION);
    let position = tolerance::halved_position(LANDING, FRICTION, normal_impulse, h) + DURATION * velocity;
    let why = "first order in h";
    let law = |per_speed: f64, allowed: f64| {
        hop.map(|hop| Expectation::at_most(per_speed * hop, allowed, "a compliant contact rebounds, or hops at up to μ‖v_t‖"))
    };
    // Friction takes or spares μ times the speed of the rebound, in either motion.
    Ok(vec![
        Measurement::new(
            "change of the sliding velocity at the end, h against h/2",
            "m/s",
            slid(&coarse, &fine),
            Expectation::equal(0.0, velocity, why),
        )
        .predicted(law(2.0 * FRICTION, velocity)),
        Measurement::new(
            "largest change in position, h against h/2",
            "m",
            difference(&coarse, &fine).position,
            Expectation::equal(0.0, position, why),
        )
        .predicted(law(2.0 * DURATION, position)),
    ])
}

/// The block of the scene alone: it never stops sliding, so that no event separates the two motions.
fn block() -> Scene {
    let mut scene = slide();
    scene.bodies.retain(|body| body.name == "block");
    scene
}

/// Largest difference of the horizontal velocities at the end \[m/s\].
fn slid(coarse: &Trajectory, fine: &Trajectory) -> f64 {
    crate::checks::scenery::paired(coarse, fine).fold(0.0, |largest, (a, b)| {
        let last =
            |track: &moreau_dynamics::trajectory::BodyTrack| track.linear_velocity.last().map_or([f64::NAN; 3], |v| [v[0], v[1], 0.0]);
        worst(largest, distance(last(a), last(b)))
    })
}
