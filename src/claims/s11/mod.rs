//! Claims of §11: convergence proofs, and what lies beyond rigid bodies.

use super::Claim;

mod elastic;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[elastic::CLAIMS];
