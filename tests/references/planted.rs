//! Every finding about a stored motion must fail when the motion, or what is said of it, is made wrong in a way that concerns it.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::scenes::Scene;
use moreau::trajectory::Trajectory;
use serde_json::Value;

/// The findings of a check and, as controls, that each of them fails for at least one mistake.
pub fn caught(trajectory: &Trajectory, check: impl Fn(&Trajectory) -> Result<Vec<Finding>, Failed>) -> Result<Vec<Finding>, Failed> {
    let mut findings = check(trajectory)?;
    let mut unnoticed: Vec<String> = findings.iter().map(|finding| finding.name.clone()).collect();
    for wrong in mistakes(trajectory) {
        let found = check(&wrong)?;
        unnoticed.retain(|name| found.iter().all(|finding| finding.name != *name || finding.holds()));
    }
    let missed = unnoticed.join("; ");
    findings.push(Finding::decision(format!("control: no finding holds for every planted mistake {missed}"), unnoticed.is_empty(), true));
    Ok(findings)
}

/// A tenth more gravity, friction, restitution or of one of the engine's numbers; a body that is faster or slower in the second sample, or
/// drifts, and is turned at the end.
fn mistakes(trajectory: &Trajectory) -> Vec<Trajectory> {
    let with = |change: &dyn Fn(&mut Trajectory)| {
        let mut wrong = trajectory.clone();
        change(&mut wrong);
        wrong
    };
    let of_scene = |change: fn(&mut Scene)| with(&|wrong: &mut Trajectory| change(&mut wrong.scene));
    let of_engine = |key: &str| {
        with(&|wrong: &mut Trajectory| {
            let stored = wrong.engine.options.get(key).and_then(Value::as_f64);
            stored.into_iter().for_each(|value| _ = wrong.engine.options.insert(key.into(), (1.1 * value).into()));
        })
    };
    let drifting = with(&|wrong: &mut Trajectory| {
        for body in &mut wrong.bodies {
            body.position.iter_mut().rev().take(2).for_each(|x| x[2] -= 1e-3);
            body.linear_velocity.iter_mut().skip(1).flatten().for_each(|v| *v += 1e-3);
            body.orientation.iter_mut().rev().take(2).for_each(|q| *q = [1.0, 0.0, 0.0, 0.0]);
        }
    });
    let pushed = |speed: f64| with(&|wrong: &mut Trajectory| wrong.bodies.iter_mut().for_each(|body| body.linear_velocity[1][0] += speed));
    let mut all = vec![
        pushed(0.05),
        pushed(-0.05),
        of_scene(|scene| scene.gravity[2] *= 1.1),
        of_scene(|scene| scene.material.friction *= 1.1),
        of_scene(|scene| scene.material.restitution *= 1.1),
        drifting,
    ];
    all.extend(["error_reduction", "force_mixing", "correction_speed", "ground_contact_frequency", "contact_frequency"].map(of_engine));
    all
}
