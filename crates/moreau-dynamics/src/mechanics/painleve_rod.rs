//! Painlevé's rod: a uniform rod whose lower end slides on a rough floor.
//!
//! ```text
//!     q = (x, y, θ) of the centre, θ the angle to the floor;  s = sin θ, c = cos θ, half-length l, I = m l²/3
//!     lower end (x − l c, y − l s),   φ = y − l s,   H = [ 0 1 −l c ;  1 0 l s ]
//!     W_nn = (1 + 3c²)/m,   W_nt = −3 s c/m,   W_tt = (1 + 3s²)/m
//! ```
//! Sliding with its lower end ahead, away from the side the rod leans to, W_nn + μ W_nt turns negative for μ > (1 + 3c²)/(3 s c): no
//! forward sliding force exists, or two do – the paradox that impulses resolve.

use super::point_mass::{material, positive};
use super::{BodyState, Mechanism};
use moreau_contact::contact::Contact;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// A uniform rod with one end over a rough floor; q = (x, y, θ).
///
/// # Source
/// Painlevé 1895; Génot and Brogliato 1999; chapter §0 and §4.
#[derive(Clone, Debug)]
pub struct PainleveRod {
    mass: f64,
    half_length: f64,
    gravity: f64,
    friction: f64,
    restitution: f64,
}

impl PainleveRod {
    /// A rod of mass m \[kg\] and half-length l \[m\] under gravity g \[m/s²\] (downwards positive).
    ///
    /// # Errors
    /// [`Error::Invalid`] if mass or half-length is not positive, g is not finite, μ < 0 or e ∉ \[0, 1\].
    pub fn new(mass: f64, half_length: f64, gravity: f64, friction: f64, restitution: f64) -> Result<Self> {
        positive("mass", mass)?;
        positive("half_length", half_length)?;
        material(friction, restitution)?;
        if !gravity.is_finite() {
            return Err(Error::invalid("gravity", format!("is {gravity}"), "use a finite number"));
        }
        Ok(PainleveRod { mass, half_length, gravity, friction, restitution })
    }

    /// I = m l²/3 \[kg·m²\] about the centre.
    pub fn inertia(&self) -> f64 {
        self.mass * self.half_length * self.half_length / 3.0
    }
}

impl Mechanism for PainleveRod {
    fn name(&self) -> &str {
        "Painlevé rod"
    }

    fn degrees_of_freedom(&self) -> usize {
        3
    }

    fn rows_per_contact(&self) -> usize {
        2
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_diagonal(&dvector![self.mass, self.mass, self.inertia()])
    }

    fn force(&self, _position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        dvector![0.0, -self.mass * self.gravity, 0.0]
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let (s, c) = position[2].sin_cos();
        let l = self.half_length;
        vec![Contact {
            gap: position[1] - l * s,
            jacobian: dmatrix![0.0, 1.0, -l * c; 1.0, 0.0, l * s].into(),
            friction: self.friction,
            restitution: self.restitution,
            place: None,
        }]
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.mass * self.gravity * position[1]
    }

    /// θ turns x towards the vertical, which is a rotation about −ŷ.
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let (s, c) = (position[2] / 2.0).sin_cos();
        vec![BodyState {
            name: "rod".into(),
            position: [position[0], 0.0, position[1]],
            orientation: [c, 0.0, -s, 0.0],
            linear_velocity: [velocity[0], 0.0, velocity[1]],
            angular_velocity: [0.0, -velocity[2], 0.0],
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_consistent;
    use super::*;
    use moreau_contact::contact::delassus::delassus;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn delassus_operator_is_that_of_the_textbooks() {
        let (mass, angle) = (2.0, 1.1f64);
        let rod = PainleveRod::new(mass, 0.7, 9.81, 0.5, 0.0).expect("valid");
        let q = dvector![0.3, 0.8, angle];
        let w = delassus(&rod.mass_matrix(&q), &rod.contacts(&q)[0].jacobian.to_dense()).expect("SPD");
        let (s, c) = angle.sin_cos();
        let expected = dmatrix![1.0 + 3.0 * c * c, -3.0 * s * c; -3.0 * s * c, 1.0 + 3.0 * s * s] / mass;
        assert!((w - expected).amax() <= rounding(8, 4.0 / mass));
    }

    #[test]
    fn gap_and_jacobian_agree() {
        let rod = PainleveRod::new(2.0, 0.7, 9.81, 0.5, 0.0).expect("valid");
        assert_consistent(&rod, &dvector![0.3, 0.8, 1.1], &dvector![-0.4, 0.3, 1.7]);
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(PainleveRod::new(0.0, 1.0, 9.81, 0.5, 0.0).is_err());
        assert!(PainleveRod::new(1.0, -1.0, 9.81, 0.5, 0.0).is_err());
        assert!(PainleveRod::new(1.0, 1.0, f64::NAN, 0.5, 0.0).is_err());
    }
}
