//! PyBullet's single steps with its own contact points against `schemes::Bullet` and `SequentialImpulses`: what N sweeps give, not what
//! they tend to.
//!
//! `DIFFERENCE` Which contact points there are is the business of Bullet's manifold, and is replayed: a point that has slid by more than 2
//! % of half the body's diagonal is dropped, here 3.0 mm, and only some of the corners come back in the same step. Our boxes have all their
//! corners at all times.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::checks::bullet_steps::{BulletSteps, Deviation};
use moreau::schemes::{Bodies, Bullet, Friction};
use moreau::solvers::SequentialImpulses;
use moreau::tolerance::rounding;

use crate::document::Document;

/// Every finding about one stored run.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    let run = BulletSteps::from_json(&document.text)?;
    let (scheme, solver, allowed) = (run.scheme()?, run.solver()?, run.tolerance());
    let Deviation { velocity, spin, position, impulse } = run.deviation(&scheme, &solver)?;
    let mut findings = vec![
        Finding::at_most("velocity after every step against the engine's", velocity, allowed, "m/s"),
        Finding::at_most("angular velocity after every step", spin, allowed, "rad/s"),
        Finding::at_most("position after every step", position, allowed, "m"),
        Finding::at_most("impulses of every contact point", impulse, allowed, "N·s"),
    ];
    findings.extend(controls(&run, &scheme, &solver)?);
    match (run.scene.name.as_str(), document.config()) {
        ("block_slide", "box-default") => findings.extend(manifold(&run)?),
        ("block_oblique", "pyramid") => findings.extend(both_axes(&run)),
        ("block_oblique", "rigid") => findings.push(kept_heading(&run)),
        ("block_oblique", _) => findings.extend([bound(&run, 1.0), kept_heading(&run)]),
        ("ball_oblique", _) => findings.push(bound(&run, 2f64.sqrt())),
        ("block_landing", config) => findings.push(left_over(&run, config == "pyramid")),
        _ => {}
    }
    Ok(findings)
}

/// What a mistake would show in this run: another number of sweeps, another start, the other cone.
fn controls(run: &BulletSteps, scheme: &Bullet, solver: &SequentialImpulses) -> Result<Vec<Finding>, Failed> {
    let same = |scheme: &Bullet, solver: &SequentialImpulses| -> Result<bool, Failed> {
        Ok(run.deviation(scheme, solver)?.largest() <= run.tolerance())
    };
    let mut findings = Vec::new();
    if run.scene.name == "block_slide" || run.scene.name == "block_stick" {
        let fewer = SequentialImpulses { sweeps: 2, residual: 0.0, ..*solver };
        findings.push(Finding::decision("control: two sweeps give the same steps", same(scheme, &fewer)?, false));
    }
    if scheme.bodies == Bodies::Rigid && run.scene.name == "block_stick" {
        let other = SequentialImpulses { warm_start: if solver.warm_start == 0.0 { 0.85 } else { 0.0 }, ..*solver };
        findings.push(Finding::decision("control: another warm start gives the same steps", same(scheme, &other)?, false));
    }
    if scheme.bodies == Bodies::Multi && run.scene.name.ends_with("oblique") {
        let friction = if scheme.friction == Friction::Cone { Friction::Pyramid } else { Friction::Cone };
        let other = Bullet { friction, ..*scheme };
        findings.push(Finding::decision("control: the other cone gives the same steps", same(&other, solver)?, false));
    }
    Ok(findings)
}

/// All four corners touch until the block slides further in a step than a contact point lasts; from then on there is no step with all of
/// them.
fn manifold(run: &BulletSteps) -> Result<Vec<Finding>, Failed> {
    let (points, reach) = (run.points(), run.breaking_distance()?);
    let landed = points.iter().position(|count| *count > 0).ok_or("the block lands")?;
    let far = (landed..points.len()).find(|k| run.travel(*k) > reach).unwrap_or(points.len());
    let before = points[landed + 1..far].iter().all(|count| *count == 4);
    let mut findings = vec![Finding::decision("four contact points while the block slides less than a point lasts", before, true)];
    if far < points.len() {
        let after = points[far + 1..].iter().all(|count| *count < 4);
        findings.push(Finding::decision("DIFFERENCE: fewer than four afterwards", after, true));
    }
    Ok(findings)
}

/// Friction of the point that is braked most: μ r_n under the cone, √2 μ r_n at a corner of the box.
fn bound(run: &BulletSteps, times: f64) -> Finding {
    let most = run.scene.material.friction * times;
    let share = run.impulses().filter(|[normal, _]| *normal > 0.0).map(|[normal, tangential]| tangential / normal).fold(0.0, f64::max);
    Finding::equal("largest friction over normal impulse", share, most, rounding(256, 1.0), "")
}

/// Angle of the slide to the x axis after the last step.
fn heading(run: &BulletSteps) -> f64 {
    let [x, y, _] = run.velocity(run.points().len());
    y.atan2(x).to_degrees()
}

/// The cone brakes against the slip, and so do the boxes of rigid bodies, which are laid along it anew in every step; each corner's slip is
/// its own, so that these turn the slide a little.
fn kept_heading(run: &BulletSteps) -> Finding {
    Finding::at_least("direction of the slide in the end, 30° at the start", heading(run), 29.0, "°")
}

/// Under the pyramid each axis is braked by μ (g h + Δv_z): both of them, whatever the direction of the slip.
fn both_axes(run: &BulletSteps) -> Vec<Finding> {
    let (h, mu) = (run.time_step, run.scene.material.friction);
    let mut worst = [0.0f64; 2];
    for k in 1..run.points().len() {
        let (before, after) = (run.velocity(k), run.velocity(k + 1));
        let weight = mu * (9.81 * h + after[2] - before[2]);
        for axis in 0..2 {
            worst[axis] = worst[axis].max((before[axis] - after[axis] - weight).abs());
        }
    }
    vec![
        bound(run, 2f64.sqrt()),
        Finding::at_most("braking along x against μ (g h + Δv_z)", worst[0], run.tolerance(), "m/s"),
        Finding::at_most("braking along y", worst[1], run.tolerance(), "m/s"),
        Finding::at_most("direction of the slide in the end, 30° at the start", heading(run), 20.0, "°"),
    ]
}

/// The sweeps of a box leave a contact its friction when its normal impulse comes back to zero, those of the cone do not.
fn left_over(run: &BulletSteps, boxed: bool) -> Finding {
    let left = run.impulses().any(|[normal, tangential]| normal == 0.0 && tangential > 0.0);
    Finding::decision("friction at a contact point without a normal impulse", left, boxed)
}
