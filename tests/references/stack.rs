//! The stack of five boxes: every interface carries the weight above it, and each sinks by its own model's rest depth.
//!
//! Four corners share the load: MuJoCo k d² δ = (1 − d) Â f with f a quarter of it, Â = 1/m on the ground and 2/m between two boxes
//! (a pyramid: ½μ²(1+μ²) of that); Drake f = k δ on the ground. Signorini's stack does not sink.

use crate::document::Document;
use crate::dumps_native::parameters;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::trajectory::Trajectory;
use serde_json::Value;

/// Interface impulses and depths at the end of the run.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let scene = &trajectory.scene;
    let (boxes, last) = (scene.bodies.len(), trajectory.times.len() - 1);
    let gravity = -scene.gravity[2];
    let interval = trajectory.times[last] - trajectory.times[last - 1];
    let height = |body: usize| trajectory.bodies[body].position[last][2];
    let accuracy = document.accuracy("bodies/position", height(boxes - 1))?;
    let mut findings = Vec::new();
    for lower in 0..boxes {
        let above = (boxes - lower) as f64 * scene.bodies[lower].mass;
        let upper_half = scene.bodies[lower].cuboid.ok_or("the stack is of boxes")?.half_extents[2];
        let below = match lower {
            0 => 0.0,
            _ => height(lower - 1) + scene.bodies[lower - 1].cuboid.ok_or("the stack is of boxes")?.half_extents[2],
        };
        let depth = below + upper_half - height(lower);
        let name = &scene.bodies[lower].name;
        let carried: f64 = impulses(trajectory, last, name, lower.checked_sub(1).map(|k| scene.bodies[k].name.as_str()));
        let impulse_accuracy = document.accuracy("contacts/impulse", above * gravity * interval)?;
        let label = format!("normal impulse under {name} against the weight above");
        findings.push(Finding::equal(label, carried, above * gravity * interval, impulse_accuracy, "N·s"));
        if let Some(expected) = model_depth(document, trajectory, lower, above * gravity)? {
            let label = format!("depth under {name} (Signorini: 0) against its own model");
            findings.push(Finding::equal(label, depth, expected, 2.0 * accuracy, "m"));
        }
    }
    Ok(findings)
}

/// Normal impulse that the body below (or the ground) gives to `name` in the last interval.
fn impulses(trajectory: &Trajectory, sample: usize, name: &str, below: Option<&str>) -> f64 {
    let other = below.unwrap_or("ground");
    let of_pair = |bodies: &[String; 2]| match (bodies[0].as_str(), bodies[1].as_str()) {
        (a, b) if a == name && b == other => 1.0,
        (a, b) if a == other && b == name => -1.0,
        _ => 0.0,
    };
    trajectory.contacts.iter().filter(|contact| contact.sample == sample).map(|contact| of_pair(&contact.bodies) * contact.impulse[2]).sum()
}

/// Depth of one interface under a load \[N\] on four corners, where the model is known in closed form.
fn model_depth(document: &Document, trajectory: &Trajectory, lower: usize, load: f64) -> Result<Option<f64>, Failed> {
    let mass = trajectory.scene.bodies[lower].mass;
    if document.engine() == "drake" {
        let stiffness = trajectory.engine.options.get("stiffness").and_then(Value::as_f64).ok_or("no stiffness stored")?;
        return Ok((lower == 0).then_some(0.25 * load / stiffness));
    }
    let parameters = parameters(&Value::Object(trajectory.engine.options.clone()))?;
    let normal = if lower == 0 { 1.0 / mass } else { 2.0 / mass };
    let diagonal = if document.config().contains("pyramidal") {
        0.25 * parameters.pyramid_diagonal(normal, trajectory.scene.material.friction)
    } else {
        normal
    };
    Ok(Some(parameters.rest_depth(trajectory.time_step, diagonal, 0.25 * load)?))
}
