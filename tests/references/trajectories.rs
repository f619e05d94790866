//! A stored motion: what every engine owes, then what its own contact model predicts for the scene.

use crate::document::Document;
use crate::{ball, block, bullet, dart, momentum, rapier, replay, soft_motion, stack, turning};
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::trajectory::Trajectory;

/// Every finding about one stored trajectory.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    let trajectory = Trajectory::from_json(&document.text)?;
    let mut findings = sampling(document, &trajectory)?;
    let whole = match document.engine() {
        "bullet" => Some(bullet::check(document, &trajectory)?),
        "dart" => Some(dart::check(document, &trajectory)?),
        "rapier" => Some(rapier::check(document, &trajectory)?),
        _ => None,
    };
    if let Some(own) = whole {
        return Ok([findings, own].concat());
    }
    if !document.config().ends_with("rk4") {
        // whose contacts are not reported
        findings.extend(momentum::check(document, &trajectory)?);
    }
    findings.extend(soft_motion::check(document, &trajectory)?);
    findings.extend(match trajectory.scene.name.as_str() {
        "ball_drop" if document.config().ends_with("rk4") => vec![ball::parabola(document, &trajectory)?],
        "ball_drop" | "ball_drop_elastic" | "ball_rest" => ball::check(document, &trajectory)?,
        "ball_spin" | "ball_roll" => turning::balls(document, &trajectory)?,
        "box_tumble" => vec![turning::flight(document, &trajectory)?],
        "block_stick" => block::stick(document, &trajectory)?,
        "block_slide" => block::slide(document, &trajectory)?,
        "five_box_stack" => stack::check(document, &trajectory)?,
        // momentum above, every step of the engine's own model below
        "ball_impact" | "block_impact" | "stack_landing" => vec![],
        other => return Err(format!("no check knows the scene `{other}`").into()),
    });
    if document.engine() == "drake" {
        findings.extend(replay::check(document, &trajectory)?);
    }
    Ok(findings)
}

/// The samples are the stated number of steps apart and reach the end of the scene.
fn sampling(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let [steps, every] = ["steps", "sample_every"].map(|key| document.number(&["provenance", key]));
    let (steps, every) = (steps?, every?);
    let h = trajectory.time_step;
    let end = *trajectory.times.last().ok_or("a trajectory has samples")?;
    let uneven = trajectory.times.iter().enumerate().map(|(k, t)| (t - k as f64 * every * h).abs()).fold(0.0, f64::max);
    let rounding = moreau::tolerance::rounding(steps as usize, end);
    Ok(vec![
        Finding::at_most("samples are equally spaced", uneven, rounding, "s"),
        Finding::equal("the last sample is the last step", end, steps * h, rounding, "s"),
        Finding::equal("the run covers the scene", end, trajectory.scene.duration, h, "s"),
    ])
}
