//! Drake's stored motions made again by our schemes of the same law.

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::checks::replay::Replay;
use moreau::trajectory::Trajectory;

/// Whether our schemes can make this motion again: one body of Drake's.
pub fn applies(document: &Document, trajectory: &Trajectory) -> bool {
    document.engine() == "drake" && trajectory.scene.bodies.len() == 1
}

/// Every interval between samples, and the whole motion where nothing falls.
pub fn check(stored: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let replay = Replay::new(stored)?;
    let mut findings = vec![replay.intervals()?];
    if !stored.scene.name.starts_with("ball_drop") {
        findings.extend(replay.whole()?);
    }
    Ok(findings)
}
