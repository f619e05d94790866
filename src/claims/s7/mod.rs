//! Claims of §7: impact laws.

use super::Claim;

mod exercises;
mod impacts;
mod kane;
mod moreau;
mod newton;
mod poisson;
mod simultaneous;
mod stronge;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] =
    &[newton::CLAIMS, kane::CLAIMS, poisson::CLAIMS, moreau::CLAIMS, stronge::CLAIMS, simultaneous::CLAIMS, exercises::CLAIMS];
