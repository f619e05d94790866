//! Drake's default, as the pinned release states it.

use crate::claims::lookups::looked_up;
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.drake",
    statement: "As of 2026 SAP is Drake's current default contact solver.",
    verdict: ClaimVerdict::True,
    kind: Kind::Path,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "As stated of the solver, in the release checked here, 1.51.1, the last for Python 3.11; on the contact model that \
        it solves see S10.drake-default-sap.",
    argument: "A plant of 1.51.1 answers kSap when asked for its solver. Later releases were not asked.",
    controls: &["The default approximation in place of the default solver, and TAMSI among the approximations."],
    sources: &["chapter, table of versions", "references/facts/drake.json"],
    check: looked_up!("V.drake"),
}];
