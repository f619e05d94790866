//! Allowances of [`crate::checks::contact`].

use super::SOLVED;

/// An impulse relative to the size it is compared with.
pub fn impulse() -> f64 {
    SOLVED
}

/// Friction over μ p_n: an impulse that is known to [`SOLVED`], divided by μ.
pub fn friction(friction: f64) -> f64 {
    SOLVED / friction
}

/// Rounding of a gap \[m\] read from positions of the size of the body.
pub fn gap(epsilon: f64, size: f64) -> f64 {
    8.0 * epsilon * size
}

/// Gap \[m\] up to which a body counts as touching: what it falls in one step from rest, and as much again by starting a step late.
pub fn touching(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Speed \[m/s\] with which a body in contact for two steps may still approach: one step's gravity, where an engine adds it after the
/// contacts, and what the solver leaves of the landing speed.
pub fn approach(gravity: f64, h: f64, landing: f64) -> f64 {
    gravity * h + SOLVED * landing
}

/// Slip \[m/s\] from which on a step is one of sliding: twice what friction takes off in a step (`rate` h), and a twentieth of the speed,
/// at which regularised friction with a stiction tolerance of millimetres per second is full to 1e-4.
pub fn full_slip(rate: f64, h: f64, speed: f64) -> f64 {
    (2.0 * rate * h).max(0.05 * speed)
}

/// Normal impulses \[N·s\] below half a step's weight belong to contacts that are just found or lost.
pub fn light(weight: f64, h: f64) -> f64 {
    0.5 * weight * h
}

/// Work \[J\] of one step: a contact found while the body rises slower than g h, ½ p_n g h, and what the solver leaves of the energy.
pub fn work(largest_impulse: f64, gravity: f64, h: f64, energy: f64) -> f64 {
    0.5 * largest_impulse * gravity * h + SOLVED * energy
}
