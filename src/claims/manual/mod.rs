//! Claims of the troubleshooting manual at the end of the chapter, R1 to R8: each row turned into an experiment; and of the advice beside
//! it.

use super::Claim;

mod advice;
mod differences;
mod energy;
mod jitter;
mod penetration;
mod solvers;

/// The claims, one slice per file, in the order of the rows.
pub const CLAIMS: &[&[Claim]] =
    &[penetration::CLAIMS, energy::CLAIMS, jitter::CLAIMS, differences::CLAIMS, solvers::CLAIMS, advice::CLAIMS];
