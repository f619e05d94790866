//! De Saxcé's change of variable: Coulomb's law as a complementarity between dual cones.
//!
//! ```text
//!     ŷ = y + μ‖y_t‖ n ,        Coulomb–Signorini  ⇔  K_μ ∋ r ⟂ ŷ ∈ K_μ* .
//! ```
//! Since `ŷ_n = y_n + μ‖y_t‖`, membership `ŷ ∈ K_μ*` says exactly `y_n ≥ 0`, and
//! ```text
//!     r·ŷ = r·y + μ r_n‖y_t‖ = y_n r_n + (μ r_n‖y_t‖ + r_t·y_t)
//! ```
//! is a sum of two terms that are non-negative for `r ∈ K_μ`, `y_n ≥ 0`: it vanishes iff Signorini's and Coulomb's laws hold.

use super::second_order::tangential_norm;

/// Replaces `y` by `ŷ = y + μ‖y_t‖ n` \[m/s\].
///
/// # Source
/// De Saxcé and Feng (1998), the bipotential of contact with friction; chapter §5.
/// ```
/// use moreau_contact::cones::de_saxce::{bipotential_residual, correct};
///
/// let (impulse, mut velocity) = ([1.0, -0.5], [0.0, 1.5]); // sliding with μ = ½
/// assert_eq!(bipotential_residual(&impulse, &velocity, 0.5), 0.0);
/// correct(&mut velocity, 0.5);
/// assert_eq!(velocity, [0.75, 1.5]);
/// ```
pub fn correct(y: &mut [f64], mu: f64) {
    y[0] += mu * tangential_norm(y);
}

/// The bipotential's residual `r·ŷ = r·y + μ r_n‖y_t‖` \[J\]; for `r ∈ K_μ`, `y_n ≥ 0` it is ≥ 0, and 0 iff the contact law holds.
///
/// - `impulse`: r \[N·s\]; `law_velocity`: y \[m/s\].
pub fn bipotential_residual(impulse: &[f64], law_velocity: &[f64], mu: f64) -> f64 {
    let power: f64 = impulse.iter().zip(law_velocity).map(|(r, y)| r * y).sum();
    power + mu * impulse[0] * tangential_norm(law_velocity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cones::second_order::dual_contains;

    #[test]
    fn the_corrected_velocity_is_dual_feasible_exactly_when_the_contact_does_not_close() {
        for (normal, feasible) in [(0.0, true), (-1e-9, false), (0.5, true)] {
            let mut y = [normal, 3.0, 4.0];
            correct(&mut y, 0.5);
            assert_eq!(y[0], normal + 2.5);
            assert_eq!(dual_contains(&y, 0.5), feasible);
        }
    }

    #[test]
    fn the_residual_vanishes_for_stick_slide_and_separation_only() {
        let mu = 0.5;
        assert_eq!(bipotential_residual(&[2.0, 0.3, -0.4], &[0.0; 3], mu), 0.0, "stick");
        assert_eq!(bipotential_residual(&[2.0, -0.6, -0.8], &[0.0, 3.0, 4.0], mu), 0.0, "slide against the velocity");
        assert_eq!(bipotential_residual(&[0.0; 3], &[1.0, 3.0, 4.0], mu), 0.0, "separation");
        assert!(bipotential_residual(&[2.0, -0.6, 0.8], &[0.0, 3.0, 4.0], mu) > 0.0, "not opposed");
        assert!(bipotential_residual(&[2.0, -0.3, -0.4], &[0.0, 3.0, 4.0], mu) > 0.0, "inside the cone while sliding");
        assert!(bipotential_residual(&[2.0, 0.0, 0.0], &[1.0, 0.0, 0.0], mu) > 0.0, "pushing while separating");
    }
}
