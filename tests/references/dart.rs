//! DART's stored motions, replayed along the line of gravity from its own law, and its friction in closed form.
//!
//! `DIFFERENCE` from Newton's law: the rebound takes e of the velocity after gravity has acted in the step, e(|v| + g h), softened by the
//! mixing c. `DIFFERENCE` from Coulomb's: a contact point that sticks creeps, c W_tt r_t, since the mixing softens friction too; O(h), as
//! r_t is. `DIFFERENCE` from Signorini's: a depth goes down by ERP a step and not at once, by 1 mm/s at most while fewer than three bodies
//! hang together. A stack of five at h = 5 ms is not stored: the default solver misses the solution of one step in 200, of another one when
//! the start moves by 10⁻¹² m.

use crate::block::Block;
use crate::document::Document;
use crate::{momentum, planted};
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::closed_forms::dart_column::{Column, ColumnParameters, Interface};
use moreau::systems::replay::option;
use moreau::tolerance::references as tolerance;
use moreau::trajectory::Trajectory;
use nalgebra::{DVector, Vector3};

/// Every finding about one stored motion of DART.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let own = |trajectory: &Trajectory| -> Result<Vec<Finding>, Failed> {
        let mut findings = replay(document, trajectory)?;
        findings.extend(match trajectory.scene.name.as_str() {
            "ball_bounce" => vec![rebound(document, trajectory)?],
            "block_slide" => vec![slide(document, trajectory)?],
            "block_stick" => vec![creep(document, trajectory)?],
            _ => vec![],
        });
        Ok(findings)
    };
    Ok([momentum::check(document, trajectory)?, planted::caught(trajectory, own)?].concat())
}

fn parameters(trajectory: &Trajectory) -> Result<ColumnParameters, Failed> {
    Ok(ColumnParameters {
        error_reduction: option(trajectory, "error_reduction")?,
        correction_speed: option(trajectory, "correction_speed")?,
        force_mixing: option(trajectory, "force_mixing")?,
        rebound_threshold: option(trajectory, "rebound_threshold")?,
    })
}

/// Direction away from the ground.
fn normal(trajectory: &Trajectory) -> Result<Vector3<f64>, Failed> {
    Ok(Vector3::from(trajectory.scene.ground.ok_or("the scene has a ground")?.normal))
}

/// Half the height of a body over what carries it \[m\].
fn half_height(trajectory: &Trajectory, body: usize) -> Result<f64, Failed> {
    let body = &trajectory.scene.bodies[body];
    Ok(match (body.sphere, body.cuboid) {
        (Some(sphere), _) => sphere.radius,
        (_, Some(cuboid)) => cuboid.half_extents[2],
        _ => return Err("a body is a sphere or a box".into()),
    })
}

/// n·M⁻¹n with rotations of a point below the corner of the body `corners`, of the body `body`: 1/m + y²/J₁ + x²/J₂.
fn response(trajectory: &Trajectory, body: usize, corners: usize) -> Result<f64, Failed> {
    let mass = trajectory.scene.bodies[body].mass;
    let (Some(own), Some(upper)) = (trajectory.scene.bodies[body].cuboid, trajectory.scene.bodies[corners].cuboid) else {
        return Ok(1.0 / mass);
    };
    let ([a, b, c], [x, y, _]) = (own.half_extents, upper.half_extents);
    Ok((1.0 + 3.0 * y * y / (b * b + c * c) + 3.0 * x * x / (a * a + c * c)) / mass)
}

/// The scene as a column: corners of each box on the body below it, and the sphere's one point.
fn column(trajectory: &Trajectory) -> Result<Column, Failed> {
    let bodies = &trajectory.scene.bodies;
    let interface = |upper: usize| -> Result<Interface, Failed> {
        let below = if upper > 0 { response(trajectory, upper - 1, upper)? } else { 0.0 };
        let points = if bodies[upper].cuboid.is_some() { 4.0 } else { 1.0 };
        Ok(Interface { points, response: response(trajectory, upper, upper)? + below })
    };
    Ok(Column {
        time_step: trajectory.time_step,
        gravity: -Vector3::from(trajectory.scene.gravity).dot(&normal(trajectory)?),
        restitution: trajectory.scene.material.restitution,
        parameters: parameters(trajectory)?,
        masses: bodies.iter().map(|body| body.mass).collect(),
        interfaces: (0..bodies.len()).map(interface).collect::<Result<_, _>>()?,
    })
}

/// Gaps and velocities along the normal at a sample.
fn state(trajectory: &Trajectory, sample: usize) -> Result<(DVector<f64>, DVector<f64>), Failed> {
    let normal = normal(trajectory)?;
    let (mut gaps, mut velocities, mut top) = (Vec::new(), Vec::new(), trajectory.scene.ground.ok_or("the scene has a ground")?.offset);
    for (k, track) in trajectory.bodies.iter().enumerate() {
        let (height, half) = (Vector3::from(track.position[sample]).dot(&normal), half_height(trajectory, k)?);
        gaps.push(height - half - top);
        velocities.push(Vector3::from(track.linear_velocity[sample]).dot(&normal));
        top = height + half;
    }
    Ok((DVector::from_vec(gaps), DVector::from_vec(velocities)))
}

/// The whole motion along the normal from the first sample.
fn replay(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let [steps, every] = ["steps", "sample_every"].map(|key| document.number(&["provenance", key]));
    let (steps, every) = (steps? as usize, every? as usize);
    let column = column(trajectory)?;
    let (mut gaps, mut velocities) = state(trajectory, 0)?;
    let (mut apart, mut speed, mut reach) = ([0.0f64; 2], 0.0f64, 0.0f64);
    for step in 1..=steps {
        column.step(&mut gaps, &mut velocities);
        speed = speed.max(velocities.amax());
        if step % every == 0 {
            let (stored_gaps, stored) = state(trajectory, step / every)?;
            reach = reach.max(stored_gaps.amax());
            apart = [apart[0].max((&gaps - stored_gaps).amax()), apart[1].max((&velocities - stored).amax())];
        }
    }
    let allowed = tolerance::sample_rounding(steps, speed + reach / trajectory.time_step);
    let duration = trajectory.scene.duration;
    Ok(vec![
        Finding::at_most("velocities along the normal against DART's law, step by step", apart[1], allowed, "m/s"),
        Finding::at_most("gaps against DART's law, step by step", apart[0], duration * allowed, "m"),
    ])
}

/// The first rebound, (1 + e)/(1 + c) − 1 of the speed that gravity has added g h to; Newton's is e|v|.
fn rebound(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let Column { time_step: h, gravity, restitution, parameters, .. } = column(trajectory)?;
    let track = &trajectory.bodies[0].linear_velocity;
    let first = track.iter().position(|v| v[2] > 0.0).ok_or("the ball rebounds")?;
    let (speed, expected) = (-track[first - 1][2], (1.0 + restitution) / (1.0 + parameters.force_mixing) - 1.0);
    let accuracy = document.accuracy("bodies/linear_velocity", speed)?;
    let name = "first rebound (Newton: e|v|) against e(|v| + g h), softened";
    Ok(Finding::equal(name, track[first][2], (speed + gravity * h) * expected, accuracy, "m/s"))
}

/// v_t + μ v_n = g (sin α − μ cos α) t: friction is bounded by μ times the normal impulses without friction, whose sum is that of the final
/// ones but for the tilt θ, by which the responses W of the corners differ, in the part c of the impulses.
fn slide(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let last = trajectory.times.len() - 1;
    let (block, friction, time) = (Block::at(trajectory, last)?, trajectory.scene.material.friction, trajectory.times[last]);
    let found = block.velocity.dot(&block.slope) + friction * block.velocity.dot(&block.normal);
    let tilt = block.rotation.column(2).cross(&block.normal).norm();
    let unequal = 2.0 * tilt * parameters(trajectory)?.force_mixing * friction * block.press * time;
    let allowed = document.accuracy("bodies/linear_velocity", found)? + unequal;
    Ok(Finding::equal("v_t + μ v_n against g (sin α − μ cos α) t", found, (block.pull - friction * block.press) * time, allowed, "m/s"))
}

/// Slip of the contact points at the end, c W_tt m g sin α h/4.
fn creep(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let last = trajectory.times.len() - 1;
    let block = Block::at(trajectory, last)?;
    let spin = Vector3::from(trajectory.bodies[0].angular_velocity[last]);
    let corners = block.corners(0.0);
    let slip = corners.iter().map(|lever| (block.velocity + spin.cross(lever)).dot(&block.slope)).sum::<f64>() / 4.0;
    let tangential = block.tangential_response(&corners[0])[(0, 0)];
    let expected = parameters(trajectory)?.force_mixing * tangential * block.mass * block.pull * trajectory.time_step / 4.0;
    let accuracy = document.accuracy("bodies/linear_velocity", slip)? + tolerance::CREEP_GEOMETRY * expected;
    Ok(Finding::equal("creep of the contact points (Coulomb: 0) against its force mixing", slip, expected, accuracy, "m/s"))
}
