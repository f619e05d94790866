//! Allowances of [`crate::checks::tumbling`]: how much a sound step may add to an energy, a depth or a momentum.
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

/// Sine of the angle below which two edges count as parallel, 2⁻²⁰. The overlap along their cross product then differs from that along a
/// face normal by at most this part of the boxes' size. Above this angle rounding does not decide the direction of the cross product.
/// Set.
pub const PARALLEL: f64 = 1.0 / (1u64 << 20) as f64;

/// Impulse of a step \[N·s\] up to which a body counts as flying: an eighth of the impulse of its weight. Declared damping takes less than
/// this, and a contact gives more.
/// Set.
pub fn flight(mass: f64, gravity: f64, h: f64) -> f64 {
    mass * gravity * h / 8.0
}

/// Error of σ g h \[m/s\] read from a flight of n steps: the rounding of two heights, divided by the time of the flight. Without a flight σ
/// is unknown, and the error is ½ g h.
/// Derived.
pub fn sigma(flight: usize, gravity: f64, h: f64, epsilon: f64) -> f64 {
    if flight == 0 { 0.5 * gravity * h } else { 2.0 * place(flight, epsilon) / (flight as f64 * h) }
}

/// Energy \[J\] that the contacts of one body may give because of the gravity of the step: ½ h g p − ½ p²/m, with the upward part p of
/// their impulse \[N·s\]. It is at most m g² h²/8, at p = ½ m g h, and zero for a body that is carried, p = m g h. Substeps give less.
/// Derived.
pub fn gravity(upward: f64, mass: f64, gravity: f64, h: f64) -> f64 {
    (0.5 * h * gravity * upward - 0.5 * upward * upward / mass).max(0.0)
}

/// Kinetic energy \[J\] that a body gains when it is turned with its angular momentum kept, out of a depth δ \[m\] at a lever ℓ: by the
/// angle φ = δ ‖J⁻¹(ℓ × n)‖/(1/m + (ℓ × n)·J⁻¹(ℓ × n)) ≤ ½ δ √(m/J_min), and φ ‖ω × Jω‖ with ‖ω × Jω‖ ≤ ½ s ω².
/// Derived.
pub fn turned_by_correction(mass: f64, spread: f64, least: f64, spin: f64, depth: f64) -> f64 {
    0.5 * depth * (mass / least).sqrt() * 0.5 * spread * spin * spin
}

/// Energy \[J\] that a declared damping c \[1/s\] may leave in a step which damps before it adds gravity; `changed` is ‖Δv‖ \[m/s\]. The
/// damping does −m c h v·½(v_free + v) with v_free + v ≈ 2v − g h, which is positive only for rising slower than ½ g h, and at most
/// m c h (g h)²/16. And the impulse of the contacts, where c m Δx stands for c m h v, is off by m c h ‖Δv‖, which counts with ½ g h.
/// Derived.
pub fn damping(mass: f64, gravity: f64, damping: f64, changed: f64, h: f64) -> f64 {
    let step = gravity * h;
    mass * damping * h * (step * step / 16.0 + 0.5 * step * changed)
}

/// Energy \[J\] that a step of rotation may add; `spread` s and `least` J_min \[kg·m²\], `spin` ω and `turned` ‖Δω‖ \[rad/s\].
/// Derived.
pub fn rotation(spread: f64, least: f64, spin: f64, turned: f64, h: f64) -> f64 {
    let torque = 0.5 * spread * spin * spin;
    0.5 * h * h * torque * torque / least + 0.5 * h * spread * spin * spin * turned * (1.0 + h * spin)
}

/// Speed \[m/s\] that moves a corner back to the surface within a step, after it has turned ½ ω²ρ h² below it; ρ \[m\] is its lever.
/// Derived.
pub fn turned_below(spin: f64, radius: f64, h: f64) -> f64 {
    0.5 * spin * spin * radius * h
}

/// Energy \[J\] that contacts give which were opening and are pressed, and are kept from closing again: e/(1 + e) Σ r_k u_k⁻, with a bound
/// on the sum \[J\] over these contacts.
/// Derived.
pub fn opening(restitution: f64, power: f64) -> f64 {
    restitution / (1.0 + restitution) * power
}

/// Gap \[m\] up to which a contact that opens may act: the free step takes it back by up to h · g h, and by as much as its corner turns
/// below the surface.
/// Derived.
pub fn near(spin: f64, radius: f64, gravity: f64, h: f64) -> f64 {
    gravity * h * h + h * turned_below(spin, radius, h)
}

/// Energy \[J\] that a solver may leave if it leaves a part s = [`SOLVED`] of the impulses: s √(1 + μ²) R u, for μ ≤ 1. R \[N·s\] is the
/// sum of the normal impulses, and u \[m/s\] bounds the contact speeds before and after.
/// Derived.
pub fn unsolved(pressed: f64, speed: f64) -> f64 {
    std::f64::consts::SQRT_2 * SOLVED * pressed * speed
}

/// How far a corner may get into a surface \[m\]. As for a ball, it moves (u + g h) h before its arrival is noticed. It moves half of that
/// again if the position is updated with the mean of both velocities ([`super::ball::depth`]).
/// Derived.
pub fn depth(speed: f64, gravity: f64, h: f64) -> f64 {
    super::ball::depth(speed, gravity, h)
}

/// Rounding of a coordinate of at most 1 m after n steps.
/// Derived.
pub fn place(steps: usize, epsilon: f64) -> f64 {
    super::ball::place(steps, 1.0, epsilon)
}

/// Unaccounted momentum, relative to the impulses, which are known to [`SOLVED`].
/// Derived.
pub fn impulse() -> f64 {
    SOLVED
}

/// Speed \[m/s\] below which a body lies at rest, as for a ball ([`super::ball::settled_speed`]). It also applies to the corners of a box
/// that stands on one edge and falls on the other.
/// Derived.
pub fn settled_speed(gravity: f64, h: f64) -> f64 {
    super::ball::settled_speed(gravity, h)
}

/// Gap \[m\] that may remain under a lying body, as under a ball ([`super::ball::resting_gap`]).
/// Derived.
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
    #[test]
    fn a_damped_step_of_flight_gains_no_more_than_its_bound_and_comes_near_it() {
        // m = 1, g = 10, h = 1/10, c = 1/2, θ = ½: v⁺ = (1 − c h) v − g h, Δz = ½ h (v + v⁺).
        let (gravity, h, rate) = (10.0, 0.1, 0.5);
        let gain = |v: f64| {
            let after = (1.0 - rate * h) * v - gravity * h;
            0.5 * (after * after - v * v) + gravity * 0.5 * h * (v + after)
        };
        let bound = damping(1.0, gravity, rate, 0.0, h);
        let most = (-200..=200).map(|k| gain(f64::from(k) * 0.01)).fold(f64::NEG_INFINITY, f64::max);
        assert!(most <= bound * (1.0 + 2.0 * rate * h) && most >= 0.9 * bound, "{most} {bound}");
    }
}
