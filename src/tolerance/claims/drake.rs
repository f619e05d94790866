//! Claims on Drake.

/// Time \[s\] in which the block of `experiments::drake` settles.
pub const SETTLING_TIME: f64 = 4.0;

/// What is left of a start δ \[m\] from the settled gap: the contact of 1 kg is a damped spring of at least kτ = 10 N·s/m (SAP), which
/// decays by e^{−5t}; the implicit step damps more than the continuous motion. Twice that, for two slides, and the rounding of the steps.
pub fn settled(start: f64, steps: usize) -> f64 {
    2.0 * start * (-5.0 * SETTLING_TIME).exp() + crate::tolerance::rounding(64 * steps, start)
}

/// Depth \[m\] of a ball on k = 1e5 N/m that rests under its weight \[N\]: SAP leaves 1e-6 of the impulses unbalanced in each step.
pub fn rest(weight: f64) -> f64 {
    crate::tolerance::references::SAP_RELATIVE * weight / 1e5
}
