//! Allowances of [`crate::checks::limits`].

/// Error \[m/s²\] of the slip of a solid sphere by the depth δ of its contact. Friction turns it with the lever R − δ: 5/7 of the
/// deceleration of the slip, `full`, is off by δ/R.
/// Derived.
pub fn lever(full: f64, depth: f64, radius: f64) -> f64 {
    5.0 / 7.0 * full * depth / radius
}

/// Slip that is seen at the lever R of a ball that rolls with v = ω ℓ, R − δ ≤ ℓ ≤ R: |v (1 − R/ℓ)| ≤ v δ/(R − δ), in the unit of v, which
/// may be a velocity \[m/s\] or an acceleration \[m/s²\].
/// Derived.
pub fn rim(speed: f64, depth: f64, radius: f64) -> f64 {
    speed * depth / (radius - depth)
}
