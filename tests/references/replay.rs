//! Drake's stored motions made again by our schemes of the same law.
//!
//! Where every step is stored, each is made from the stored state before it, through impacts too. Elsewhere an error of the engine's
//! stopping rule grows by a factor of up to 2.6 in each step between two samples, which says nothing of the ten and more steps between
//! those of the stack of five: its motion is made again as a whole, at the largest step (the others would take longer than all other files
//! together).

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::checks::drake_replay::Replay;
use moreau::trajectory::Trajectory;

/// Every interval between samples, and the whole motion where nothing falls.
pub fn check(document: &Document, stored: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let replay = Replay::new(stored)?;
    let stack = stored.scene.name == "five_box_stack";
    let mut findings = if stack { vec![] } else { vec![replay.intervals()?] };
    let falls = ["ball_drop", "ball_drop_elastic", "ball_impact", "block_impact", "stack_landing"].contains(&stored.scene.name.as_str());
    if !falls && (!stack || document.number(&["provenance", "steps"])? <= 200.0) {
        findings.extend(replay.whole()?);
    }
    Ok(findings)
}
