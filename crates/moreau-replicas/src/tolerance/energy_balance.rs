//! Tolerances of [`crate::energy_balance`].

use moreau_contact::tolerance::certificate as cli;
use moreau_dynamics::tolerance::event_driven::{EVENT_LIMIT, TOUCHING};
use moreau_exact::tolerance::rounding;

/// Rounded operations on the way of one number through a step with this many contact rows and velocities: Hᵀr sums the rows, M̂⁻¹ is two
/// triangular solves, H v⁺ and M̂v sum the velocities, and a dozen products, sums and the quotients of a gap by h remain.
/// Derived.
pub fn operations(rows: usize, velocities: usize) -> usize {
    2 * rows + 4 * velocities + 16
}

/// Rounding of an energy of a step, for the sum `size` of the absolute values of what is added \[J\].
/// Derived.
pub fn energy(rows: usize, velocities: usize, size: f64) -> f64 {
    rounding(operations(rows, velocities), size) + f64::MIN_POSITIVE
}

/// Share of s Σ (s ‖diag W_kk‖ + ‖q_k‖ + ‖(W r)_k‖ + ‖(R r)_k‖), q = u_free + shift and s the largest ‖r_j‖ or ρ_n|q_n|, that the
/// residual's work Σ max(0, r_k·y_k) may have in an accepted step: r_k·y_k is a product of an impulse with a law velocity that the law
/// wants zero or negative, and the certificate's tolerance is relative to the two; what it holds a velocity against is s/ρ = s W_kk, even
/// where the net velocity W r is far smaller.
/// Derived.
pub const RESIDUAL_WORK: f64 = cli::CERTIFY;

/// Rounding of a quadratic form of a spin after the implicit midpoint steps of one step of size h at the rate `rate` \[rad/s\] and of size
/// `size` \[J\]: 2 h s + 1 parts of some thirty operations each, as the gyroscopic step itself is held to.
/// Derived.
pub fn midpoint_spin(h: f64, rate: f64, size: f64) -> f64 {
    rounding(32, size) * (1.0 + 2.0 * h * rate).ceil() + f64::MIN_POSITIVE
}

/// What the event-driven method may add to an energy in one sample \[J\]: at most [`EVENT_LIMIT`] events, at each of which positions and
/// speeds move by [`TOUCHING`] of 1 + |q| and 1 + |v|, against `forces` = ‖F‖₁ and `momentum` = ‖M v‖₁. The integrator's own tolerance is a
/// sixteenth of that.
/// Derived.
pub fn events(position: f64, speed: f64, forces: f64, momentum: f64) -> f64 {
    2.0 * EVENT_LIMIT as f64 * TOUCHING * ((1.0 + position) * forces + (1.0 + speed) * momentum)
}

/// Rounding of an energy after a step of the variational integrator: two roots found to rounding, each from fewer than 512 operations on
/// terms that add up to `size` \[J\].
/// Derived.
pub fn variational(size: f64) -> f64 {
    rounding(1024, size)
}

/// Rounding of the reach after many steps, relative: each of `steps` steps adds a few rounded numbers to the sum.
/// Derived.
pub fn reach(steps: usize) -> f64 {
    1.0 + rounding(8 * (steps + 1), 1.0)
}
