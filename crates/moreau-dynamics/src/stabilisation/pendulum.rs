//! A point mass on a rigid rod: g(q) = |q| − ℓ, G = q/|q|, F = (0, −m γ) with gravity γ – the plainest mechanism with a joint.

use super::Constrained;
use crate::mechanics::State;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, dvector};

/// Pendulum of mass m and length ℓ about the origin; q = (x, z), z upwards.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    mass: f64,
    length: f64,
    gravity: f64,
}

impl Pendulum {
    /// Mass m \[kg\], length ℓ \[m\] and gravity \[m/s²\], along −z.
    ///
    /// # Errors
    /// If mass or length is not positive or gravity is not finite.
    pub fn new(mass: f64, length: f64, gravity: f64) -> Result<Self> {
        for (field, value) in [("mass", mass), ("length", length)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        if !gravity.is_finite() {
            return Err(Error::invalid("gravity", format!("is {gravity}"), "use a finite number"));
        }
        Ok(Pendulum { mass, length, gravity })
    }

    /// On the circle, at the angle from the downward vertical \[rad\], with the speed along the circle \[m/s\].
    pub fn at(&self, angle: f64, speed: f64) -> State {
        let (sine, cosine) = angle.sin_cos();
        let velocity = dvector![cosine, sine] * speed;
        State { time: 0.0, position: dvector![sine, -cosine] * self.length, velocity }
    }
}

impl Constrained for Pendulum {
    fn mass_matrix(&self) -> DMatrix<f64> {
        DMatrix::identity(2, 2) * self.mass
    }

    fn force(&self, _position: &DVector<f64>) -> DVector<f64> {
        dvector![0.0, -self.mass * self.gravity]
    }

    fn violation(&self, position: &DVector<f64>) -> DVector<f64> {
        dvector![position[0].hypot(position[1]) - self.length]
    }

    fn jacobian(&self, position: &DVector<f64>) -> DMatrix<f64> {
        let distance = position[0].hypot(position[1]);
        DMatrix::from_row_slice(1, 2, &[position[0] / distance, position[1] / distance])
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.mass * self.gravity * position[1]
    }
}
