//! The advice for practice at the end of the chapter, as far as it states something.

use crate::claims::experiments::drake::{MATERIAL, lift, predicted_lift};
use crate::claims::prelude::*;
use crate::tolerance::claims::drake as tolerance;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "Pr.sap-gliding",
    statement: r"Drake SAP's $O(h)$ gliding is visible at $h$ of 5 to 10 ms and buys steps five to ten times as long.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Opinion,
    severity: None,
    evidence: Evidence::NotDecidable,
    correct_statement: r"Of kSap and kSimilar, not of Drake's default, kLagged. What is visible and what five times is compared with are
        not said. The lift itself is $(h + \tau)\,\mu\,v$: millimetres at these steps for a slide of 1 m/s.",
    argument: r"Slide at 0.7 instead of 0.2 m/s, $\mu = 0.3$, $\tau = 5$ ms: SAP lifts the block by 1.5e-3 m at $h = 5$ ms and by 2.25e-3
        m at 10 ms; Lagged, which does not glide, takes the same steps and lifts it by nothing.",
    controls: &["SAP and Lagged exchanged."],
    sources: &["chapter, advice for research practice", "S5.sap-doc"],
    check: check!(gliding),
}];

fn gliding(reading: Reading) -> Result<Vec<Finding>> {
    let settled = |h: f64| tolerance::settled(9.81 / MATERIAL.stiffness, (tolerance::SETTLING_TIME / h) as usize);
    let mut findings = Vec::new();
    for h in [0.005, 0.01] {
        let [gliding, lagged] = reading.pick(["drake-sap", "drake-lagged"], ["drake-lagged", "drake-sap"]);
        let lifted = lift(gliding, h)?;
        findings.push(
            Finding::equal(format!("lift of a faster slide at h = {h} s, SAP"), lifted, predicted_lift(h), settled(h), "m")
                .opinion("what is visible"),
        );
        findings.push(Finding::equal(format!("the same at h = {h} s, Lagged"), lift(lagged, h)?, 0.0, settled(h), "m"));
    }
    Ok(findings)
}
