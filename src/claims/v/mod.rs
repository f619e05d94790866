//! Claims of the table of versions and default values.

use super::Claim;

mod drake;
mod mujoco;
mod paths;
mod pinocchio;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[drake::CLAIMS, mujoco::CLAIMS, paths::CLAIMS, pinocchio::CLAIMS];
