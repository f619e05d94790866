//! The ball: free flight of the semi-implicit step in closed form, MuJoCo's and SAP's single contact replayed from their formulas, the rest
//! depth.
//!
//! One contact, normal only, a₀ = −g, with the impulses of `closed_forms::mujoco_normal` and `closed_forms::drake_normal`:
//! v⁺ = v + h a₀ + impulse/m and z⁺ = z + h v⁺. Signorini's ball rests at depth 0: the rest depth is the difference.

use crate::document::Document;
use crate::dumps_native::parameters;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::closed_forms::bouncing_ball::BouncingBall;
use moreau::closed_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau::closed_forms::mujoco_normal::NormalContact;
use moreau::trajectory::Trajectory;
use serde_json::Value;

struct Ball {
    mass: f64,
    radius: f64,
    gravity: f64,
    friction: f64,
    h: f64,
}

/// Free flight, replay where the model is known in full, and the rest depth.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let body = &trajectory.scene.bodies[0];
    let radius = body.sphere.ok_or("the ball is a sphere")?.radius;
    let friction = trajectory.scene.material.friction;
    let ball = Ball { mass: body.mass, radius, gravity: -trajectory.scene.gravity[2], friction, h: trajectory.time_step };
    let mut findings = vec![free_flight(&ball, document, trajectory)?];
    match (document.engine(), document.config()) {
        ("mujoco", config) => {
            let parameters = parameters(&Value::Object(trajectory.engine.options.clone()))?;
            let contact = if config.contains("pyramidal") {
                NormalContact::pyramidal(parameters, ball.h, ball.mass, ball.friction)
            } else {
                NormalContact::elliptic(parameters, ball.h, ball.mass)
            };
            findings.extend(replay(document, trajectory, &ball, |depth, v| contact.impulse(depth, v, -ball.gravity))?);
            if trajectory.scene.name == "ball_rest" {
                let depth = parameters.rest_depth(ball.h, contact.diagonal, ball.mass * ball.gravity)?;
                findings.push(rest(document, trajectory, &ball, depth)?);
            }
        }
        ("drake", "sap") => {
            let sap = sap_contact(trajectory, &ball)?;
            findings
                .extend(replay(document, trajectory, &ball, |depth, v| sap.normal_impulse(ball.mass, depth, v - ball.h * ball.gravity))?);
            if trajectory.scene.name == "ball_rest" {
                findings.push(rest(document, trajectory, &ball, -sap.rest_gap(ball.mass * ball.gravity))?);
            }
        }
        _ if trajectory.scene.name == "ball_rest" => {
            let stiffness = option(trajectory, "stiffness")?;
            findings.push(rest(document, trajectory, &ball, ball.mass * ball.gravity / stiffness)?);
        }
        _ => {}
    }
    Ok(findings)
}

/// z_n = z_0 − g h² n(n+1)/2 and v_n = −g h n while the ball has not touched; Signorini's ball touches at √(2 z_0/g).
fn free_flight(ball: &Ball, document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let track = &trajectory.bodies[0];
    let start = track.position[0][2];
    let exact = BouncingBall::new(ball.gravity, start - ball.radius, 0.0)?;
    let every = document.number(&["provenance", "sample_every"])?;
    let mut worst = 0.0f64;
    for (k, &t) in trajectory.times.iter().enumerate().take_while(|&(_, &t)| t < exact.first_impact_time() - ball.h) {
        let n = k as f64 * every;
        let height = start - ball.gravity * ball.h * ball.h * n * (n + 1.0) / 2.0;
        worst = worst.max((track.position[k][2] - height).abs()).max((track.linear_velocity[k][2] + ball.gravity * t).abs());
    }
    let steps = (exact.first_impact_time() / ball.h) as usize;
    let size = start + exact.impact_speed(1);
    Ok(Finding::at_most("free flight against the semi-implicit closed form", worst, moreau::tolerance::rounding(steps + 1, size), "m, m/s"))
}

/// RK4 follows the parabola z_0 − ½ g t² exactly while the ball has not touched.
pub fn parabola(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let (track, gravity) = (&trajectory.bodies[0], -trajectory.scene.gravity[2]);
    let start = track.position[0][2];
    let radius = trajectory.scene.bodies[0].sphere.ok_or("the ball is a sphere")?.radius;
    let exact = BouncingBall::new(gravity, start - radius, 0.0)?;
    let flight = trajectory.times.iter().take_while(|&&t| t < exact.first_impact_time() - trajectory.time_step);
    let off = |(k, &t): (usize, &f64)| {
        let height = start - 0.5 * gravity * t * t;
        (track.position[k][2] - height).abs().max((track.linear_velocity[k][2] + gravity * t).abs())
    };
    let worst = flight.enumerate().map(off).fold(0.0, f64::max);
    let steps = document.number(&["provenance", "steps"])? as usize;
    let allowed = moreau::tolerance::rounding(8 * steps, start + exact.impact_speed(1));
    Ok(Finding::at_most("free flight of RK4 against the parabola", worst, allowed, "m, m/s"))
}

/// Recomputes the whole motion with the contact impulse of `impulse(depth, velocity)`.
fn replay(document: &Document, trajectory: &Trajectory, ball: &Ball, impulse: impl Fn(f64, f64) -> f64) -> Result<Vec<Finding>, Failed> {
    let track = &trajectory.bodies[0];
    let [steps, every] = ["steps", "sample_every"].map(|key| document.number(&["provenance", key]));
    let (steps, every) = (steps? as usize, every? as usize);
    let (mut z, mut v) = (track.position[0][2], track.linear_velocity[0][2]);
    let mut worst = [0.0f64; 2];
    for n in 1..=steps {
        v += -ball.h * ball.gravity + impulse(ball.radius - z, v) / ball.mass;
        z += ball.h * v;
        if n % every == 0 {
            worst[0] = worst[0].max((track.position[n / every][2] - z).abs());
            worst[1] = worst[1].max((track.linear_velocity[n / every][2] - v).abs());
        }
    }
    let speed = track.linear_velocity.iter().map(|v| v[2].abs()).fold(0.0, f64::max);
    Ok(vec![
        Finding::at_most(
            "height against the replayed contact model",
            worst[0],
            document.accuracy("bodies/position", track.position[0][2])?,
            "m",
        ),
        Finding::at_most(
            "velocity against the replayed contact model",
            worst[1],
            document.accuracy("bodies/linear_velocity", speed)?,
            "m/s",
        ),
    ])
}

/// The engine rests at its own model's depth, which is also its difference from Signorini's ball.
fn rest(document: &Document, trajectory: &Trajectory, ball: &Ball, depth: f64) -> Result<Finding, Failed> {
    let last = trajectory.bodies[0].position.last().ok_or("a trajectory has samples")?[2];
    let accuracy = document.accuracy("bodies/position", last)?;
    Ok(Finding::equal("rest depth (Signorini: 0) against its own model", ball.radius - last, depth, accuracy, "m"))
}

fn sap_contact(trajectory: &Trajectory, ball: &Ball) -> Result<SapContact, Failed> {
    // J diag(M)⁻¹ Jᵀ of a sphere on a plane: 1/m on the normal, 1/m + r²/I = 3.5/m on both tangents.
    let [normal, tangential] = [1.0 / ball.mass, 3.5 / ball.mass];
    Ok(SapContact {
        time_step: ball.h,
        stiffness: option(trajectory, "stiffness")?,
        relaxation_time: option(trajectory, "relaxation_time")?,
        diagonal_mean: (normal * normal + 2.0 * tangential * tangential).sqrt() / 3.0,
        tangential_ratio: TANGENTIAL_RATIO,
        friction: ball.friction,
    })
}

fn option(trajectory: &Trajectory, key: &str) -> Result<f64, Failed> {
    trajectory.engine.options.get(key).and_then(Value::as_f64).ok_or_else(|| format!("options.{key} is not a number").into())
}
