//! Claims of §0.

use super::Claim;

pub mod one_step;
pub mod orders;
pub(crate) mod runge_kutta;
pub mod solutions;
pub mod zeno;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[zeno::CLAIMS, one_step::CLAIMS, orders::CLAIMS, solutions::CLAIMS];
