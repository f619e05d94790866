//! Claims of the table of versions and default values.

use super::Claim;

mod pinocchio;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[pinocchio::CLAIMS];
