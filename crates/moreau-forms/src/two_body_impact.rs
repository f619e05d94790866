//! Central impact of two bodies: m₁v₁⁺ + m₂v₂⁺ = m₁v₁ + m₂v₂ and v₂⁺ − v₁⁺ = e (v₁ − v₂).
//!
//! ```text
//!     P = (1 + e) m̄ (v₁ − v₂) ,   1/m̄ = 1/m₁ + 1/m₂ ,   ΔT = −½ (1 − e²) m̄ (v₁ − v₂)² .
//! ```

use moreau_exact::scalar::Scalar;

/// Two bodies on a line that approach each other (v₁ > v₂, body 1 behind), in any ordered field.
///
/// ```
/// use moreau_exact::scalar::{Rational, ratio};
/// use moreau_forms::two_body_impact::TwoBodyImpact;
///
/// let [one, rest]: [Rational; 2] = [ratio(1, 1), ratio(0, 1)];
/// let elastic = TwoBodyImpact { masses: [one.clone(), one.clone()], velocities: [one.clone(), rest.clone()], restitution: one.clone() };
/// assert_eq!(elastic.velocities_post(), [rest.clone(), one]); // equal masses exchange their velocities
/// assert_eq!(elastic.kinetic_energy_change(), rest);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TwoBodyImpact<T: Scalar> {
    /// m₁, m₂ > 0 \[kg\].
    pub masses: [T; 2],
    /// v₁, v₂ before the impact \[m/s\].
    pub velocities: [T; 2],
    /// e.
    pub restitution: T,
}

impl<T: Scalar> TwoBodyImpact<T> {
    /// m̄ = m₁m₂/(m₁ + m₂) \[kg\].
    pub fn reduced_mass(&self) -> T {
        let [m1, m2] = self.masses.clone();
        m1.clone() * m2.clone() / (m1 + m2)
    }

    /// v₁ − v₂ \[m/s\].
    pub fn closing_speed(&self) -> T {
        self.velocities[0].clone() - self.velocities[1].clone()
    }

    /// P = (1 + e) m̄ (v₁ − v₂) \[N·s\], on body 2 and −P on body 1.
    pub fn impulse(&self) -> T {
        (T::one() + self.restitution.clone()) * self.reduced_mass() * self.closing_speed()
    }

    /// v₁⁺ = v₁ − P/m₁ and v₂⁺ = v₂ + P/m₂ \[m/s\].
    pub fn velocities_post(&self) -> [T; 2] {
        let impulse = self.impulse();
        [
            self.velocities[0].clone() - impulse.clone() / self.masses[0].clone(),
            self.velocities[1].clone() + impulse / self.masses[1].clone(),
        ]
    }

    /// ΔT = −½ (1 − e²) m̄ (v₁ − v₂)² \[J\].
    pub fn kinetic_energy_change(&self) -> T {
        let e = self.restitution.clone();
        let speed = self.closing_speed();
        -T::ratio(1, 2) * (T::one() - e.clone() * e) * self.reduced_mass() * speed.clone() * speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn impacts() -> Vec<TwoBodyImpact<Rational>> {
        let mut impacts = Vec::new();
        for m2 in [1, 3, 1_000_000] {
            for e in [0, 1, 2, 4] {
                for v2 in [-5, 0, 1] {
                    let (masses, velocities) = ([ratio(2, 7), ratio(m2, 1)], [ratio(3, 2), ratio(v2, 1)]);
                    impacts.push(TwoBodyImpact { masses, velocities, restitution: ratio(e, 4) });
                }
            }
        }
        impacts
    }

    fn kinetic_energy(masses: &[Rational; 2], velocities: &[Rational; 2]) -> Rational {
        (0..2).map(|k| ratio(1, 2) * &masses[k] * &velocities[k] * &velocities[k]).fold(ratio(0, 1), |sum, term| sum + term)
    }

    #[test]
    fn momentum_is_conserved_exactly() {
        for impact in impacts() {
            let post = impact.velocities_post();
            let momentum = |v: &[Rational; 2]| &impact.masses[0] * &v[0] + &impact.masses[1] * &v[1];
            assert_eq!(momentum(&post), momentum(&impact.velocities));
        }
    }

    #[test]
    fn the_separation_speed_is_e_times_the_closing_speed_exactly() {
        for impact in impacts() {
            let [v1, v2] = impact.velocities_post();
            assert_eq!(v2 - v1, &impact.restitution * impact.closing_speed());
        }
    }

    #[test]
    fn the_energy_change_is_that_of_the_velocities_and_half_p_times_the_velocity_sum() {
        for impact in impacts() {
            let post = impact.velocities_post();
            let change = kinetic_energy(&impact.masses, &post) - kinetic_energy(&impact.masses, &impact.velocities);
            assert_eq!(change, impact.kinetic_energy_change());
            // ΔT = ½ P (U⁺ + U⁻) with U = v₂ − v₁ the velocity that P works on.
            let sum = (&post[1] - &post[0]) - impact.closing_speed();
            assert_eq!(change, ratio(1, 2) * impact.impulse() * sum);
        }
    }

    #[test]
    fn equal_masses_exchange_their_velocities_when_elastic() {
        let impact = TwoBodyImpact { masses: [2.0, 2.0], velocities: [3.0, -1.0], restitution: 1.0 };
        assert_eq!(impact.velocities_post(), [-1.0, 3.0]);
        assert_eq!(impact.kinetic_energy_change(), 0.0);
    }
}
