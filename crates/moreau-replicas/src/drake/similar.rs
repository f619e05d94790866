//! Drake's Similar: Hunt and Crossley's contact with regularised friction, coupled so that the step is convex.
//!
//! ```text
//!     ℓ(u) = −N(z) ,   z = u_n − μ (√(‖u_t‖² + v_ε²) − v_ε) ,   N' = n ,
//!     r_n = n(z) ,     r_t = −μ n(z) u_t/√(‖u_t‖² + v_ε²)
//! ```
//! n and v_ε as in [`hunt_crossley`](crate::drake::Touch). Friction is Coulomb's up to the slip scale v_ε, but the normal impulse is
//! evaluated at z instead of u_n: a sliding contact is lifted as under the associated cone law, by h μ‖u_t‖.
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

/// Drake's `kSimilar`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrakeSimilar {
    /// k, d and v_s.
    pub material: Material,
}

/// ℓ of every touching contact.
struct Similar(Vec<Touch>);

impl Similar {
    fn argument(&self, contact: usize, velocity: &[f64], length: f64) -> f64 {
        velocity[0] - self.0[contact].friction * (length - self.0[contact].slip_scale)
    }
}

impl Potential for Similar {
    fn impulse(&self, contact: usize, velocity: &[f64]) -> DVector<f64> {
        let touch = &self.0[contact];
        let (direction, length) = touch.direction(velocity);
        let (normal, _) = touch.normal(self.argument(contact, velocity, length));
        stacked(normal, direction * (-touch.friction * normal))
    }

    fn curvature(&self, contact: usize, velocity: &[f64]) -> DMatrix<f64> {
        let touch = &self.0[contact];
        let (direction, length) = touch.direction(velocity);
        let (normal, slope) = touch.normal(self.argument(contact, velocity, length));
        let (mu, along) = (touch.friction, &direction * direction.transpose());
        let across = DMatrix::identity(along.nrows(), along.nrows()) - &along;
        blocks(-slope, &(&direction * (mu * slope)), along * (-mu * mu * slope) + across * (mu * normal / length))
    }
}

impl Scheme for DrakeSimilar {
    fn name(&self) -> String {
        "drake-similar".into()
    }

    fn has_restitution(&self) -> bool {
        false
    }

    fn step(&self, _solver: &Certified, start: &Start) -> Result<Step> {
        hunt_crossley::step("drake-similar", self.material, start, Similar)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::drake::hunt_crossley::testing::{is_convex_with_its_own_gradient, touch};

    /// The law of these contacts.
    pub fn law(touches: Vec<Touch>) -> Box<dyn Potential> {
        Box::new(Similar(touches))
    }

    #[test]
    fn the_law_is_convex_with_its_own_gradient() {
        is_convex_with_its_own_gradient(&Similar(vec![touch()]));
    }

    #[test]
    fn friction_is_coulombs_beyond_the_slip_scale_and_the_normal_impulse_grows_with_slip() {
        let law = Similar(vec![touch()]);
        let (slow, fast) = (law.impulse(0, &[0.0, 0.0, 0.0]), law.impulse(0, &[0.0, 3.0, 4.0]));
        assert_eq!((slow[1], slow[2]), (0.0, 0.0));
        let ratio = fast.rows(1, 2).norm() / fast[0];
        assert!((ratio - 0.75 * 5.0 / 5f64.hypot(0.5)).abs() <= moreau_exact::tolerance::rounding(16, 1.0));
        assert!(fast[0] > slow[0]);
    }
}
