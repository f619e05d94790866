//! The spring and damper of compliant contact: m q̈ = −k q − c q̇.
//!
//! ```text
//!     ω² = k/m ,   2ζω = c/m ,   s = hω      (the amplification matrix depends on s and ζ alone, up to the unit of q)
//! ```

use super::SmoothSystem;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use nalgebra::DVector;

/// A mass on a spring and a damper.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringDamper {
    /// ω² = k/m \[1/s²\].
    pub stiffness_per_mass: Rational,
    /// c/m = 2ζω \[1/s\].
    pub damping_per_mass: Rational,
}

impl SpringDamper {
    /// The spring with ω = 1/s and the damping ratio ζ: a step h has s = h.
    pub fn of_ratio(damping_ratio: Rational) -> Self {
        SpringDamper { stiffness_per_mass: ratio(1, 1), damping_per_mass: ratio(2, 1) * damping_ratio }
    }
}

impl SmoothSystem for SpringDamper {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        let (stiffness, damping) = (T::nearest(&self.stiffness_per_mass), T::nearest(&self.damping_per_mass));
        -(position * stiffness) - velocity * damping
    }
}
