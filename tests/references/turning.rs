//! Spheres that torsional or rolling friction slows down, and a box that tumbles.
//!
//! # A sphere that spins about the normal, torsional coefficient μ_t \[m\]
//! While it spins the torque is μ_t f_n, so that with m v_n = Σ r_n − m g t the normal impulses drop out, whatever they are:
//! ```text
//!     J (ω_0 − ω) = μ_t Σ r_n = μ_t m (g t + v_n) .
//! ```
//! # A sphere that rolls, rolling coefficient μ_r \[m\]
//! On a round cone it creeps a little as it rolls, v ≠ ω r, and torsion has no part; friction F = −m v̇ drives its rotation against the
//! torque of rolling, J ω̇ = F r − μ_r λ f_n with a share λ ≤ 1 that the slip leaves. Rolling therefore takes at most what λ = 1 takes:
//! ```text
//!     m r (v_0 − v) + J (ω_0 − ω) ≤ μ_r m (g t + v_n) .
//! ```
//! # A box in flight
//! Its centre moves as MuJoCo's integrator moves a falling point, whatever the box does meanwhile.

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::tolerance::rounding;
use moreau::trajectory::Trajectory;

/// The laws of the header, at every sample until the ball has lost most of its motion; then that it stops.
pub fn balls(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let (track, gravity) = (&trajectory.bodies[0], -trajectory.scene.gravity[2]);
    let (mass, radius) = (trajectory.scene.bodies[0].mass, trajectory.scene.bodies[0].sphere.ok_or("the ball is a sphere")?.radius);
    let inertia = 0.4 * mass * radius * radius;
    let length = |key: &str| trajectory.engine.options.get(key).and_then(serde_json::Value::as_f64).ok_or(format!("no {key} friction"));
    let rolls = trajectory.scene.name == "ball_roll";
    let (friction, axis) = if rolls { (length("rolling")?, 1) } else { (length("torsional")?, 2) };
    let spin = |k: usize| track.angular_velocity[k][axis];
    let (start, last) = (spin(0), trajectory.times.len() - 1);
    let mut worst = 0.0f64;
    let turning = (0..=last).take_while(|&k| spin(k) > 0.2 * start);
    for k in turning {
        let sliding = if rolls { mass * radius * (track.linear_velocity[0][0] - track.linear_velocity[k][0]) } else { 0.0 };
        let lost = inertia * (start - spin(k)) + sliding;
        let pressed = mass * (gravity * trajectory.times[k] + track.linear_velocity[k][2]);
        worst = worst.max(if rolls { lost - friction * pressed } else { (lost - friction * pressed).abs() });
    }
    let accuracy = document.accuracy("bodies/angular_velocity", start)? * inertia
        + document.accuracy("bodies/linear_velocity", gravity)? * mass * (friction + radius);
    let name = if rolls { "angular momentum that rolling takes beyond μ_r Σ r_n" } else { "J Δω − μ_t Σ r_n" };
    Ok(vec![
        Finding::at_most(name, worst, accuracy, "N·m·s"),
        Finding::at_most("spin left at the end over its start", (spin(last) / start).abs(), 0.01, "1"),
    ])
}

/// The box's centre until the first sample that anything has touched.
pub fn flight(document: &Document, trajectory: &Trajectory) -> Result<Finding, Failed> {
    let (track, gravity, h) = (&trajectory.bodies[0], -trajectory.scene.gravity[2], trajectory.time_step);
    let (start, speed) = (track.position[0][2], track.linear_velocity[0][2]);
    let half = trajectory.scene.bodies[0].cuboid.ok_or("the body is a box")?.half_extents;
    let reach = half.iter().map(|x| x * x).sum::<f64>().sqrt();
    let early = if document.config().ends_with("rk4") { 0.0 } else { h };
    let off = |k: usize| {
        let t = trajectory.times[k];
        (track.position[k][2] - (start + speed * t - 0.5 * gravity * t * (t + early))).abs()
    };
    let flying = (0..trajectory.times.len()).take_while(|&k| track.position[k][2] > reach);
    let steps = document.number(&["provenance", "steps"])? as usize;
    let worst = flying.map(off).fold(0.0, f64::max);
    Ok(Finding::at_most("height of the centre in flight against the closed form", worst, rounding(8 * steps, start + speed), "m"))
}
