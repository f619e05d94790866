//! Which integrators simulators have.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::mujoco::facts;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S1.mujoco-euler",
    statement: "MuJoCo uses the semi-implicit Euler rule, of first order.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "By default. It also has implicit, implicitfast, RK4 and, in newer versions, discrete; §6 of the chapter names two \
        of them.",
    argument: "Default and choices of the pinned release, 3.17.0: integrator 0, Euler, of five.",
    control: "Euler as the only one.",
    sources: &["chapter §1", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: integrators,
}];

fn integrators(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    Ok(vec![
        Finding::equal("default integrator", facts.number(&["stated", "defaults", "integrator"])?, 0.0, 0.0, "1"),
        Finding::count("integrators", facts.numbers(&["stated", "integrators"])?.len(), reading.pick(5, 1)),
    ])
}
