//! A stored MuJoCo motion again, by our scheme with our own contact geometry and our own Newton: every integrator, with and without torsion
//! and rolling.
//!
//! Gaps and points of a sphere and of a box's corners on a plane are the engine's; two boxes on each other meet at the same corners. What
//! the engine does not determine itself (rounding amplified by the motion, its stopping rule) is measured and stored with each file.

use crate::document::Document;
use crate::soft_step::{is_converged, softness};
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::scenes::{Body, Cuboid};
use moreau::schemes::mujoco::{Cone, Integrator, Mujoco, Rotational};
use moreau::schemes::run;
use moreau::solvers::GaussNewton;
use moreau::tolerance::references::{REPLAYED_MOTION, replayed_step};
use moreau::tolerance::rounding;
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
    let scheme = scheme(&Value::Object(trajectory.engine.options.clone()))?;
    let [steps, every] = ["steps", "sample_every"].map(|key| document.number(&["provenance", key]));
    let (mut steps, every) = (steps? as usize, every? as usize);
    if trajectory.scene.bodies.len() > 1 {
        steps = steps.min(STACK_STEPS);
    }
    let (mechanism, start) = trajectory.scene.spatial_mechanism()?;
    let (mut worst, mut n) = ([0.0f64; 3], 0usize);
    let observe = |step: &moreau::schemes::Step| {
        let state = &step.state;
        n += 1;
        if !n.is_multiple_of(every) {
            return;
        }
        for (body, track) in mechanism.bodies(&state.position, &state.velocity).iter().zip(&trajectory.bodies) {
            let far = |ours: [f64; 3], theirs: [f64; 3]| (Vector3::from(ours) - Vector3::from(theirs)).amax();
            worst[0] = worst[0].max(far(body.position, track.position[n / every]));
            worst[1] = worst[1].max(far(body.linear_velocity, track.linear_velocity[n / every]));
            worst[2] = worst[2].max(far(body.angular_velocity, track.angular_velocity[n / every]));
        }
    };
    run(&scheme, &GaussNewton::default(), mechanism.as_ref(), start, trajectory.time_step, steps, observe)?;
    let size = |of: &dyn Fn(&moreau::trajectory::BodyTrack) -> Vec<[f64; 3]>| {
        trajectory.bodies.iter().flat_map(of).map(|x| Vector3::from(x).amax()).fold(0.0, f64::max)
    };
    let place = size(&|track| track.position.clone());
    let speed = size(&|track| track.linear_velocity.clone());
    let spin = size(&|track| track.angular_velocity.clone());
    // what our own Newton leaves in one step, as the speed of the lightest lever; contacts damp it within some steps
    let gyration = trajectory.scene.bodies.iter().map(smallest_gyration).fold(f64::INFINITY, f64::min);
    // a gap of two boxes is some sixteen operations on coordinates of the size of the places, and its rounding a kick of h k d φ at a
    // corner
    let gap = rounding(16, place);
    let kick = softness(&Value::Object(trajectory.engine.options.clone()))?.reference_acceleration(trajectory.time_step, -gap, &[0.0])[0];
    let own = (replayed_step(speed) + trajectory.time_step * kick.abs()) / gyration;
    let mut findings = vec![
        Finding::at_most("position against our scheme", worst[0], document.accuracy("bodies/position", place)?, "m"),
        Finding::at_most("velocity against our scheme", worst[1], document.accuracy("bodies/linear_velocity", speed)?, "m/s"),
        Finding::at_most(
            "angular velocity against our scheme",
            worst[2],
            document.accuracy("bodies/angular_velocity", spin)? + own,
            "rad/s",
        ),
    ];
    if is_converged(document) {
        findings.push(Finding::at_most("position against our scheme, engine run to the end", worst[0], REPLAYED_MOTION, "m"));
    }
    Ok(findings)
}

/// √(J/m) about the axis of least inertia \[m\].
fn smallest_gyration(body: &Body) -> f64 {
    let square = match (body.sphere, body.cuboid) {
        (Some(sphere), _) => 0.4 * sphere.radius * sphere.radius,
        (_, Some(Cuboid { half_extents: mut half })) => {
            half.sort_by(f64::total_cmp);
            (half[0] * half[0] + half[1] * half[1]) / 3.0
        }
        _ => 0.0,
    };
    square.sqrt()
}

/// Our scheme with everything a run was given.
pub fn scheme(options: &Value) -> Result<Mujoco, Failed> {
    let integrator = options["integrator"].as_str().ok_or("options.integrator is a name")?;
    let length = |key: &str| options[key].as_f64().unwrap_or(0.0);
    Ok(Mujoco {
        cone: Cone::by_name(options["cone"].as_str().ok_or("options.cone is a name")?)?,
        softness: softness(options)?,
        rotational: Rotational { torsional: length("torsional"), rolling: length("rolling") },
        integrator: Integrator::by_name(&integrator.to_lowercase())?,
    })
}
