//! Tolerances of [`crate::cone_projection`].

use moreau_exact::tolerance::rounding;

/// Stopping tolerance given to Clarabel, for gap and feasibility, relative to the data.
/// Set.
pub const CLARABEL_STOPPING: f64 = 1.0 / (1u64 << 40) as f64;

/// Rounding error of a projected point of size `size`: the closed form is a dozen rounded operations on terms
/// that are at most ‖z‖ (the half-angle's cosine and sine are at most 1), and evaluating a membership adds four.
/// Derived.
pub fn position(size: f64) -> f64 {
    rounding(16, size) + f64::MIN_POSITIVE
}

/// Rounding error of a product of two differences of sizes up to `left` and `right`, each with the error of
/// [`position`], plus the three products of the scalar product itself.
/// Derived.
pub fn product(left: f64, right: f64) -> f64 {
    2.0 * (left + right) * position(left + right) + rounding(4, left * right)
}

/// The largest radius of a certificate from Clarabel that still judges a projection of a point of size `size`.
///
/// What it documents for `AlmostSolved`: gap g at most 5e-5 and residuals ρ at most 1e-4, relative to S = max(1, ‖z‖);
/// the radius is then at most √(ρ² + 2(g + 2ρ))·S = 0.0224 S, here 1/32. (`Solved` gives 1e-6.)
/// Derived.
pub fn clarabel_radius(size: f64) -> f64 {
    size.max(1.0) / 32.0
}

/// What rounding adds to a radius √(‖x − z − p‖² + 2 x·p): both members are in their cones up to [`position`], so x·p is
/// known up to [`product`], and the mismatch up to [`position`]; all sizes are at most ‖z‖ + ‖x‖.
/// Derived.
pub fn clarabel_rounding(size: f64, point: f64) -> f64 {
    let size = size + point;
    (2.0 * product(size, size)).sqrt() + 2.0 * position(size)
}
