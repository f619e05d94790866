//! Tolerances of closed forms: their rounding, and the errors of what their tests and their users hold them against.

use moreau_exact::tolerance::EPSILON;

/// Relative rounding of the bouncing ball's formulas: fewer than 32 operations, each with relative error at most ε
/// (`exp_m1`, `ln_1p` and `powf` within 2 ε), whose arguments are at most 60 logarithms long: 2·32·60 ε.
/// Derived.
pub const BALL_ROUNDING: f64 = 2.0 * 32.0 * 60.0 * EPSILON;

/// Rounding of the incline block's state, whose intermediate values stay below 128 (9.81 m/s² over at most 4 s and their
/// squares) with fewer than 16 operations: 2·16·128 ε. A difference quotient over δ divides it by δ.
/// Derived.
pub const SLOPE_ROUNDING: f64 = 2.0 * 16.0 * 128.0 * EPSILON;

/// Step of a central difference of a velocity \[s\], 2⁻¹⁷ ≈ ε^⅓, where truncation and rounding balance.
/// Set.
pub const DIFFERENCE: f64 = 1.0 / 131_072.0;

/// Error of that difference: δ²/6 times a bound of the third derivative, and the rounding of 16 operations at the size of the velocity over
/// δ.
/// Derived.
pub fn difference_error(velocity: f64, third_derivative: f64) -> f64 {
    DIFFERENCE * DIFFERENCE / 6.0 * third_derivative + 2.0 * 16.0 * EPSILON * velocity / DIFFERENCE
}

/// Relative error of a number that is quoted with seven digits: half a unit in the last one.
/// Derived.
pub const PRINTED_DIGITS: f64 = 5e-7;

/// Parts of the Runge–Kutta reference of the tumbling box.
/// Set.
pub const TOP_STEPS: usize = 2048;

/// Relative error of the reference: per step (s w)⁵/120, over T/s steps, times e^{wT}, w the largest rate (the slopes of Euler's equations
/// have Lipschitz constant at most w, as |J_i − J_j| ≤ J_k); and four roundings a step.
/// Derived.
pub fn top_reference(time: f64, rate: f64) -> f64 {
    let step = time / TOP_STEPS as f64;
    TOP_STEPS as f64 * ((step * rate).powi(5) / 120.0 + 4.0 * f64::EPSILON) * (rate * time).exp()
}

/// Parts of a radian of the oscillator in the test of e(ζ).
/// Set.
pub const OSCILLATOR_PARTS: usize = 1 << 14;

/// Error of the rebound of a semi-implicit oscillator in steps of a part of 1/ω: first order, with at most (1 + 2ζ)² per radian (the norm
/// of its matrix squared) over the at most four radians of a contact, ½ of it per step; and the step in which contact begins or ends.
/// Derived.
pub fn oscillator_rebound(damping_ratio: f64) -> f64 {
    let norm = 1.0 + 2.0 * damping_ratio;
    (0.5 * 4.0 * norm * norm + norm) / OSCILLATOR_PARTS as f64
}

/// SAP's relative tolerance (`SapSolverParameters::rel_tolerance` in Drake 1.51).
/// Required: of SAP, by the documentation of Drake.
pub const SAP_RELATIVE: f64 = 1e-6;
