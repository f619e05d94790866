//! Allowances of [`crate::checks::conveyor`].

use super::SOLVED;

pub use super::rolling::{no_slip, transition};

/// Error of the mean acceleration \[m/s²\] while a body slips: a part [`SOLVED`] of μ g.
/// Derived.
pub fn pull(full: f64) -> f64 {
    SOLVED * full
}

/// Error of the velocity \[m/s\] of a body that sticks: the solver leaves a part [`SOLVED`] of the belt's.
/// Derived.
pub fn speed(belt: f64) -> f64 {
    SOLVED * belt
}

/// Rounding \[m\] of where a corner is: the place, the four products of a quaternion's turn in each of three coordinates, and the plane's
/// offset, at most 16 roundings of a coordinate of this `size` \[m\].
/// Derived.
pub fn rounded_corner(epsilon: f64, size: f64) -> f64 {
    16.0 * epsilon * size
}

/// Error of the belt's reported velocity \[m/s\]: rounded, or a difference of two places on its `way` \[m\] over h.
/// Derived.
pub fn belt_speed(epsilon: f64, velocity: f64, way: f64, h: f64) -> f64 {
    2.0 * epsilon * (velocity.abs() + way.abs() / h)
}

/// Error of the belt's place \[m\]: one rounding of its way for each of the steps it is summed up from.
/// Derived.
pub fn belt_way(epsilon: f64, way: f64, steps: usize) -> f64 {
    epsilon * way.abs() * steps as f64
}
