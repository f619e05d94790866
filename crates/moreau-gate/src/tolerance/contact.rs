//! Allowances of [`crate::checks::contact`].

use super::SOLVED;

/// Allowed error of an impulse, relative to the impulses that it is compared with.
/// Derived.
pub fn impulse() -> f64 {
    SOLVED
}

/// Allowed error of friction, relative to μ p_n. The impulse is known to [`SOLVED`], which is divided by μ.
/// Derived.
pub fn friction(friction: f64) -> f64 {
    SOLVED / friction
}

/// Rounding of a gap \[m\] read from positions of the size of the body.
/// Derived.
pub fn gap(epsilon: f64, size: f64) -> f64 {
    8.0 * epsilon * size
}

/// Gap \[m\] up to which a body counts as touching. The body falls ½ g h² in one step from rest, and as much again if it starts a step
/// late.
/// Derived.
pub fn touching(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Speed \[m/s\] with which a body may still approach after two steps in contact. An engine that adds gravity after the contacts leaves
/// g h. Its solver leaves a part [`SOLVED`] of the landing speed.
/// Derived.
pub fn approach(gravity: f64, h: f64, landing: f64) -> f64 {
    gravity * h + SOLVED * landing
}

/// Slip \[m/s\] above which a step counts as sliding. It is at least twice the slip that friction removes in a step (`rate` h). It is also
/// at least a twentieth of the speed: there regularised friction with a stiction tolerance of millimetres per second is full to 1e-4.
/// Set.
pub fn full_slip(rate: f64, h: f64, speed: f64) -> f64 {
    (2.0 * rate * h).max(0.05 * speed)
}

/// Half the impulse of the weight in a step \[N·s\]. A smaller normal impulse belongs to a contact that is just found or just lost.
/// Set.
pub fn light(weight: f64, h: f64) -> f64 {
    0.5 * weight * h
}

/// Work \[J\] that the contact may do in one step. A contact that is found while the body rises slower than g h does ½ p_n g h. The solver
/// leaves a part [`SOLVED`] of the energy.
/// Derived.
pub fn work(largest_impulse: f64, gravity: f64, h: f64, energy: f64) -> f64 {
    0.5 * largest_impulse * gravity * h + SOLVED * energy
}
