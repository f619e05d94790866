//! Claims of §11: convergence proofs, and what lies beyond rigid bodies.

use super::Claim;

pub(in crate::claims) mod compactness;
mod elastic;
mod friction;
mod symplectic;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[compactness::CLAIMS, friction::CLAIMS, symplectic::CLAIMS, elastic::CLAIMS];
