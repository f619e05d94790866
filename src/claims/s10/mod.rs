//! Claims of §10: simulators compared.

use super::Claim;

mod differences;
pub(super) mod drake;
mod instances;
pub(super) mod mujoco;
pub(super) mod siconos;
mod step_sizes;
pub(super) mod three_engines;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] =
    &[differences::CLAIMS, drake::CLAIMS, mujoco::CLAIMS, siconos::CLAIMS, step_sizes::CLAIMS, instances::CLAIMS, three_engines::CLAIMS];
