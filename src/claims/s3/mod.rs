//! Claims of §3.

use super::Claim;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[];
