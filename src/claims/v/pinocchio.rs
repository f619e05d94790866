//! The version of Pinocchio.

use crate::claims::lookups::looked_up;
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "V.pinocchio",
    statement: "Pinocchio 3 / Simple: ADMM with a proximal term; admm-solver.hxx, contact-cholesky.hpp; rigid and compliant contact as NCP \
        or SOCCP.",
    verdict: ClaimVerdict::True,
    kind: Kind::Path,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "As stated of release 3, in which admm-solver.hxx came. The package checked elsewhere is 4.1.0: same solver and \
        default law, other folders (S10.path-pinocchio).",
    argument: "The tree of the tag v3.7.0 has both files, and its ADMM takes a proximal term and a compliance; it adds De Saxcé's shift in \
        every iteration, which makes the cone problem Coulomb's.",
    controls: &["Release 2.7.0, which has no such solver."],
    sources: &["chapter, table of software", "Pinocchio, tags v2.7.0 and v3.7.0: admm-solver.hpp and .hxx"],
    check: looked_up!("V.pinocchio"),
}];
