//! Claims of §10: simulators compared.

use super::Claim;

mod differences;
mod drake;
mod instances;
mod mujoco;
mod siconos;
mod step_sizes;
mod three_engines;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] =
    &[differences::CLAIMS, drake::CLAIMS, mujoco::CLAIMS, siconos::CLAIMS, step_sizes::CLAIMS, instances::CLAIMS, three_engines::CLAIMS];
