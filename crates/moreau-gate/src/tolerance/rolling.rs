//! Allowances of [`crate::checks::rolling`].

use super::SOLVED;

/// Velocity \[m/s\] that the solvers of a motion leave of the total change, at most the speed v₀.
pub fn speed(initial: f64) -> f64 {
    SOLVED * initial
}

/// Acceleration \[m/s²\] that they leave of g sin α.
pub fn acceleration(pull: f64) -> f64 {
    SOLVED * pull
}

/// What a contact at a depth δ changes in a velocity or acceleration of size `size`: with the lever R − δ the ratio 1/(1 + I/m(R − δ)²) is
/// off by at most δ/R of itself for a solid sphere (its logarithm's slope is 4/7), and v = ω(R − δ) differs from ω R by ω δ ≤ `size` δ/R.
pub fn lever(size: f64, depth: f64, radius: f64) -> f64 {
    size * depth / radius
}

/// A slip \[m/s\] that counts as none: half of what friction takes off in a step, `rate` h.
pub fn no_slip(rate: f64, h: f64) -> f64 {
    0.5 * rate * h
}

/// The time \[s\] at which slip is found gone: half a step early by the threshold, a step late by the samples, and a step late at
/// the start where the contact may be found late.
pub fn transition(h: f64) -> f64 {
    2.0 * h
}
