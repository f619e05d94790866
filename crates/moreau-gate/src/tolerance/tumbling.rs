//! Allowances of [`crate::checks::tumbling`]: what a sound step may add to an energy, a depth, a momentum.
//!
//! *Energy.* With p the impulses of the contacts on a body and E_σ = E − σ g h Σ m v_z (see the check), a step of a scheme with one contact
//! law gains r·u⁺ − Σ(½ ‖p‖²/m − ½ h g p_z) − ½ ℓᵀJ⁻¹ℓ, where r·u⁺ ≤ Σ r_k w_k. Each function below bounds one of these terms.
//!
//! *Rotation.* What a step of rotation adds, with s = J_max − J_min, ω the spin and Δω its change in the step:
//! - an explicit or implicit Euler step of JΩ̇ = −Ω × JΩ: ½ h² τᵀJ⁻¹τ with ‖τ‖ ≤ ½ s ω²;
//! - ω held in the world while the body turns with the mean of both spins: h (ω⁺ × ω_θ)·J ω⁺ ≤ ½ h s ω² ‖Δω‖, and as much times h ω
//!   in the next order;
//! - restitution of u⁻ before the gyroscopic torque: e/(1+e) ℓ·h J⁻¹τ ≤ ½ · ½ h s ω² ‖Δω‖, which the term above contains.
//!
//! All vanish for a cube, s = 0, and for the implicit midpoint step without contact.

use super::SOLVED;

/// Sine of the angle below which two edges count as parallel, 2⁻²⁰: the overlap along their cross product is then that along a face normal
/// to as much of the boxes' size, and rounding decides its direction no more.
pub const PARALLEL: f64 = 1.0 / (1u64 << 20) as f64;

/// Impulse of a step \[N·s\] up to which a body flies: an eighth of its weight's, more than declared damping takes and less than a contact
/// gives.
pub fn flight(mass: f64, gravity: f64, h: f64) -> f64 {
    mass * gravity * h / 8.0
}

/// Error of σ g h \[m/s\] read from a flight of n steps: the rounding of two heights over the time of the flight; all of ½ g h is left open
/// where there is no flight.
pub fn sigma(flight: usize, gravity: f64, h: f64, epsilon: f64) -> f64 {
    if flight == 0 { 0.5 * gravity * h } else { 2.0 * place(flight, epsilon) / (flight as f64 * h) }
}

/// What the gravity of the step lets the contacts of one body give \[J\], from the upward part of their impulse \[N·s\]: ½ h g p − ½ p²/m,
/// at most m g² h²/8 at p = ½ m g h and nothing for a body that is carried, p = m g h. A scheme that takes several substeps gives less.
pub fn gravity(upward: f64, mass: f64, gravity: f64, h: f64) -> f64 {
    (0.5 * h * gravity * upward - 0.5 * upward * upward / mass).max(0.0)
}

/// What the step of rotation adds \[J\]; `spread` s and `least` J_min \[kg·m²\], `spin` ω and `turned` ‖Δω‖ \[rad/s\].
pub fn rotation(spread: f64, least: f64, spin: f64, turned: f64, h: f64) -> f64 {
    let torque = 0.5 * spread * spin * spin;
    0.5 * h * h * torque * torque / least + 0.5 * h * spread * spin * spin * turned * (1.0 + h * spin)
}

/// Speed \[m/s\] that takes back, within a step, a corner at the lever ρ \[m\] which turned ½ ω²ρ h² below a surface.
pub fn turned_below(spin: f64, radius: f64, h: f64) -> f64 {
    0.5 * spin * spin * radius * h
}

/// What a solver leaves \[J\] that leaves a part [`SOLVED`] of the impulses, with normal impulses R \[N·s\] in all and contact speeds of at
/// most u \[m/s\] before and after: s √(1 + μ²) R u, for μ ≤ 1.
pub fn unsolved(pressed: f64, speed: f64) -> f64 {
    std::f64::consts::SQRT_2 * SOLVED * pressed * speed
}

/// How far a corner may get into a surface \[m\]: as a ball does, (u + g h) h before its arrival is noticed and half of that again where
/// the position moves on with the mean of both velocities ([`super::ball::depth`]).
pub fn depth(speed: f64, gravity: f64, h: f64) -> f64 {
    super::ball::depth(speed, gravity, h)
}

/// Rounding of a coordinate of at most 1 m after n steps.
pub fn place(steps: usize, epsilon: f64) -> f64 {
    super::ball::place(steps, 1.0, epsilon)
}

/// Momentum over impulse: the impulses are known to [`SOLVED`].
pub fn impulse() -> f64 {
    SOLVED
}

/// Speed \[m/s\] of what lies: a step's gravity is no flight ([`super::ball::settled_speed`]), at the corners of a box that stands on one
/// edge and falls on the other the same.
pub fn settled_speed(gravity: f64, h: f64) -> f64 {
    super::ball::settled_speed(gravity, h)
}

/// Gap \[m\] under what lies, that of a ball ([`super::ball::resting_gap`]).
pub fn hover(gravity: f64, h: f64) -> f64 {
    super::ball::resting_gap(gravity, h)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_gives_an_eighth_at_half_the_weight_and_nothing_to_what_is_carried() {
        // m = 2, g = 8, h = 1/4: m g h = 4, m g² h²/8 = 1.
        assert_eq!([0.0, 2.0, 4.0, 6.0, -1.0].map(|p| gravity(p, 2.0, 8.0, 0.25)), [0.0, 1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_cube_gains_nothing_by_rotation() {
        assert_eq!(rotation(0.0, 1.0, 10.0, 5.0, 0.1), 0.0);
        assert!(rotation(0.5, 1.0, 10.0, 5.0, 0.1) > 0.0);
    }
}
