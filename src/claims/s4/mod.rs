//! Claims of §4.

use super::Claim;

mod copositive;
mod literature;
mod matrices;
mod matrix;
mod painleve;
mod polyhedral;
mod solutions;
mod solvability;
mod stepping;

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
