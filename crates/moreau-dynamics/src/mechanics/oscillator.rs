//! A linear oscillator with a stop: m v̇ = −k q − c v + λ, φ = q − q_stop, 0 ≤ φ ⟂ λ ≥ 0.

use super::point_mass::{material, positive};
use super::{BodyState, LinearForce, Mechanism};
use moreau_contact::contact::Contact;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// A mass on a spring and damper that may not move below a stop; q = elongation.
#[derive(Clone, Debug)]
pub struct OscillatorWithStop {
    mass: f64,
    stiffness: f64,
    damping: f64,
    stop: f64,
    restitution: f64,
}

impl OscillatorWithStop {
    /// Mass m \[kg\], stiffness k \[N/m\], damping c \[N·s/m\], stop at q = `stop` \[m\].
    ///
    /// # Errors
    /// [`Error::Invalid`] if the mass is not positive, k or c is negative, the stop is not finite or e ∉ \[0, 1\].
    pub fn new(mass: f64, stiffness: f64, damping: f64, stop: f64, restitution: f64) -> Result<Self> {
        positive("mass", mass)?;
        for (field, value) in [("stiffness", stiffness), ("damping", damping)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a finite number ≥ 0"));
            }
        }
        if !stop.is_finite() {
            return Err(Error::invalid("stop", format!("is {stop}"), "use a finite number"));
        }
        material(0.0, restitution)?;
        Ok(OscillatorWithStop { mass, stiffness, damping, stop, restitution })
    }
}

impl Mechanism for OscillatorWithStop {
    fn name(&self) -> &str {
        "oscillator with a stop"
    }

    fn degrees_of_freedom(&self) -> usize {
        1
    }

    fn rows_per_contact(&self) -> usize {
        1
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        dmatrix![self.mass]
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        dvector![-self.stiffness * position[0] - self.damping * velocity[0]]
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        vec![Contact {
            gap: position[0] - self.stop,
            jacobian: dmatrix![1.0].into(),
            friction: 0.0,
            restitution: self.restitution,
            place: None,
        }]
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        0.5 * self.stiffness * position[0] * position[0]
    }

    fn linear_force(&self) -> Option<LinearForce> {
        Some(LinearForce { stiffness: dmatrix![self.stiffness], damping: dmatrix![self.damping] })
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        vec![BodyState {
            name: "mass".into(),
            position: [position[0], 0.0, 0.0],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [velocity[0], 0.0, 0.0],
            angular_velocity: [0.0; 3],
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_consistent;
    use super::*;

    #[test]
    fn force_potential_and_gap_agree() {
        let oscillator = OscillatorWithStop::new(2.0, 30.0, 0.4, -0.1, 0.5).expect("valid");
        assert_consistent(&oscillator, &dvector![0.3], &dvector![-1.2]);
    }

    #[test]
    fn the_linear_force_is_the_force() {
        let oscillator = OscillatorWithStop::new(2.0, 30.0, 0.4, -0.1, 0.5).expect("valid");
        let LinearForce { stiffness, damping } = oscillator.linear_force().expect("a linear oscillator");
        let (q, v) = (dvector![0.3], dvector![-1.2]);
        assert_eq!(oscillator.force(&q, &v), -(stiffness * &q) - damping * &v);
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(OscillatorWithStop::new(2.0, -1.0, 0.4, 0.0, 0.5).is_err());
        assert!(OscillatorWithStop::new(2.0, 1.0, f64::NAN, 0.0, 0.5).is_err());
        assert!(OscillatorWithStop::new(2.0, 1.0, 0.0, f64::INFINITY, 0.5).is_err());
        assert!(OscillatorWithStop::new(2.0, 1.0, 0.0, 0.0, 1.5).is_err());
    }
}
