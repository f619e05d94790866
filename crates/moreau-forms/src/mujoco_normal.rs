//! One step of one normal contact of MuJoCo, its other rows unloaded: depth δ, relative normal velocity v (opening positive), mass m̄.
//!
//! ```text
//!     f = max(0, (a_ref − a₀)/(1/m̄ + R)) ,   a_ref = −b v + k d δ ,   R = (1 − d)/d · Â   while δ > 0 ;      v⁺ = v + h (a₀ + f/m̄) .
//! ```
//! With Â = 1/m̄ this is v̇ = (1 − d) a₀ + d a_ref while f > 0, an oscillator δ̈ + d b δ̇ + d² k δ = (1 − d)·… For constant d = d_w its
//! damping ratio is `dampratio` ζ, so a fast impact rebounds with e(ζ) = exp(−ζ/√(1−ζ²)·acos(2ζ²−1)), e⁻² at ζ = 1.

use super::mujoco_contact::ContactParameters;

/// A contact between bodies of reduced mass m̄ at a step h.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* and *Modeling: solver parameters* (3.17).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalContact {
    /// `solref`, `solimp`, `impratio`.
    pub parameters: ContactParameters,
    /// h \[s\].
    pub time_step: f64,
    /// m̄ \[kg\].
    pub mass: f64,
    /// Â of the normal row \[1/kg\]: the sum of the bodies' inverse masses.
    pub diagonal: f64,
}

impl NormalContact {
    /// An elliptic or frictionless contact: Â = 1/m̄.
    pub fn elliptic(parameters: ContactParameters, time_step: f64, mass: f64) -> Self {
        NormalContact { parameters, time_step, mass, diagonal: 1.0 / mass }
    }

    /// A four-edge pyramid with friction μ: its equal edges in parallel have a quarter of an edge's R.
    pub fn pyramidal(parameters: ContactParameters, time_step: f64, mass: f64, friction: f64) -> Self {
        let diagonal = 0.25 * parameters.pyramid_diagonal(1.0 / mass, friction);
        NormalContact { diagonal, ..NormalContact::elliptic(parameters, time_step, mass) }
    }

    /// h f \[N·s\] at a depth δ \[m\] and velocity v \[m/s\], a₀ \[m/s²\] being the relative acceleration without contact.
    pub fn impulse(&self, depth: f64, velocity: f64, acceleration: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        let (stiffness, damping) = self.parameters.stiffness_and_damping(self.time_step);
        let reference = -damping * velocity + stiffness * self.parameters.impedance_at(depth) * depth;
        let softness = self.parameters.normal_regularisation(depth, self.diagonal);
        self.time_step * ((reference - acceleration) / (1.0 / self.mass + softness)).max(0.0)
    }
}

/// e(ζ) of a linear spring and damper, released when the force vanishes: exp(−ζ/√(1−ζ²)·acos(2ζ²−1)) for ζ < 1, its limit e⁻² at 1, and
/// exp(−ζ/√(ζ²−1)·acosh(2ζ²−1)) beyond.
///
/// # Source
/// Schwager and Pöschel, *Coefficient of restitution and linear–dashpot model revisited* (2007).
///
/// ```
/// use moreau_forms::mujoco_normal::spring_damper_restitution;
///
/// assert_eq!(spring_damper_restitution(0.0), 1.0);
/// assert_eq!(spring_damper_restitution(1.0), (-2f64).exp()); // critical damping still bounces: e = 0.135
/// ```
pub fn spring_damper_restitution(damping_ratio: f64) -> f64 {
    let square = damping_ratio * damping_ratio;
    if square == 1.0 {
        return (-2.0f64).exp();
    }
    let angle = 2.0 * square - 1.0;
    let turn = if square < 1.0 { angle.acos() } else { angle.acosh() };
    (-damping_ratio / (1.0 - square).abs().sqrt() * turn).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{OSCILLATOR_PARTS, oscillator_rebound};

    /// Speed ratio of an impact at 1 m/s without gravity.
    fn rebound(contact: &NormalContact) -> f64 {
        let (mut depth, mut velocity) = (0.0f64.next_up(), -1.0);
        for _ in 0..100 * OSCILLATOR_PARTS {
            velocity += contact.impulse(depth, velocity, 0.0) / contact.mass;
            depth -= contact.time_step * velocity;
            if depth < 0.0 {
                break;
            }
        }
        velocity
    }

    #[test]
    fn with_constant_impedance_and_small_steps_the_rebound_is_that_of_the_damping_ratio() {
        for ratio in [0.1, 0.5, 1.0, 1.5] {
            let parameters = ContactParameters { reference: [0.02, ratio], impedance: [0.9, 0.9, 0.001, 0.5, 2.0], impedance_ratio: 1.0 };
            // ω = 1/(t_c ζ) and its part of a radian as step.
            let contact = NormalContact::elliptic(parameters, 0.02 * ratio / OSCILLATOR_PARTS as f64, 3.0);
            let expected = spring_damper_restitution(ratio);
            assert!((rebound(&contact) - expected).abs() <= oscillator_rebound(ratio), "ζ = {ratio}: {} {expected}", rebound(&contact));
        }
    }

    #[test]
    fn the_restitution_of_a_damper_is_continuous_at_critical_damping_and_falls_with_it() {
        assert_eq!(spring_damper_restitution(0.0), 1.0);
        let around = [1.0 - 1e-6, 1.0, 1.0 + 1e-6].map(spring_damper_restitution);
        assert!((around[0] - around[1]).abs() <= 1e-6 && (around[2] - around[1]).abs() <= 1e-6, "{around:?}");
        assert!(spring_damper_restitution(0.3) > spring_damper_restitution(0.6) && around[1] > spring_damper_restitution(2.0));
    }

    #[test]
    fn at_the_rest_depth_the_impulse_carries_the_weight() {
        let contact = NormalContact::elliptic(ContactParameters::default(), 1e-3, 2.0);
        let depth = contact.parameters.rest_depth(1e-3, contact.diagonal, 2.0 * 9.81).expect("positive");
        let impulse = contact.impulse(depth, 0.0, -9.81);
        assert!((impulse - 2.0 * 9.81 * 1e-3).abs() <= moreau_exact::tolerance::rounding(64, 2.0 * 9.81 * 1e-3));
    }

    #[test]
    fn a_contact_that_opens_fast_enough_is_not_held_back() {
        let contact = NormalContact::elliptic(ContactParameters::default(), 1e-3, 2.0);
        assert_eq!(contact.impulse(1e-3, 10.0, -9.81), 0.0);
        assert_eq!(contact.impulse(0.0, -1.0, -9.81), 0.0);
    }
}
