//! The source files the chapter names, in the releases that could be asked.

use crate::Result;
use crate::checks::Finding;
use crate::claims::s10::{mujoco, siconos, three_engines};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.paths",
    statement: "The paths of source files that the chapter gives exist on the main branches, though files may move from version to \
        version.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "They existed. Siconos's are those of 4.4.0 and have moved since, Pinocchio's are those of release 3 and are \
        elsewhere in 4.1.0; those of MuJoCo, Bullet and Chrono are in place. See S10.path-*.",
    argument: "Libraries and source distributions of the pinned releases, read by scripts. Those of Bullet, MuJoCo and Siconos 4.4.0 are \
        there, Pinocchio's printed path is not.",
    control: "Each of these packages with the path that its own claim takes for its control.",
    sources: &["chapter, table of versions", "references/facts, references/bullet, references/pinocchio"],
    check: paths,
}];

fn paths(reading: Reading) -> Result<Vec<Finding>> {
    let checks = [siconos::paths, mujoco::paths, three_engines::path_bullet, three_engines::path_pinocchio];
    Ok(checks.into_iter().map(|check| check(reading)).collect::<Result<Vec<_>>>()?.concat())
}
