//! Claims of §10: simulators compared.

use super::Claim;

mod differences;
mod siconos;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[differences::CLAIMS, siconos::CLAIMS];
