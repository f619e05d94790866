//! Allowances of [`crate::checks::rolling`].

use super::SOLVED;

/// Error of a velocity \[m/s\] by the solvers of a motion: a part [`SOLVED`] of the total change, which is at most v₀.
/// Derived.
pub fn speed(initial: f64) -> f64 {
    SOLVED * initial
}

/// Error of an acceleration \[m/s²\] by the solvers: a part [`SOLVED`] of g sin α.
/// Derived.
pub fn acceleration(pull: f64) -> f64 {
    SOLVED * pull
}

/// Change of a velocity or acceleration of size `size` by the depth δ of the contact, whose lever is R − δ. The ratio 1/(1 + I/m(R − δ)²)
/// is off by at most δ/R of itself for a solid sphere, because the slope of its logarithm is 4/7. And v = ω(R − δ) differs from ω R by
/// ω δ ≤ `size` δ/R.
/// Derived.
pub fn lever(size: f64, depth: f64, radius: f64) -> f64 {
    size * depth / radius
}

/// Slip \[m/s\] below which the sphere counts as rolling: half of the slip `rate` h that friction removes in a step.
/// Set.
pub fn no_slip(rate: f64, h: f64) -> f64 {
    0.5 * rate * h
}

/// Error of the time \[s\] at which slip ends. The threshold finds it half a step early. The samples find it a step late. At the start the
/// contact may be found a step late.
/// Derived.
pub fn transition(h: f64) -> f64 {
    2.0 * h
}
