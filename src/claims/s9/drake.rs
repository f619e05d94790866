//! What Drake does against penetration.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::drake::{facts, rest_depth};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::tolerance::claims::drake::rest;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S9.drake-projection",
    statement: "Drake has coordinate projection built in.",
    verdict: ClaimVerdict::False,
    kind: Kind::Assertion,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Cited,
    correct_statement: "Not found: the documentation of its plant does not know the term, and its contacts are left with the depth that \
        carries the load. Discrete constraints are compliant, near rigid where they should be hard.",
    argument: "The phrase occurs 0 times in the documentation of 1.51.1's multibody plant (“contact” 1356 times). A ball of 1 kg at rest \
        under SAP, k = 1e5 N/m, stays at m g/k = 98.1 µm below the ground; a projection would end at 0.",
    control: "A ball that ends on the ground.",
    sources: &[
        "chapter §9, constraint drift, (4)",
        "Drake 1.51.1 (references/facts/drake.json; references/drake, ball_rest, sap, h = 1 ms)",
    ],
    check: projection,
}];

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let expected = reading.pick(9.81 / 1e5, 0.0);
    Ok(vec![
        Finding::equal("depth of the resting ball", rest_depth()?, expected, rest(9.81), "m"),
        Finding::count("mentions of coordinate projection", facts()?.mentions["coordinate projection"], 0),
    ])
}
