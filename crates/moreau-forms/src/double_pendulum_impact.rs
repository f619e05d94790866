//! A double pendulum whose tip hits the ground (Kane and Levinson's example).
//!
//! ```text
//!     two uniform rods of mass m and length l, hinged; angles θ₁, θ₂ from the downward vertical, c₁₂ = cos(θ₁ − θ₂)
//!     M = m l² ( 4/3  c₁₂/2 ; c₁₂/2  1/3 ) ,    det M = m² l⁴ (4/9 − c₁₂²/4)
//!     tip = l (sin θ₁ + sin θ₂, −cos θ₁ − cos θ₂) ,    rows  n = l (sin θ₁, sin θ₂) ,  t = l (cos θ₁, cos θ₂)
//! ```

use moreau_exact::scalar::Scalar;

/// The pendulum at one configuration, in any ordered field.
///
/// # Source
/// Kane and Levinson, *Dynamics: Theory and Applications* (1985), for the mechanism; masses and lengths are a choice.
///
/// ```
/// use moreau_exact::scalar::{Rational, ratio};
/// use moreau_forms::double_pendulum_impact::DoublePendulum;
///
/// let [zero, one]: [Rational; 2] = [ratio(0, 1), ratio(1, 1)];
/// let hanging = DoublePendulum { mass: one.clone(), length: one.clone(), angles: [[zero.clone(), one.clone()], [zero.clone(), one]] };
/// let [normal, mixed, tangential] = hanging.delassus();
/// assert_eq!((normal, mixed), (zero.clone(), zero)); // stretched downwards, the tip cannot move along its rods
/// assert_eq!(tangential, ratio(24, 7));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DoublePendulum<T: Scalar> {
    /// m \[kg\].
    pub mass: T,
    /// l \[m\].
    pub length: T,
    /// (sin θ, cos θ) of the upper and of the lower rod.
    pub angles: [[T; 2]; 2],
}

impl<T: Scalar> DoublePendulum<T> {
    /// Rows n and t of H \[m\].
    pub fn jacobian(&self) -> [[T; 2]; 2] {
        let row = |part: usize| [0, 1].map(|rod: usize| self.length.clone() * self.angles[rod][part].clone());
        [row(0), row(1)]
    }

    /// M in m l², (M₁₁, M₁₂, M₂₂).
    fn inertia(&self) -> [T; 3] {
        let [[s1, c1], [s2, c2]] = self.angles.clone();
        [T::ratio(4, 3), (c1 * c2 + s1 * s2) * T::ratio(1, 2), T::ratio(1, 3)]
    }

    /// U = H ω, (U_n, U_t) \[m/s\].
    pub fn contact_velocity(&self, angular: &[T; 2]) -> [T; 2] {
        self.jacobian().map(|[h1, h2]| h1 * angular[0].clone() + h2 * angular[1].clone())
    }

    /// T = ½ ωᵀMω \[J\].
    pub fn kinetic_energy(&self, angular: &[T; 2]) -> T {
        let ([m11, m12, m22], [w1, w2]) = (self.inertia(), angular.clone());
        let form = m11 * w1.clone() * w1.clone() + T::ratio(2, 1) * m12 * w1 * w2.clone() + m22 * w2.clone() * w2;
        T::ratio(1, 2) * self.mass.clone() * self.length.clone() * self.length.clone() * form
    }

    /// (W_nn, W_nt, W_tt) = H M⁻¹Hᵀ \[1/kg\], with the adjugate of M.
    pub fn delassus(&self) -> [T; 3] {
        let [m11, m12, m22] = self.inertia();
        let determinant = m11.clone() * m22.clone() - m12.clone() * m12.clone();
        let scale = self.mass.clone() * self.length.clone() * self.length.clone() * determinant;
        let product = |[a1, a2]: [T; 2], [b1, b2]: [T; 2]| {
            let mixed = a1.clone() * b2.clone() + a2.clone() * b1.clone();
            (m22.clone() * a1 * b1 - m12.clone() * mixed + m11.clone() * a2 * b2) / scale.clone()
        };
        let [n, t] = self.jacobian();
        [product(n.clone(), n.clone()), product(n, t.clone()), product(t.clone(), t)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_energy_of_the_mass_matrix_is_that_of_the_rods() {
        // upper rod about its hinge: I = m l²/3; lower rod: centre l(s₁ + s₂/2, −c₁ − c₂/2), I_c = m l²/12
        let angles = [[ratio(3, 5), ratio(4, 5)], [ratio(5, 13), ratio(12, 13)]];
        let pendulum = DoublePendulum { mass: ratio(2, 1), length: ratio(3, 1), angles: angles.clone() };
        let angular = [ratio(-1, 2), ratio(2, 3)];
        let [w1, w2] = &angular;
        let centre: [Rational; 2] = [1, 0].map(|part| ratio(3, 1) * (&angles[0][part] * w1 + ratio(1, 2) * &angles[1][part] * w2));
        let translation = &centre[0] * &centre[0] + &centre[1] * &centre[1];
        let energy = ratio(1, 2) * ratio(18, 3) * w1 * w1 + translation + ratio(1, 2) * ratio(18, 12) * w2 * w2;
        assert_eq!(pendulum.kinetic_energy(&angular), energy);
    }

    #[test]
    fn kane_s_configuration_has_its_numbers() {
        let angles = [20f64, 30.0].map(|degrees| [degrees.to_radians().sin(), degrees.to_radians().cos()]);
        let pendulum = DoublePendulum { mass: 1.0, length: 1.0, angles };
        let printed = crate::tolerance::PRINTED_DIGITS;
        for (value, expected) in pendulum.delassus().iter().zip([1.009560, 1.521309, 2.440338]) {
            assert!((value / expected - 1.0).abs() <= printed, "{value} against {expected}");
        }
        let velocity = pendulum.contact_velocity(&[-0.1, -0.2]);
        assert!((velocity[0] + 0.1 * angles[0][0] + 0.1).abs() <= rounding(8, 1.0));
        assert!((pendulum.kinetic_energy(&[-0.1, -0.2]) / 0.02318141 - 1.0).abs() <= printed);
    }
}
