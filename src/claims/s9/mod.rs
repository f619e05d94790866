//! Claims of §9: penetration, energy and drift.

use super::Claim;

mod constraint_drift;
mod drake;
mod drift;
mod energy;
mod exercises;
mod jitter;
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
