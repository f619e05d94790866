//! What Drake calls gliding.

use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::drake::{MATERIAL, facts, lift, predicted_lift};
use crate::claims::prelude::*;
use crate::tolerance::claims::drake as tolerance;
use crate::tolerance::claims::pathology::{AT_REST, creep};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S5.sap-doc",
    statement: r"Drake's documentation of SAP calls it “$O(\delta t)$ gliding”: a block at rest on a slope, which friction should hold,
        slides down extremely slowly, at a speed proportional to the step.",
    verdict: ClaimVerdict::False,
    kind: Kind::Citation,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Cited,
    correct_statement: r"Drake calls gliding what happens in sliding contact, under kSap and kSimilar: the block is lifted by
        $(\delta t + \tau)\,\mu\,v$. Under kSap that vanishes with $\delta t$ only without relaxation time. A block at rest does creep by
        $O(\delta t)$ under kSap, but by its regularised friction, for which Drake has no such name.",
    argument: r#"Documentation of 1.51.1: kSap and kSimilar introduce gliding "in sliding contact", $O(\delta t)$; kLagged does not suffer
        from it. Under kLagged a block at rest creeps (its friction is regularised), and a slide at 0.7 instead of 0.2 m/s, $\mu = 0.3$,
        is lifted by nothing: so what is documented is the lift and not the creep. Under kSap with $\tau = 0.005$ s the same slide is
        lifted by 1.35e-3 m at $h = 0.004$ s and by 1.95e-3 m at 0.008 s; the creep at rest halves with $h$."#,
    controls: &["Coulomb's hard friction in place of kLagged's regularised one: the block at rest stays.", "kSap and kLagged exchanged."],
    sources: &[
        "chapter §5, the price of the relaxation",
        "Drake 1.51.1, documentation of DiscreteContactApproximation (references/facts/drake.json)",
    ],
    check: check!(gliding),
}];

fn gliding(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let settled = |h: f64| tolerance::settled(9.81 / MATERIAL.stiffness, (tolerance::SETTLING_TIME / h) as usize);
    let law = reading.only(1).pick(Creeping::Sap, Creeping::Regularised);
    let [gliding, free_of_it] =
        reading.only(1).pick([&facts.gliding_of, &facts.without_gliding], [&facts.without_gliding, &facts.gliding_of]);
    let lagged = reading.only(0).pick(Creeping::Regularised, Creeping::Hard).stepped(0.004)?;
    let mut findings = vec![
        Finding::decision("documented: kSap glides", gliding.contains("kSap"), true).looked_up(),
        Finding::decision("documented: kLagged does not", free_of_it.contains("kLagged"), true).looked_up(),
        Finding::equal("creep at rest at 4 ms over that at 2 ms, SAP", law.stepped(0.004)? / law.stepped(0.002)?, 2.0, 2.0 * AT_REST, "1"),
        Finding::decision("the block at rest creeps under kLagged as well", lagged.abs() > creep(0.0), true).says(false),
    ];
    for h in [0.004, 0.008] {
        let name = format!("lift of a faster slide at h = {h} s, SAP");
        findings.push(Finding::equal(name, lift("drake-sap", h)?, predicted_lift(h), settled(h), "m").context());
    }
    let still = lift("drake-lagged", 0.004)?;
    findings.push(Finding::equal("lift of a faster slide at h = 0.004 s, Lagged", still, 0.0, settled(0.004), "m").context());
    Ok(findings)
}
