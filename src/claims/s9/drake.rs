//! What Drake does against penetration.

use crate::claims::experiments::drake::{facts, rest_depth};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::stabilisation::{Constrained, CoordinateProjection, Pendulum, run};
use crate::tolerance::claims::drake::rest;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S9.drake-projection",
    statement: "Drake has coordinate projection built in.",
    verdict: ClaimVerdict::False,
    kind: Kind::Path,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Cited,
    correct_statement: "Not found: the documentation of its plant does not know the term, and its contacts are left with the depth that \
        carries the load. Discrete constraints are compliant, near rigid where they should be hard.",
    argument: r"The phrase occurs 0 times in the documentation of 1.51.1's multibody plant (“contact” 1356 times). A ball of 1 kg at rest
        under SAP, $k = \text{1e5}$ N/m, stays at $m\,g/k = \text{9.81e-5}$ m below the ground; a projection would end at 0.",
    controls: &["A body that coordinate projection holds against its weight, and the phrase looked up where it stands, in Eich's title."],
    sources: &[
        "chapter §9, constraint drift, (4)",
        "Drake 1.51.1 (references/facts/drake.json; references/drake, ball_rest, sap, h = 1 ms)",
        "Eich, SIAM J. Numer. Anal. 30 (1993) 1467, for the phrase (references/facts/literature.json)",
    ],
    check: check!(projection),
}];

/// How far 1 kg that hangs on a rod of 1 m is below the end of the rod after 1 s with coordinate projection, h = 1 ms \[m\].
fn projected_depth() -> Result<f64> {
    let pendulum = Pendulum::new(1.0, 1.0, 9.81)?;
    let end = run(&CoordinateProjection, &pendulum, &pendulum.at(0.0, 0.0), 0.001, 1000)?;
    Ok(pendulum.violation(&end.position)[0])
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let depth = match reading {
        Reading::Recorded => rest_depth()?,
        Reading::Control(_) => projected_depth()?,
    };
    let mut findings = vec![Finding::equal("depth of the resting ball", depth, 9.81 / 1e5, rest(9.81), "m").says(0.0).experiment()];
    findings.extend(lookups::check("S9.drake-projection", reading)?);
    findings.push(Finding::count("mentions of “contact” there", facts()?.mentions["contact"], 1356).context());
    Ok(findings)
}
