//! Claims of §1: event-driven methods and time-stepping.

use super::Claim;

mod filippov;
mod integrators;
mod simulators;
mod time_stepping;
mod tracking;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[tracking::CLAIMS, time_stepping::CLAIMS, filippov::CLAIMS, integrators::CLAIMS, simulators::CLAIMS];
