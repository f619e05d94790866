//! A bead inside a circle: m v̇ = m g + Hᵀλ, φ = R − |q| – the simplest curved unilateral constraint.
//!
//! The admissible set is a disk, so it is convex, but its boundary is curved: a step along the tangent leaves it by
//! h²v²κ/2 with κ = 1/R, which velocity-level schemes do not see.

use super::point_mass::{material, positive};
use super::{BodyState, Mechanism};
use moreau_contact::contact::Contact;
use moreau_contact::contact::frame::planar_tangent;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, dvector};

/// A point mass that may not leave a disk of radius R about the origin; q = (x, z).
#[derive(Clone, Debug)]
pub struct BeadInCircle {
    mass: f64,
    radius: f64,
    gravity: f64,
    friction: f64,
    restitution: f64,
}

impl BeadInCircle {
    /// A bead of mass m \[kg\] in a circle of radius R \[m\] under gravity g \[m/s²\] along −z.
    ///
    /// # Errors
    /// [`Error::Invalid`] if mass or radius is not positive, g is not finite, μ < 0 or e ∉ \[0, 1\].
    pub fn new(mass: f64, radius: f64, gravity: f64, friction: f64, restitution: f64) -> Result<Self> {
        positive("mass", mass)?;
        positive("radius", radius)?;
        material(friction, restitution)?;
        if !gravity.is_finite() {
            return Err(Error::invalid("gravity", format!("is {gravity}"), "use a finite number"));
        }
        Ok(BeadInCircle { mass, radius, gravity, friction, restitution })
    }
}

impl Mechanism for BeadInCircle {
    fn name(&self) -> &str {
        "bead in a circle"
    }

    fn degrees_of_freedom(&self) -> usize {
        2
    }

    fn rows_per_contact(&self) -> usize {
        2
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::identity(2, 2) * self.mass
    }

    fn force(&self, _position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        dvector![0.0, -self.mass * self.gravity]
    }

    /// The normal points to the centre; at the centre itself, where every direction would do, it is +z.
    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let distance = position[0].hypot(position[1]);
        let normal = if distance > 0.0 { [-position[0] / distance, -position[1] / distance] } else { [0.0, 1.0] };
        let tangent = planar_tangent(normal);
        vec![Contact {
            gap: self.radius - distance,
            jacobian: DMatrix::from_row_slice(2, 2, &[normal, tangent].concat()).into(),
            friction: self.friction,
            restitution: self.restitution,
            place: None,
        }]
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.mass * self.gravity * position[1]
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        vec![BodyState {
            name: "bead".into(),
            position: [position[0], 0.0, position[1]],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [velocity[0], 0.0, velocity[1]],
            angular_velocity: [0.0; 3],
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_consistent;
    use super::*;

    #[test]
    fn gap_and_jacobian_agree_inside_on_and_outside_the_circle() {
        let bead = BeadInCircle::new(1.5, 1.0, 9.81, 0.3, 0.5).expect("valid");
        for q in [dvector![0.3, -0.4], dvector![0.6, -0.8], dvector![-0.9, 0.9]] {
            assert_consistent(&bead, &q, &dvector![0.7, 0.2]);
        }
    }

    #[test]
    fn the_centre_has_a_finite_frame() {
        let bead = BeadInCircle::new(1.0, 2.0, 0.0, 0.0, 0.0).expect("valid");
        let contact = &bead.contacts(&dvector![0.0, 0.0])[0];
        assert_eq!(contact.gap, 2.0);
        assert!(contact.jacobian.to_dense().iter().all(|x| x.is_finite()));
    }

    #[test]
    fn a_tangential_step_leaves_the_circle_by_half_h_squared_v_squared_over_r() {
        let bead = BeadInCircle::new(1.0, 2.0, 0.0, 0.0, 0.0).expect("valid");
        let (h, v) = (1.0 / 1024.0, 3.0);
        let gap = bead.contacts(&bead.integrate(&dvector![2.0, 0.0], &dvector![0.0, v], h))[0].gap;
        let sagitta = h * h * v * v / (2.0 * 2.0);
        assert!((gap + sagitta).abs() <= sagitta * sagitta, "√(R²+x²) − R − x²/2R lies in (−x⁴/8R³, 0)");
    }
}
