//! A stored MuJoCo motion again, by our scheme with our own contact geometry and our own Newton.
//!
//! Gaps and points of a sphere and of a box's corners on a plane are the engine's; two boxes on each other meet at the same corners. What
//! the engine does not determine itself (rounding amplified by the motion, its stopping rule) is measured and stored with each file.

use crate::document::Document;
use crate::soft_step::softness;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::schemes::mujoco::{Cone, Mujoco};
use moreau::schemes::run;
use moreau::solvers::GaussNewton;
use moreau::trajectory::Trajectory;
use nalgebra::Vector3;
use serde_json::Value;

/// Steps of a stack that are simulated again; a longer run would tell no more and take minutes.
const STACK_STEPS: usize = 500;

/// Largest distance of positions and velocities from the stored ones.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    if document.engine() != "mujoco" || !document.config().starts_with("newton") {
        return Ok(Vec::new());
    }
    let cone = if document.config().contains("pyramidal") { Cone::Pyramidal } else { Cone::Elliptic };
    let scheme = Mujoco { cone, softness: softness(&Value::Object(trajectory.engine.options.clone()))? };
    let [steps, every] = ["steps", "sample_every"].map(|key| document.number(&["provenance", key]));
    let (mut steps, every) = (steps? as usize, every? as usize);
    if trajectory.scene.bodies.len() > 1 {
        steps = steps.min(STACK_STEPS);
    }
    let (mechanism, start) = trajectory.scene.spatial_mechanism()?;
    let (mut worst, mut n) = ([0.0f64; 2], 0usize);
    let observe = |state: &moreau::mechanics::State, _: &[moreau::contact::ContactImpulse]| {
        n += 1;
        if !n.is_multiple_of(every) {
            return;
        }
        for (body, track) in mechanism.bodies(&state.position, &state.velocity).iter().zip(&trajectory.bodies) {
            let far = |ours: [f64; 3], theirs: [f64; 3]| (Vector3::from(ours) - Vector3::from(theirs)).amax();
            worst[0] = worst[0].max(far(body.position, track.position[n / every]));
            worst[1] = worst[1].max(far(body.linear_velocity, track.linear_velocity[n / every]));
        }
    };
    run(&scheme, &GaussNewton::default(), mechanism.as_ref(), start, trajectory.time_step, steps, observe)?;
    let size = |of: &dyn Fn(&moreau::trajectory::BodyTrack) -> Vec<[f64; 3]>| {
        trajectory.bodies.iter().flat_map(of).map(|x| Vector3::from(x).amax()).fold(0.0, f64::max)
    };
    let (place, speed) = (size(&|track| track.position.clone()), size(&|track| track.linear_velocity.clone()));
    Ok(vec![
        Finding::at_most("position against our scheme", worst[0], document.accuracy("bodies/position", place)?, "m"),
        Finding::at_most("velocity against our scheme", worst[1], document.accuracy("bodies/linear_velocity", speed)?, "m/s"),
    ])
}
