//! Semi-implicit Euler: first the velocity, then the position with the new velocity.
//!
//! ```text
//!     damping explicit:   v⁺ = v + h a(q, v)                        q⁺ = q + h v⁺
//!     damping implicit:   v⁺ = v + (I − h A)⁻¹ h a(q, v) ,  A = ∂a/∂v
//! ```
//! The second is one Newton step of v⁺ = v + h a(q, v⁺) from v, and its solution where a is linear in v.

use super::jacobian::jacobian;
use super::{Method, Phase, SmoothSystem, ahead};
use moreau_exact::elimination::solve;
use moreau_exact::scalar::{Dual, Scalar};
use nalgebra::DMatrix;

/// Where forces that depend on the velocity are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// At v.
    Explicit,
    /// At v⁺, linearised at v.
    Implicit,
}

/// Semi-implicit (symplectic) Euler.
#[derive(Clone, Copy, Debug)]
pub struct SemiImplicitEuler {
    /// Where forces that depend on the velocity are evaluated.
    pub damping: Damping,
}

impl Method for SemiImplicitEuler {
    /// # Panics
    /// With implicit damping, if I − h A is singular.
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        let Phase { position, velocity } = now;
        let mut change = system.acceleration(position, velocity) * h.clone();
        if self.damping == Damping::Implicit {
            let slope = jacobian(velocity, |v| system.acceleration(&position.map(Dual::constant), v));
            let matrix = DMatrix::identity(change.len(), change.len()) - slope * h.clone();
            change = solve(&matrix, &change).expect("I − h ∂a/∂v has an inverse where forces do not grow with the velocity");
        }
        let velocity = velocity + change;
        Phase { position: ahead(position, h, &velocity), velocity }
    }
}
