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

/// Length \[m\] by which the lever of a rigid contact may be shorter, or longer across a gap: what was measured, and no more than a sound
/// step makes out of rest ([`super::ball::depth`]). An impulse may act on the body, at R, on the floor, at R − δ, or anywhere between.
/// Derived.
pub fn rigid_depth(measured: f64, press: f64, h: f64) -> f64 {
    measured.min(super::ball::depth(0.0, press, h))
}

/// Error of a mean acceleration \[m/s²\] over a time T of a sphere that flies for n ≤ 3 r steps, at least one, where each step takes back a
/// part r of its depth ([`super::incline::pushed_creep`]): it slips by n g sin α h then, of which 2/7 are missing in v at either end.
/// Derived.
pub fn hopping(reduction: f64, pull: f64, h: f64, time: f64) -> f64 {
    2.0 * 2.0 / 7.0 * (3.0 * reduction).max(1.0) * pull * h / time
}

/// Slip \[m/s\] below which the sphere counts as rolling: half of the slip `rate` h that friction removes in a step.
/// Set.
pub fn no_slip(rate: f64, h: f64) -> f64 {
    0.5 * rate * h
}

/// Part by which the time to rolling changes at the lever R − δ: the slip that friction removes per time is 1 + ℓ R m/I of μ g at the
/// lowest point, whose slope in δ/R is 5/7 at most.
/// Derived.
pub fn later(transition: f64, depth: f64, radius: f64) -> f64 {
    transition * depth / radius
}

/// Error of the time \[s\] at which slip ends. The threshold finds it half a step early. The samples find it a step late. At the start the
/// contact may be found a step late.
/// Derived.
pub fn transition(h: f64) -> f64 {
    2.0 * h
}
