//! Claims of §9: penetration, energy and drift.

use super::Claim;

mod constraint_drift;
mod drake;
mod drift;
pub(super) mod energy;
mod exercises;
pub(super) mod jitter;
mod literature;
mod stabilisation;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    drift::CLAIMS,
    stabilisation::CLAIMS,
    constraint_drift::CLAIMS,
    drake::CLAIMS,
    literature::CLAIMS,
    energy::CLAIMS,
    jitter::CLAIMS,
    exercises::CLAIMS,
];
