//! What Drake calls gliding.

use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::drake::{MATERIAL, facts, lift, predicted_lift};
use crate::claims::prelude::*;
use crate::tolerance::claims::drake as tolerance;
use crate::tolerance::claims::pathology::{AT_REST, creep};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S5.sap-doc",
    statement: "Drake's documentation of SAP calls the slow slip of a block that friction should hold on a slope “O(δt) gliding”.",
    verdict: ClaimVerdict::False,
    kind: Kind::Citation,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Certified,
    correct_statement: "Drake calls gliding what happens in sliding contact, under kSap and kSimilar: the block is lifted by (δt + τ) μ v. \
        Under kSap that vanishes with δt only without relaxation time. A block at rest does creep by O(δt) under kSap, but by its \
        regularised friction, for which Drake has no such name.",
    argument: "Documentation of 1.51.1: kSap and kSimilar introduce gliding \"in sliding contact\", O(δt); kLagged does not suffer from \
        it. Under kLagged a block at rest creeps (its friction is regularised), and a slide at 0.7 instead of 0.2 m/s, μ = 0.3, is lifted \
        by nothing: so what is documented is the lift and not the creep. Under kSap with τ = 5 ms the same slide is lifted by 1.35 mm at \
        h = 4 ms and 0.9 mm at 1 ms, a ratio of 2/3 and not 1/4; the creep at rest halves with h.",
    controls: &["The lift of a slide in place of the creep at rest: under kLagged there is none, as the documentation says of gliding."],
    sources: &[
        "chapter §5, the price of the relaxation",
        "Drake 1.51.1, documentation of DiscreteContactApproximation (references/facts/drake.json)",
    ],
    check: gliding,
}];

fn gliding(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let fine = lift("drake-sap", 0.001)?;
    let settled = |h: f64| tolerance::settled(9.81 / MATERIAL.stiffness, (tolerance::SETTLING_TIME / h) as usize);
    let creeping = |h: f64| Creeping::Sap.stepped(h);
    // what is said to glide under kLagged: its amount, and the rounding it is known to
    let (amount, bound) = match reading {
        Reading::Recorded => (Creeping::Regularised.stepped(0.004)?, creep(0.0)),
        Reading::Control(_) => (lift("drake-lagged", 0.004)?, settled(0.004)),
    };
    Ok(vec![
        Finding::decision("documented: kSap and kSimilar glide", facts.gliding_of == "kSap and kSimilar", true),
        Finding::decision("documented: kLagged does not", facts.without_gliding == "kLagged", true),
        Finding::equal("creep at rest at 4 ms over that at 2 ms, SAP", creeping(0.004)? / creeping(0.002)?, 2.0, 2.0 * AT_REST, "1"),
        Finding::decision("the block at rest creeps under kLagged as well", amount.abs() > bound, true).says(false),
        Finding::equal("lift of a faster slide at h = 1 ms, SAP", fine, predicted_lift(0.001), settled(0.001), "m").context(),
    ])
}
