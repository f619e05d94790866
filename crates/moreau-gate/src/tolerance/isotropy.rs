//! Allowances of [`crate::checks::isotropy`].

use super::SOLVED;

/// Error of friction over normal impulse. The solver leaves [`SOLVED`] of each. A contact that is found late has neither impulse.
/// Derived.
pub fn coefficient() -> f64 {
    2.0 * SOLVED
}

/// Sideways displacement \[m\] over a time T by the errors of the solvers, for a body with the speed v.
/// Derived.
pub fn sideways(speed: f64, time: f64) -> f64 {
    SOLVED * speed * time
}

/// Yaw rate \[rad/s\] from a sideways change of velocity \[m/s\] at the corners: the torque of m Δv at √2 `arm` about a box with the moment
/// m (a² + b²)/3 = ⅔ m `arm`².
/// Derived.
pub fn yaw_of(speed: f64, arm: f64) -> f64 {
    speed * 2f64.sqrt() * 1.5 / arm
}
