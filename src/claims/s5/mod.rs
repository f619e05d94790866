//! Claims of §5.

use super::Claim;

mod cone;
mod gliding;
mod nonconvexity;
mod planar_step;
mod program;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[program::CLAIMS, gliding::CLAIMS, nonconvexity::CLAIMS, cone::CLAIMS];
