//! What holds for every engine whatever its contact model: m Δv = m g Δt + Σ impulses, impulses push and stay in the friction cone.

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::systems::replay::option;
use moreau::tolerance::references as tolerance;
use moreau::trajectory::Trajectory;
use nalgebra::{DMatrix, Vector3};
use std::collections::HashMap;

/// Momentum of every body over every sample interval, sign and cone of every contact impulse.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let scene = &trajectory.scene;
    let gravity = Vector3::from(scene.gravity);
    let mut received: HashMap<(usize, &str), Vector3<f64>> = HashMap::new();
    let (mut pull, mut outside, mut largest) = (0.0f64, 0.0f64, 0.0f64);
    for contact in &trajectory.contacts {
        let (impulse, normal) = (Vector3::from(contact.impulse), Vector3::from(contact.normal));
        let pressed = impulse.dot(&normal);
        let tangential = (impulse - normal * pressed).norm();
        pull = pull.max(-pressed);
        outside = outside.max(tangential - scene.material.friction * pressed);
        largest = largest.max(impulse.norm());
        let [a, b] = &contact.bodies;
        *received.entry((contact.sample, a)).or_default() += impulse;
        *received.entry((contact.sample, b)).or_default() -= impulse;
    }
    let mut defect = 0.0f64;
    for (body, track) in scene.bodies.iter().zip(&trajectory.bodies) {
        for k in 1..trajectory.times.len() {
            let change = Vector3::from(track.linear_velocity[k]) - Vector3::from(track.linear_velocity[k - 1]);
            let weight = gravity * (trajectory.times[k] - trajectory.times[k - 1]);
            let impulse = received.get(&(k, body.name.as_str())).copied().unwrap_or_default();
            defect = defect.max(((change - weight) * body.mass - impulse).norm());
        }
    }
    let impulses = document.accuracy("contacts/impulse", largest)?;
    let every = document.number(&["provenance", "sample_every"])?;
    let velocities = document.accuracy("bodies/linear_velocity", largest)?;
    let unbalanced = unbalanced(document, trajectory, every)? + last_change(document, trajectory, every)?;
    let mut findings = vec![
        Finding::at_most("m Δv − m g Δt − Σ impulses", defect, impulses + velocities + unbalanced, "N·s"),
        Finding::at_most("pulling impulse", pull, impulses, "N·s"),
    ];
    // Lagged bounds friction by the normal impulse of the step before, so it leaves the cone whenever the load falls: no such promise to
    // check.
    if document.config() != "lagged" {
        findings.push(Finding::at_most("impulse outside the friction cone, ‖r_t‖ − μ r_n", outside, impulses, "N·s"));
    }
    Ok(findings)
}

/// Momentum \[N·s\] of one body by which TAMSI's impulses, of the velocities before its last iteration, may be off those of its answer in a
/// number of steps.
fn last_change(document: &Document, trajectory: &Trajectory, steps: f64) -> Result<f64, Failed> {
    if document.config() != "tamsi" {
        return Ok(0.0);
    }
    let heaviest = trajectory.scene.bodies.iter().map(|body| body.mass).fold(0.0, f64::max);
    let stiction = option(trajectory, "stiction_tolerance")?;
    Ok(heaviest.sqrt() * steps * tolerance::tamsi_velocity(&DMatrix::from_element(1, 1, heaviest), stiction))
}

/// Momentum \[N·s\] of one body that the engine's stopping rule may leave unbalanced in a number of steps.
pub fn unbalanced(document: &Document, trajectory: &Trajectory, steps: f64) -> Result<f64, Failed> {
    let scene = &trajectory.scene;
    let heaviest = scene.bodies.iter().map(|body| body.mass).fold(0.0, f64::max);
    let total: f64 = scene.bodies.iter().map(|body| body.mass).sum();
    let h = trajectory.time_step;
    match (document.engine(), document.config().split('-').next()) {
        ("mujoco", Some("cg")) => {
            let option = trajectory.engine.options.get("tolerance").and_then(serde_json::Value::as_f64).ok_or("no tolerance stored")?;
            // Three translations and three rotations of a body; its moments of inertia (below 0.01 kg·m²) add less than its mass once more.
            let rows = 12.0 * scene.bodies.len() as f64;
            Ok(tolerance::cg_momentum(option, rows, 4.0 * total, heaviest, h, steps))
        }
        ("drake", Some("sap" | "similar" | "lagged")) => {
            let gravity = Vector3::from(scene.gravity).norm();
            let fastest = trajectory.bodies.iter().flat_map(|track| &track.linear_velocity).map(|v| Vector3::from(*v).norm());
            Ok(tolerance::sap_momentum(heaviest, total, fastest.fold(0.0, f64::max) + gravity * h, steps))
        }
        _ => Ok(0.0),
    }
}
