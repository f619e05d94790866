//! What Drake calls gliding.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::drake::{MATERIAL, facts, lift, predicted_lift};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::tolerance::claims::drake as tolerance;
use crate::tolerance::claims::pathology::{AT_REST, creep};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S5.sap-doc",
    statement: "Drake's documentation of SAP calls the slow slip of a block that friction should hold on a slope “O(δt) gliding”.",
    verdict: ClaimVerdict::False,
    kind: Kind::Assertion,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Certified,
    correct_statement: "Drake calls gliding what happens in sliding contact, under kSap and kSimilar: the block is lifted by (δt + τ) μ v. \
        Under kSap that vanishes with δt only without relaxation time. A block at rest does creep by O(δt) under kSap, but by its \
        regularised friction, for which Drake has no such name.",
    argument: "Documentation of 1.51.1: kSap and kSimilar introduce gliding in sliding contact, O(δt); kLagged does not. Slide at 0.7 \
        instead of 0.2 m/s, μ = 0.3, τ = 5 ms: lifted by 1.35 mm at h = 4 ms and 0.9 mm at 1 ms, a ratio of 2/3 and not 1/4; Lagged by \
        nothing. Creep of the resting block under kSap: halved with h.",
    control: "A lift in proportion to h.",
    sources: &[
        "chapter §5, the price of the relaxation",
        "Drake 1.51.1, documentation of DiscreteContactApproximation (references/facts/drake.json)",
    ],
    check: gliding,
}];

fn gliding(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let (coarse, fine) = (lift("drake-sap", 0.004)?, lift("drake-sap", 0.001)?);
    let settled = |h: f64| tolerance::settled(9.81 / MATERIAL.stiffness, (tolerance::SETTLING_TIME / h) as usize);
    let expected = reading.pick(predicted_lift(0.001), 0.25 * predicted_lift(0.004));
    let creeping = |h: f64| Creeping::Sap.stepped(h);
    Ok(vec![
        Finding::equal("lift of a faster slide at h = 1 ms, SAP", fine, expected, settled(0.001), "m"),
        Finding::equal("the same at 4 ms", coarse, predicted_lift(0.004), settled(0.004), "m"),
        Finding::equal("the same, Lagged", lift("drake-lagged", 0.004)?, 0.0, settled(0.004), "m"),
        Finding::equal("creep at rest at 4 ms over that at 2 ms, SAP", creeping(0.004)? / creeping(0.002)?, 2.0, 2.0 * AT_REST, "1"),
        Finding::equal("creep of a hard block", Creeping::Hard.stepped(0.004)?, 0.0, creep(0.0), "m/s"),
        Finding::decision("documented: kSap and kSimilar glide in sliding contact", facts.gliding_of == "kSap and kSimilar", true),
        Finding::decision("documented: kLagged does not", facts.without_gliding == "kLagged", true),
    ])
}
