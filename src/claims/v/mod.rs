//! Claims of the table of versions and default values.

use super::Claim;

mod mujoco;
mod pinocchio;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[mujoco::CLAIMS, pinocchio::CLAIMS];
