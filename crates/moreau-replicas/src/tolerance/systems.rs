//! Tolerances of [`crate::systems`].

use moreau_exact::tolerance::rounding;

/// Rounding of one step of a spring with hω ≤ ⅛, relative to ‖(q, v)‖: fewer than 64 operations on numbers of at most twice that size.
/// Derived.
pub fn spring_step() -> f64 {
    rounding(64, 2.0)
}

/// Relative rounding of the spring's energy, or of another quadratic form of (q, v), after n steps.
///
/// The step matrix keeps the form up to a factor, so that an error of one step grows with the motion: n of them are at most n times
/// [`spring_step`] of the motion's size, measured in the form, whose extreme values on ‖(q, v)‖ = 1 are within (1+s/2)/(1−s/2) < 4/3
/// of each other. Squared, with the form's evaluation and the factor's n-th power: less than four times that.
/// Derived.
pub fn spring_energy(steps: usize) -> f64 {
    4.0 * steps as f64 * spring_step()
}

/// Rounding of the speed at the floor after an elastic impact of the variational integrator \[m/s\], for an impact at `speed` ≥
/// `gained` = g h.
///
/// τ is a root to rounding of τ ≤ h and r one of an energy ½ m v̄² whose slope in r is a speed of at least half of `speed`: each within
/// the rounding of fewer than 64 operations on numbers of that size; the speeds at the floor come from fewer than 16 on the same.
/// Derived.
pub fn variational_speed(speed: f64, gained: f64) -> f64 {
    rounding(256, 2.0 * (speed + gained))
}

/// Rounding of q and v of a spring after an elastic impact at its stop, relative to its speed, with hω < 1 and all positions below ⅛ of it.
/// Derived.
pub fn variational_state() -> f64 {
    rounding(256, 2.0)
}
