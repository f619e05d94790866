//! The source files the chapter names, in the releases that could be asked.

use crate::claims::lookups::looked_up;
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.paths",
    statement: "The paths of source files that the chapter gives exist on the main branches, though files may move from version to \
        version.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Path,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "They existed. Siconos's are those of the releases up to 4.5.0, and two have moved since; Pinocchio's are those \
        of release 3 and are elsewhere in 4.1.0; MJX's starts at the Python package; tamsi_solver.cc was to go after August 2026. The \
        others of MuJoCo and Drake, and those of Bullet and Chrono, are in place. See S10.path-*.",
    argument: "Libraries and source distributions of the pinned releases, read by scripts, and trees of the repositories in August 2026: \
        Chrono, Drake, MuJoCo and Bullet have the files, Siconos has two of four at the printed paths, Pinocchio 4.1.0 none of two.",
    controls: &[
        "Other releases: Siconos 4.5.0, Pinocchio 4.1.0, Drake after the announced removal, MJX's package; other folders of Bullet and \
            Chrono.",
        "Other names and folders than the printed ones.",
    ],
    sources: &[
        "chapter, table of versions",
        "references/facts, references/bullet, references/pinocchio",
        "the repositories, see S10.path-*",
    ],
    check: looked_up!("V.paths"),
}];
