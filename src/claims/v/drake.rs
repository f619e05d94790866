//! Drake's default, as the pinned release states it.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::drake::facts;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.drake",
    statement: "Drake: SAP is the current default.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "As stated of the solver, in the release checked here, 1.51.1, the last for Python 3.11; on the contact model that \
        it solves see S10.drake-default-sap.",
    argument: "A plant of 1.51.1 answers kSap when asked for its solver. Later releases were not asked.",
    control: "TAMSI as the default.",
    sources: &["chapter, table of versions", "references/facts/drake.json"],
    check: default_solver,
}];

fn default_solver(reading: Reading) -> Result<Vec<Finding>> {
    Ok(vec![Finding::decision("the solver of a new plant", facts()?.default_solver == reading.pick("kSap", "kTamsi"), true)])
}
