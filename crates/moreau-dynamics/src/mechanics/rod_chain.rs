//! Uniform rods hinged in a row, hung up at the origin, whose ends may not pass a plane: double pendulum and chain.
//!
//! ```text
//!     q = (θ₁ … θ_n) ,   end of rod i:  p_i = Σ_{k ≤ i} l_k e(θ_k) ,   φ_i = n·p_i − c ,   H_i = (n, t)ᵀ ∂p_i/∂q
//! ```
//! M(q) and F(q, v) are those of [`super::hinged_links`].

use super::hinged_links::{HingedLinks, Link};
use super::point_mass::positive;
use super::{BodyState, Mechanism, Plane};
use moreau_contact::contact::Contact;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A chain of n uniform rods over a plane; q = absolute angles from the x axis towards z.
///
/// # Source
/// Kane and Levinson, *Dynamics: Theory and Applications* (1985), for two rods that hit a plane.
#[derive(Clone, Debug)]
pub struct RodChain {
    name: String,
    links: HingedLinks,
    lengths: Vec<f64>,
    plane: Plane,
}

impl RodChain {
    /// Rods of mass m \[kg\] and length l \[m\] each, (m, l) from the hinge at the origin on, under gravity g \[m/s²\] along −z, and a
    /// plane of the x–z plane.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no rod, a mass or length is not positive, g is not finite or the plane has not two components.
    pub fn new(name: impl Into<String>, rods: &[(f64, f64)], gravity: f64, plane: Plane) -> Result<Self> {
        if rods.is_empty() {
            return Err(Error::invalid("rods", "is empty", "give at least one rod"));
        }
        if !gravity.is_finite() {
            return Err(Error::invalid("gravity", format!("is {gravity}"), "use a finite number"));
        }
        if plane.normal.len() != 2 {
            return Err(Error::invalid("plane.normal", format!("has {}", counted(plane.normal.len(), "component")), "give x and z"));
        }
        for (mass, length) in rods {
            positive("mass", *mass)?;
            positive("length", *length)?;
        }
        let links = HingedLinks::new(rods.iter().map(|(mass, length)| Link::rod(*mass, *length)).collect(), gravity)?;
        Ok(RodChain { name: name.into(), links, lengths: rods.iter().map(|(_, length)| *length).collect(), plane })
    }
}

impl Mechanism for RodChain {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        self.links.len()
    }

    fn rows_per_contact(&self) -> usize {
        2
    }

    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        self.links.mass_matrix(position)
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        self.links.force(position, velocity)
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let end = |k: usize| self.links.contact(position, k, [self.lengths[k], 0.0], &self.plane);
        (0..self.links.len()).map(end).collect()
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.links.potential_energy(position)
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        self.links.bodies(position, velocity, |k| format!("rod{}", k + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_consistent, assert_lagrangian, assert_tangents};
    use super::*;
    use crate::mechanics::State;
    use crate::schemes::{RungeKuttaFlip, simulate};
    use crate::tolerance::mechanics::runge_kutta_energy;
    use moreau_contact::contact::delassus::delassus;
    use moreau_contact::solvers::Auto;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::double_pendulum_impact::DoublePendulum;
    use nalgebra::dvector;

    fn floor(height: f64) -> Plane {
        Plane::new(dvector![0.0, 1.0], height, 0.5, 0.5).expect("valid")
    }

    #[test]
    fn masses_forces_gaps_and_rows_belong_together() {
        let chain = RodChain::new("chain", &[(1.0, 0.4), (0.5, 0.3), (2.0, 0.6)], 9.81, floor(-1.0)).expect("valid");
        let (angles, rates) = (dvector![-0.3, -1.4, 0.7], dvector![1.2, -0.8, 2.1]);
        assert_consistent(&chain, &angles, &rates);
        assert_lagrangian(&chain, &angles, &rates);
        let ends = |q: &DVector<f64>| (0..3).map(|k| chain.links.point(q, k, [chain.lengths[k], 0.0])).collect::<Vec<_>>();
        assert_tangents(&chain, &angles, &rates, ends, |_| chain.plane.frame());
    }

    #[test]
    fn two_rods_on_the_ground_have_the_delassus_operator_of_the_closed_form() {
        let down = [20f64, 30.0].map(f64::to_radians);
        let closed = DoublePendulum { mass: 1.0, length: 1.0, angles: down.map(|angle| [angle.sin(), angle.cos()]) };
        let pendulum = RodChain::new("pendulum", &[(1.0, 1.0); 2], 9.81, floor(-2.0)).expect("valid");
        // from the x axis, the downward vertical is at −π/2
        let q = DVector::from_iterator(2, down.map(|angle| angle - std::f64::consts::FRAC_PI_2));
        let w = delassus(&pendulum.mass_matrix(&q), &pendulum.contacts(&q)[1].jacobian.to_dense()).expect("SPD");
        let [nn, nt, tt] = closed.delassus();
        for (found, expected) in [(w[(0, 0)], nn), (w[(0, 1)], nt), (w[(1, 1)], tt)] {
            // 64 operations, over det M > 1/5
            assert!((found.abs() - expected.abs()).abs() <= rounding(64, 5.0 * 3.0), "{found} against {expected}");
        }
    }

    #[test]
    fn a_free_chain_keeps_its_energy_to_fourth_order() {
        let chain = RodChain::new("chain", &[(1.0, 0.5); 5], 9.81, floor(-10.0)).expect("valid");
        let start = State { time: 0.0, position: DVector::from_element(5, -0.5), velocity: DVector::zeros(5) };
        let drift = |h: f64| {
            let run = simulate(&RungeKuttaFlip, &Auto, &chain, start.clone(), h, (0.5 / h) as usize).expect("free");
            (chain.energy(run.last()) - chain.energy(&start)).abs()
        };
        let (coarse, fine) = (drift(1.0 / 256.0), drift(1.0 / 512.0));
        assert!(fine <= runge_kutta_energy(coarse), "{coarse:e} then {fine:e}");
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(RodChain::new("none", &[], 9.81, floor(0.0)).is_err());
        assert!(RodChain::new("light", &[(0.0, 1.0)], 9.81, floor(0.0)).is_err());
        assert!(RodChain::new("short", &[(1.0, 1.0), (1.0, 0.0)], 9.81, floor(0.0)).is_err());
        assert!(RodChain::new("lost", &[(1.0, 1.0)], f64::NAN, floor(0.0)).is_err());
        let spatial = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.0, 0.0).expect("valid");
        assert!(RodChain::new("space", &[(1.0, 1.0)], 9.81, spatial).is_err());
    }
}
