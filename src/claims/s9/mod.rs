//! Claims of §9: penetration, energy and drift.

use super::Claim;

mod drift;
pub(super) mod energy;
mod exercises;
pub(super) mod jitter;
mod stabilisation;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[drift::CLAIMS, stabilisation::CLAIMS, energy::CLAIMS, jitter::CLAIMS, exercises::CLAIMS];
