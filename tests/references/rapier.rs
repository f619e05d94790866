//! Rapier's stored motions: the ball substep by substep, friction, rest depths and the stack in closed form.
//!
//! `DIFFERENCE` from Signorini's: every point rests on a spring of 60 Hz (30 Hz between bodies), W N/ω² deep, at every h.
//! `DIFFERENCE` from Coulomb's at the start of a slide: the one sweep of a substep stops the slip of a block that has just touched by
//! turning it, with less than the friction it may use, 0.92 mm/s too fast at h = 10 ms and 0.37 mm/s at 5 ms; with 50 sweeps (`sweeps`)
//! there is none of it, and later none either. `DIFFERENCE` from Coulomb's under the model `coulomb`: friction of a corner is not opposed
//! to its slip, and the block is 47 % too fast. `DIFFERENCE` in the stack: a point seen before it closes is rigid and carries its load
//! without depth, so that the boxes rest tilted; where points are seen only once they close (`unpredicted`) every interface goes to its
//! rest depth.

use crate::block::{self, Block};
use crate::document::Document;
use crate::{momentum, planted};
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::closed_forms::rapier_contact::{RapierBall, RapierContact, opposing_share, rest_depth};
use moreau::systems::replay::option;
use moreau::tolerance::references as tolerance;
use moreau::trajectory::Trajectory;
use nalgebra::Vector3;

/// Every finding about one stored motion of Rapier.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let findings = planted::caught(trajectory, |trajectory| own(document, trajectory))?;
    // only this model reports contact impulses
    let reported = if document.config() == "coulomb" { momentum::check(document, trajectory)? } else { vec![] };
    Ok([findings, reported].concat())
}

fn own(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    match (trajectory.scene.name.as_str(), document.config()) {
        ("ball_bounce" | "ball_rest" | "ball_sunk", _) => ball(document, trajectory),
        ("block_stick", _) => Ok(vec![stick(document, trajectory)?, block_depth(document, trajectory)?]),
        ("block_slide", "coulomb") => Ok(vec![misdirected(document, trajectory)?, block_depth(document, trajectory)?]),
        ("block_slide", _) => {
            let mut findings = slide(document, trajectory)?;
            findings.push(block_depth(document, trajectory)?);
            Ok(findings)
        }
        ("five_box_stack", "default") => leaning(trajectory),
        ("five_box_stack", _) => stack(document, trajectory),
        (other, _) => Err(format!("no check of Rapier knows the scene `{other}`").into()),
    }
}

/// The ball's whole motion, substep by substep.
fn ball(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let (scene, track) = (&trajectory.scene, &trajectory.bodies[0]);
    let radius = scene.bodies[0].sphere.ok_or("the ball is a sphere")?.radius;
    let contact = RapierContact {
        time_step: trajectory.time_step,
        substeps: option(trajectory, "solver_iterations")? as usize,
        frequency: option(trajectory, "ground_contact_frequency")?,
        damping_ratio: option(trajectory, "ground_contact_damping_ratio")?,
        largest_push: option(trajectory, "max_corrective_velocity")?,
        prediction: option(trajectory, "prediction_distance")?,
        radius,
        restitution: scene.material.restitution,
        gravity: -scene.gravity[2],
        mass: scene.bodies[0].mass,
    };
    let mut ball = RapierBall { height: track.position[0][2], velocity: track.linear_velocity[0][2], ..RapierBall::default() };
    let (mut apart, mut speed) = ([0.0f64; 2], 0.0f64);
    for (place, velocity) in track.position.iter().zip(&track.linear_velocity).skip(1) {
        contact.step(&mut ball);
        speed = speed.max(ball.velocity.abs());
        apart = [apart[0].max((ball.height - place[2]).abs()), apart[1].max((ball.velocity - velocity[2]).abs())];
    }
    let steps = document.number(&["provenance", "steps"])? as usize;
    let substep = trajectory.time_step / contact.substeps as f64;
    let allowed = tolerance::sample_rounding(steps * contact.substeps, speed + track.position[0][2] / substep);
    Ok(vec![
        Finding::at_most("velocities against Rapier's substeps", apart[1], allowed, "m/s"),
        Finding::at_most("heights against Rapier's substeps", apart[0], scene.duration * allowed, "m"),
    ])
}

/// How far a number has moved over the last third of the motion: what decays, and at least halves in that time, has no more than this to
/// go.
fn left(number: impl Fn(usize) -> f64, last: usize) -> f64 {
    (2 * last / 3..last).map(|sample| (number(sample) - number(last)).abs()).fold(0.0, f64::max)
}

/// A block that sticks: its speed dies out.
fn stick(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let last = trajectory.times.len() - 1;
    let block = Block::at(trajectory, last)?;
    let along = |sample: usize| Vector3::from(trajectory.bodies[0].linear_velocity[sample]).dot(&block.slope);
    let allowed = left(along, last) + document.accuracy("bodies/linear_velocity", block.pull * trajectory.time_step)?;
    Ok(Finding::equal("speed of the block that sticks (Coulomb: 0)", along(last), 0.0, allowed, "m/s"))
}

/// Four corners of a block at their rest depth; a tilt by the moment of friction changes their levers a by at most the depth δ, and loads
/// and levers together the mean depth by δ²/a.
fn block_depth(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let last = trajectory.times.len() - 1;
    let block = Block::at(trajectory, last)?;
    let lever = block.rotation.tr_mul(&block.corners(0.0)[0]);
    let inertia = block.inertia();
    let response = 1.0 / block.mass + lever.y.powi(2) / inertia.x + lever.x.powi(2) / inertia.y;
    let expected = rest_depth(option(trajectory, "ground_contact_frequency")?, response, block.mass * block.press / 4.0);
    let depth = |sample: usize| block.half.z - Vector3::from(trajectory.bodies[0].position[sample]).dot(&block.normal);
    let tilted = expected * expected / block.half.x;
    let allowed = document.accuracy("bodies/position", block.position.norm())? + left(depth, last) + tilted;
    Ok(Finding::equal("depth of the block (Signorini: 0) against Rapier's springs", depth(last), expected, allowed, "m"))
}

/// v_t + μ v_n = g (sin α − μ cos α) t from the first sample after the landing on; with 50 sweeps from the start.
fn slide(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    if document.config() == "sweeps" {
        return block::slide(document, trajectory);
    }
    let block = Block::at(trajectory, 0)?;
    let friction = trajectory.scene.material.friction;
    let exact = block.pull - friction * block.press;
    let ahead = |sample: usize| {
        let velocity = Vector3::from(trajectory.bodies[0].linear_velocity[sample]);
        velocity.dot(&block.slope) + friction * velocity.dot(&block.normal) - exact * trajectory.times[sample]
    };
    let changed = (2..trajectory.times.len()).map(|sample| (ahead(sample) - ahead(1)).abs()).fold(0.0, f64::max);
    let steps = document.number(&["provenance", "steps"])? as usize;
    let rounding = tolerance::sample_rounding(4 * steps, exact * trajectory.scene.duration);
    // in the step of the landing friction is between none and all it may be
    let landing = friction * block.press * trajectory.time_step;
    Ok(vec![
        Finding::at_most("v_t + μ v_n against g (sin α − μ cos α) t after the landing", changed, rounding, "m/s"),
        Finding::at_most("v_t + μ v_n too much in the landing (Coulomb: 0)", ahead(1), landing, "m/s"),
        Finding::decision("the landing uses all of the friction", ahead(1) <= rounding, false),
    ])
}

/// The last interval's acceleration with friction along the impulse that would stop each corner: g (sin α − μ cos α e₁·K⁻¹e₁/‖K⁻¹e₁‖); K is
/// taken halfway between the corner and the plane, as deep as the spring lets it, and the corners' loads differ by the moment of friction,
/// which turns K by no more than the depth.
fn misdirected(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let last = trajectory.times.len() - 1;
    let [before, block] = [Block::at(trajectory, last - 1)?, Block::at(trajectory, last)?];
    let depth = block.half.z - block.position.dot(&block.normal);
    let lever = block.corners(0.0)[0] + block.normal * (0.5 * depth);
    let share = opposing_share(block.tangential_response(&lever));
    let expected = block.pull - trajectory.scene.material.friction * block.press * share;
    let interval = trajectory.times[last] - trajectory.times[last - 1];
    let found = (block.velocity - before.velocity).dot(&block.slope) / interval;
    let allowed = document.accuracy("bodies/linear_velocity", 1.0)? * 2.0 / interval
        + trajectory.scene.material.friction * block.press * depth / block.half.z;
    Ok(Finding::equal("acceleration (Coulomb: 0.5897 m/s²) against friction along the stopping impulse", found, expected, allowed, "m/s²"))
}

/// Depth of every interface against the springs.
fn stack(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let last = trajectory.times.len() - 1;
    let bodies = &trajectory.scene.bodies;
    let mut findings = Vec::new();
    for (upper, body) in bodies.iter().enumerate() {
        let (expected, depth) = interface(trajectory, upper)?;
        let allowed = left(&depth, last) + document.accuracy("bodies/position", trajectory.bodies[upper].position[last][2])?;
        let name = format!("depth under {} (Signorini: 0) against Rapier's springs", body.name);
        findings.push(Finding::equal(name, depth(last), expected, allowed, "m"));
    }
    Ok(findings)
}

/// The rest depth of an interface with four points, and the depth at a sample.
fn interface(trajectory: &Trajectory, upper: usize) -> Result<(f64, impl Fn(usize) -> f64), Failed> {
    let bodies = &trajectory.scene.bodies;
    let half = |body: usize| bodies[body].cuboid.map(|cuboid| cuboid.half_extents).ok_or("the stack is of boxes");
    let [x, y, _] = half(upper)?;
    let mut response = 0.0;
    for body in [Some(upper), upper.checked_sub(1)].into_iter().flatten() {
        let [a, b, c] = half(body)?;
        response += (1.0 + 3.0 * y * y / (b * b + c * c) + 3.0 * x * x / (a * a + c * c)) / bodies[body].mass;
    }
    let load = -trajectory.scene.gravity[2] * bodies[upper..].iter().map(|body| body.mass).sum::<f64>();
    let frequency = option(trajectory, if upper == 0 { "ground_contact_frequency" } else { "contact_frequency" })?;
    let height = half(upper)?[2] + if upper > 0 { half(upper - 1)?[2] } else { 0.0 };
    let place = move |body: usize, sample: usize| trajectory.bodies[body].position[sample][2];
    let depth = move |sample: usize| height - place(upper, sample) + if upper > 0 { place(upper - 1, sample) } else { 0.0 };
    Ok((rest_depth(frequency, response, load / 4.0), depth))
}

/// Where points are seen before they close, the lowest box stands tilted on two sunk points and two rigid ones: at half the depth of four
/// sunk ones, and tilted by their depth over its width. The boxes above stand beside its middle by x̄ and shift its load by that over its
/// half width.
fn leaning(trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let last = trajectory.times.len() - 1;
    let (expected, depth) = interface(trajectory, 0)?;
    let half = trajectory.scene.bodies[0].cuboid.ok_or("the stack is of boxes")?.half_extents[0];
    let beside = trajectory.bodies.iter().map(|body| body.position[last][0].hypot(body.position[last][1])).sum::<f64>();
    let allowed = 0.5 * expected * beside / (trajectory.bodies.len() as f64 * half) + left(&depth, last);
    let [w, x, y, z] = trajectory.bodies[0].orientation[last];
    let tilt = 2.0 * (x * x + y * y + z * z).sqrt().atan2(w.abs());
    let on_two = "depth of the lowest box (on four sunk points: twice that) against two sunk points";
    let turned = "tilt of the lowest box (on four sunk points: 0) against two sunk points";
    Ok(vec![
        Finding::equal(on_two, depth(last), expected / 2.0, allowed, "m"),
        Finding::equal(turned, tilt, expected / (2.0 * half), allowed / half, "rad"),
    ])
}
