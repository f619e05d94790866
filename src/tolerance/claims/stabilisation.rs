//! Claims on stabilisation (§9).

use super::super::rounding;

/// Step of the Runge–Kutta integration of g̈ + 2α ġ + β² g = 0 \[s\].
pub const DECAY_STEP: f64 = 1.0 / 8192.0;

/// Relative error of a solution integrated for one time constant τ or half a swing, up to T \[s\]: the classical Runge–Kutta method errs by
/// (‖A‖h)⁵/120 a step with ‖A‖ ≤ 2α + β² in (g, ġ); what is asked for is at least e⁻⁴ of the start, errors grow by at most 1 + β ≤ 8 on the
/// way (the equation is damped, and ġ is weighed against βg), and 32 operations a step are rounded.
pub fn decayed(damping: f64, frequency: f64, duration: f64) -> f64 {
    let norm = 2.0 * damping + frequency * frequency;
    let steps = duration / DECAY_STEP;
    8.0 * 55.0 * steps * ((norm * DECAY_STEP).powi(5) / 120.0 + rounding(32, 1.0))
}
