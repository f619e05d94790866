//! The version of Pinocchio.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::facts;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.pinocchio",
    statement: "Pinocchio 3 / Simple: ADMM with a proximal term; admm-solver.hxx, contact-cholesky.hpp; rigid and compliant contact as NCP \
        or SOCCP.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "So it began. The release checked here is 4.1.0: same solver and default law, other paths (S10.path-pinocchio).",
    argument: "The pinned package is 4.1.0; its ADMM has `solve_ncp` = true, a proximal term of 10⁻⁶ and finds ρ by the rule of OSQP.",
    control: "A package of version 3.",
    sources: &["chapter, table of software", "libpinocchio 4.1.0: references/pinocchio/package.json"],
    check: version_pinocchio,
}];

fn version_pinocchio(reading: Reading) -> Result<Vec<Finding>> {
    let package = facts::pinocchio()?;
    let major = package.version.split('.').next().unwrap_or("");
    Ok(vec![
        Finding::decision("the pinned release begins with", major == reading.pick("4", "3"), true),
        Finding::decision("ρ by the rule of OSQP", package.stated.settings["admm_update_rule"] == "osqp", true),
    ])
}
