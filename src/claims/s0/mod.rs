//! Claims of §0.

use super::Claim;

mod geometry;
mod literature;
mod mechanics;
pub mod one_step;
pub mod orders;
mod rattle;
pub mod solutions;
pub mod zeno;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    zeno::CLAIMS,
    one_step::CLAIMS,
    orders::CLAIMS,
    solutions::CLAIMS,
    mechanics::CLAIMS,
    geometry::CLAIMS,
    rattle::CLAIMS,
    literature::CLAIMS,
];
