//! Rounding bounds: the tolerances that every crate of the workspace derives its own from.

/// Unit roundoff of `f64` times two, 2⁻⁵² (the spacing at 1).
/// Derived.
pub const EPSILON: f64 = f64::EPSILON;

/// Bound on the rounding error of a sum of `terms` products whose absolute values sum to `magnitude`:
/// γ_n·Σ|aᵢbᵢ| ≤ 2 n ε Σ|aᵢbᵢ| (Higham, *Accuracy and Stability*, §3.1; n ε < ½ holds for all sizes used here).
///
/// ```
/// use moreau_exact::tolerance::rounding;
///
/// let parts = [0.1; 10];
/// let sum: f64 = parts.iter().sum();
/// assert!(sum != 1.0 && (sum - 1.0).abs() <= rounding(10, 1.0));
/// ```
/// Derived.
pub fn rounding(terms: usize, magnitude: f64) -> f64 {
    2.0 * terms as f64 * EPSILON * magnitude
}
