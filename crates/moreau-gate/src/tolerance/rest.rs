//! Bodies at rest: how far rounding may move them, and a solver that leaves a part [`SOLVED`] of its impulses.
//!
//! ```text
//!     velocity   s g h ,  s = SOLVED         the impulse of a step is m g h; the next step starts from what is left and stops it
//!     distance   n h · s g h                 n steps, if all errors point the same way
//!     depth      s δ                         the force that carries the weight is known to s, and no law here is steeper than linear
//! ```

use super::SOLVED;

/// Distance \[m\] from the place of rest after n steps that start there, if each step evaluates a stable map and solves nothing. A step is
/// off by a velocity √ε g h, where an energy is minimised, times h. It is also off by 16 roundings of the coordinate \[m\].
/// Derived.
pub fn settled(steps: usize, size: f64, gravity: f64, h: f64, epsilon: f64) -> f64 {
    let steps = steps as f64;
    steps * h * epsilon.sqrt() * gravity * h + 16.0 * steps * epsilon * size
}

/// Distance \[m\] that a body at rest may move in n steps. Each step leaves a velocity of [`SOLVED`] g h and 16 roundings of the coordinate
/// \[m\].
/// Derived.
pub fn drift(steps: usize, size: f64, gravity: f64, h: f64, epsilon: f64) -> f64 {
    let steps = steps as f64;
    steps * h * SOLVED * gravity * h + 16.0 * steps * epsilon * size
}

/// Speed \[m/s\] of a body at rest: √2 times [`SOLVED`] g h. The factor √2 adds the turning, taken at the lever where an impulse causes as
/// much translation as turning.
/// Derived.
pub fn velocity(gravity: f64, h: f64) -> f64 {
    std::f64::consts::SQRT_2 * SOLVED * gravity * h
}

/// Speed \[m/s\] of a body at rest whose depth is taken back by a declared part r ≤ 1: it opens, is found again at a depth of at most 3/2 g
/// h² ([`super::ball::depth`]), and is pushed out at r times that over h, no faster than it fell, so that it is found no deeper the next
/// time ([`super::incline::pushed_creep`]). It counts √2 times with its turning, as in [`velocity`].
/// Derived.
pub fn pushed_velocity(gravity: f64, h: f64) -> f64 {
    std::f64::consts::SQRT_2 * super::ball::depth(0.0, gravity, h) / h
}

/// Gap or depth \[m\] of a body at rest: the fall of a step, for an engine that acts on a contact one step after it closes.
/// Derived.
pub fn gap(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Error of a depth at rest \[m\]: a part [`SOLVED`] of the depth, and the rounding of a coordinate of 0.1 m.
/// Derived.
pub fn rest_depth(depth: f64, epsilon: f64) -> f64 {
    SOLVED * depth + 64.0 * epsilon * 0.1
}
