//! PyBullet's stored motions against `schemes::Bullet`, replayed from the scene's first state: every sample, not only the end.
//!
//! `multi`, `rigid` and `box` were run with `solverResidualThreshold` = 0 and 500 sweeps, so that the engine's answer is that of its step's
//! problem; `box-default` stops its sweeps where the largest change of a row's velocity is below √(10⁻⁷ m²/s²).
//!
//! Here the limit of the sweeps is compared, over whole motions and with our own contact points; single steps sweep by sweep:
//! `bullet_steps.rs`.
//!
//! `DIFFERENCE` Bullet drops a contact point that has slid by 2 % of half the body's diagonal, here 3.0 mm, and a block that slides further
//! than that in one step loses corners: at h = 0.01 s it begins to turn at 0.30 m/s. Our model has all its corners at all times; it is
//! compared up to there.

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::scenes::Body;
use moreau::schemes::bullet::{BREAKING_THRESHOLD, sphere_margin};
use moreau::schemes::{Bodies, Bullet};
use moreau::systems::replay::{Replay, option, replay};
use moreau::trajectory::Trajectory;

/// Every finding about one stored motion of Bullet.
pub fn check(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let scheme = scheme(document, trajectory)?;
    let samples = samples(trajectory)?;
    let found = replay(trajectory, &scheme, samples)?;
    let (position, velocity) = (found.position, found.velocity);
    let mut findings = vec![
        Finding::at_most("velocities of our model against the engine's", velocity.difference, velocity.expectation.tolerance, "m/s"),
        Finding::at_most("positions of our model against the engine's", position.difference, position.expectation.tolerance, "m"),
    ];
    let same = |other: Replay| other.position.holds() && other.velocity.holds();
    let other = replay(trajectory, &Bullet { error_reduction: 0.2, ..scheme }, samples)?;
    findings.push(Finding::decision("control: ERP 0.2 gives the same motion", same(other), false));
    if trajectory.scene.name == "ball_deep" {
        let swapped = if scheme.bodies == Bodies::Multi { Bodies::Rigid } else { Bodies::Multi };
        let other = replay(trajectory, &Bullet { bodies: swapped, ..scheme }, samples)?;
        findings.push(Finding::decision("control: the other family of bodies gives the same motion", same(other), false));
    }
    if samples + 1 < trajectory.times.len() {
        let spin = |range: &[[f64; 3]]| range.iter().flatten().fold(0.0f64, |most, w| most.max(w.abs()));
        let (before, after) = trajectory.bodies[0].angular_velocity.split_at(samples + 1);
        let turns = spin(after) > 100.0 * spin(before);
        findings.push(Finding::decision(
            "the engine's block turns once it slides further in a step than its contact points last",
            turns,
            true,
        ));
    }
    Ok(findings)
}

/// Samples after the first before a box slides further in one step than its contact points last; all of them for a sphere.
fn samples(trajectory: &Trajectory) -> Result<usize, Failed> {
    let all = trajectory.times.len() - 1;
    let Some(shape) = &body(trajectory)?.cuboid else { return Ok(all) };
    let reach = BREAKING_THRESHOLD * shape.half_extents.iter().map(|x| x * x).sum::<f64>().sqrt();
    let slides = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt() * trajectory.time_step >= reach;
    Ok(trajectory.bodies[0].linear_velocity.iter().position(slides).map_or(all, |first| first - 1))
}

fn body(trajectory: &Trajectory) -> Result<&Body, Failed> {
    Ok(trajectory.scene.bodies.first().ok_or("a stored scene has a body")?)
}

/// The scheme with the parameters the file was made with.
fn scheme(document: &Document, trajectory: &Trajectory) -> Result<Bullet, Failed> {
    // contact points between two boxes begin where they overlap
    let margin = body(trajectory)?.sphere.as_ref().map_or(0.0, |sphere| sphere_margin(sphere.radius));
    Ok(Bullet {
        bodies: if document.config() == "rigid" { Bodies::Rigid } else { Bodies::Multi },
        error_reduction: option(trajectory, "error_reduction")?,
        slop: option(trajectory, "penetration_allowance")?,
        restitution_threshold: option(trajectory, "restitution_threshold")?,
        margin,
        ..Bullet::default()
    })
}
