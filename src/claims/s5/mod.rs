//! Claims of §5.

use super::Claim;

mod cone;
mod drake;
mod gliding;
mod gradient;
mod literature;
mod nonconvexity;
mod program;
mod vanishing;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    program::CLAIMS,
    cone::CLAIMS,
    gradient::CLAIMS,
    gliding::CLAIMS,
    drake::CLAIMS,
    nonconvexity::CLAIMS,
    vanishing::CLAIMS,
    literature::CLAIMS,
];
