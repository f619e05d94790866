//! Claims on the rows of Chrono, Bullet and Pinocchio (§10).

use super::super::{rounding, solvers::STOP};

pub use super::super::references::SAME_VELOCITY;

/// Velocity difference \[m/s\] of two answers to one contact with W = 1 kg⁻¹ at speeds up to `speed`: each has a natural map of at most
/// STOP·2·`speed`, and with ρ = 1 kg the way to the solution is at most twice the map; two answers, 8 STOP, doubled for the rounding of u.
/// Derived.
pub fn same_answer(speed: f64) -> f64 {
    16.0 * STOP * speed
}

/// Rounding of a formula in stored positions of up to 1 m, 64 operations, multiplied by `amplification`: 1/h where they are divided by a
/// step, 1/d where two depths d are.
/// Derived.
pub fn stored(amplification: f64) -> f64 {
    rounding(64, amplification)
}
