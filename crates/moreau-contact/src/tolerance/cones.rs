//! Tolerances of [`crate::cones`].

use moreau_exact::tolerance::EPSILON;

/// Step of central differences on data of size one, 2⁻¹⁷ ≈ ε^⅓, where truncation and rounding balance.
/// Set.
pub const DIFFERENCE_STEP: f64 = 1.0 / 131_072.0;

/// Error of a central difference of the cone projection at points with `‖z_t‖ ≥ norm` and entries up to `size`:
/// truncation step²·sup|P‴|/6 with |P‴| ≤ 24 size/norm³ (P is linear in z_n and a unit vector times a linear
/// function in z_t), plus rounding 16 ε·size/step (eight operations, two evaluations).
/// Derived.
pub fn difference_error(norm: f64, size: f64) -> f64 {
    4.0 * DIFFERENCE_STEP * DIFFERENCE_STEP * size / norm.powi(3) + 16.0 * EPSILON * size / DIFFERENCE_STEP
}

/// How far the maximum of a 1-Lipschitz function of an angle over `samples` equally spaced angles may lie below its
/// supremum: half the spacing, π/samples; plus √ε·2, the error of `acos` near ±1.
/// Derived.
pub fn sampling_error(samples: usize) -> f64 {
    std::f64::consts::PI / samples as f64 + 2.0 * EPSILON.sqrt()
}
