//! Drake's Lagged, its default: Hunt and Crossley's contact, its friction limited by the normal impulse of the state before the step.
//!
//! ```text
//!     ℓ(u) = −N(u_n) + μ n₀ √(‖u_t‖² + v_ε²) ,     N' = n ,
//!     r_n = n(u_n) ,     r_t = −μ n₀ u_t/√(‖u_t‖² + v_ε²)
//! ```
//! n, n₀ and v_ε as in [`hunt_crossley`](crate::drake::Touch). As n₀ does not move with u_n the two parts are independent: nothing lifts a
//! sliding contact, and in the step that first touches friction follows a depth the normal impulse has long left.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ (r_n φ/h + r_n²/(h²k)) − ½ rᵀW r ,      ΔẼ ≤ −Σ (r_n φ/h + r_n²/(h²k)) + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! Friction takes energy, and r·u ≤ r_n z with z = (δ − r_n/(h k))/h; with d > 0, r_n z ≤ max(0, …). A depth gives back at most k φ²/4
//! ([`crate::energy_balance`]).
//!
//! # Source
//! Castro et al., *Irrotational contact fields* (2023), §IV.

use super::primal_newton::Potential;
use crate::drake::hunt_crossley::{self, blocks, stacked};
use crate::drake::{Material, Touch};
use moreau_dynamics::schemes::{Certified, Scheme, Start, Step};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// Drake's `kLagged`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrakeLagged {
    /// k, d and v_s.
    pub material: Material,
}

/// ℓ of every touching contact.
struct Lagged(Vec<Touch>);

impl Potential for Lagged {
    fn impulse(&self, contact: usize, velocity: &[f64]) -> DVector<f64> {
        let touch = &self.0[contact];
        let (direction, _) = touch.direction(velocity);
        stacked(touch.normal(velocity[0]).0, direction * (-touch.friction * touch.explicit))
    }

    fn curvature(&self, contact: usize, velocity: &[f64]) -> DMatrix<f64> {
        let touch = &self.0[contact];
        let (direction, length) = touch.direction(velocity);
        let across = DMatrix::identity(direction.len(), direction.len()) - &direction * direction.transpose();
        let none = DVector::zeros(direction.len());
        blocks(-touch.normal(velocity[0]).1, &none, across * (touch.friction * touch.explicit / length))
    }
}

impl Scheme for DrakeLagged {
    fn name(&self) -> String {
        "drake-lagged".into()
    }

    fn has_restitution(&self) -> bool {
        false
    }

    fn step(&self, _solver: &Certified, start: &Start) -> Result<Step> {
        hunt_crossley::step("drake-lagged", self.material, start, Lagged)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::drake::hunt_crossley::testing::{is_convex_with_its_own_gradient, touch};

    /// The law of these contacts.
    pub fn law(touches: Vec<Touch>) -> Box<dyn Potential> {
        Box::new(Lagged(touches))
    }

    #[test]
    fn the_law_is_convex_with_its_own_gradient() {
        is_convex_with_its_own_gradient(&Lagged(vec![touch()]));
    }

    #[test]
    fn friction_follows_the_state_before_and_the_normal_impulse_its_own_velocity_only() {
        let law = Lagged(vec![touch()]);
        let (slow, fast) = (law.impulse(0, &[0.5, 0.0, 0.0]), law.impulse(0, &[0.5, 3.0, 4.0]));
        assert_eq!(slow[0], fast[0]);
        let expected = 0.75 * 3.0 * 5.0 / 5f64.hypot(0.5);
        assert!((fast.rows(1, 2).norm() - expected).abs() <= moreau_exact::tolerance::rounding(16, 4.0));
        // beyond the end of the normal impulse friction still acts
        assert_eq!(law.impulse(0, &[9.0, 1.0, 0.0])[0], 0.0);
        assert!(law.impulse(0, &[9.0, 1.0, 0.0])[1] < 0.0);
    }
}
