//! Bodies at rest: what rounding and a solver that leaves a part [`SOLVED`] of its impulses may move.
//!
//! ```text
//!     velocity   s g h ,  s = SOLVED         the impulse of a step is m g h; the next step starts from what is left and stops it
//!     distance   n h · s g h                 n steps, if all errors point the same way
//!     depth      s δ                         the force that carries the weight is known to s, and no law here is steeper than linear
//! ```

use super::SOLVED;

/// Distance \[m\] from the place of rest after n steps of a stable map that is evaluated, not solved, and starts there: n steps leave 16
/// roundings each of a velocity g h times h, to √ε where an energy is minimised, and of the coordinate \[m\].
pub fn settled(steps: usize, size: f64, gravity: f64, h: f64, epsilon: f64) -> f64 {
    let steps = steps as f64;
    steps * h * epsilon.sqrt() * gravity * h + 16.0 * steps * epsilon * size
}

/// Distance \[m\] that n steps may leave: [`SOLVED`] of g h in each, and roundings of the coordinate \[m\].
pub fn drift(steps: usize, size: f64, gravity: f64, h: f64, epsilon: f64) -> f64 {
    let steps = steps as f64;
    steps * h * SOLVED * gravity * h + 16.0 * steps * epsilon * size
}

/// Speed at rest \[m/s\], translation and turning at the lever where an impulse causes as much of both: √2 times [`SOLVED`] of g h.
pub fn velocity(gravity: f64, h: f64) -> f64 {
    std::f64::consts::SQRT_2 * SOLVED * gravity * h
}

/// Where a body at rest may be \[m\]: a step's fall, for an engine that acts on a contact one step after it closes.
pub fn gap(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Error of a depth at rest \[m\]: [`SOLVED`] of it, and a coordinate of 0.1 m.
pub fn rest_depth(depth: f64, epsilon: f64) -> f64 {
    SOLVED * depth + 64.0 * epsilon * 0.1
}
