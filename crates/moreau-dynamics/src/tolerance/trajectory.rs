//! Tolerances of [`crate::trajectory`].

use moreau_exact::tolerance::EPSILON;

/// Rounding of a slope fitted over at least a decade of steps: |ln error|, |ln h| < 64, fewer than 32 operations, and a
/// denominator Σ(x − x̄)² > 1: 2·32·64 ε.
/// Derived.
pub const ORDER_ROUNDING: f64 = 2.0 * 32.0 * 64.0 * EPSILON;

/// Relative width at which the enclosure of a graph distance is narrow enough. Over a range h_max/h_min ≥ 64 it moves a
/// slope by less than 10⁻³/ln 64 < 3·10⁻⁴, below every sawtooth.
/// Set.
pub const GRAPH_ACCURACY: f64 = 1e-3;

/// Rounding of a distance between points with coordinates up to 1: a projection and a norm, fewer than 16 operations
/// on differences that are off by ε each: 2·16 ε, and the same for the bound it is compared with.
/// Derived.
pub const GRAPH_ROUNDING: f64 = 4.0 * 16.0 * EPSILON;

/// How far a stored unit vector may be from length 1: engines in single precision (ε = 2⁻²³) that renormalise within
/// 16 operations, 2·16·2⁻²³.
/// Derived.
pub const UNIT_LENGTH: f64 = 32.0 / 8_388_608.0;
