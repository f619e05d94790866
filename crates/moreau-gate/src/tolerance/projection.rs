//! Rounding of a cone projection in an engine's precision ([`crate::checks::projection`]), relative to the size of the point.

use moreau_exact::tolerance::rounding;

/// Distance from the exact projection, over ‖z‖: reading three entries and μ, and a dozen rounded operations on terms of at most ‖z‖
/// (the half-angle's sine and cosine are at most 1); the projection does not expand the errors of its input.
/// Derived.
pub fn position(epsilon: f64) -> f64 {
    rounding(16, 1.0) * epsilon / f64::EPSILON
}

/// A product of two of such points, over ‖z‖²: each off by [`position`], and three products in double precision.
/// Derived.
pub fn product(epsilon: f64) -> f64 {
    2.0 * position(epsilon) + rounding(4, 1.0)
}
