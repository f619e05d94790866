//! Claims of §4.

use super::Claim;

mod copositive;
pub(in crate::claims) mod literature;
mod matrices;
mod matrix;
pub(in crate::claims) mod painleve;
pub(in crate::claims) mod polyhedral;
mod solutions;
mod solvability;
pub(in crate::claims) mod stepping;

/// The claims, one slice per file, in the order of the section.
pub const CLAIMS: &[&[Claim]] = &[
    matrix::CLAIMS,
    copositive::CLAIMS,
    solvability::CLAIMS,
    painleve::CLAIMS,
    stepping::CLAIMS,
    polyhedral::CLAIMS,
    solutions::CLAIMS,
    literature::CLAIMS,
];
