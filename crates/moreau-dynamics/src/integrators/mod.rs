//! One-step methods for q̇ = v, v̇ = a(q, v) in any ordered field, one per file, and what can be decided about a step map.
//!
//! ```text
//!     (q, v) ↦ (q⁺, v⁺) ,   D = ∂(q⁺, v⁺)/∂(q, v)
//! ```
//! Over rationals a step is exact, and so is its Jacobian, which dual numbers carry along ([`jacobian`]). For linear forces D is the
//! method's amplification matrix: its powers stay bounded or not ([`stability`]). For Hamiltonian motion D keeps the
//! symplectic form or not ([`symplectic`]), also across an impact ([`impact_flow`], [`variational`]).
//!
//! The other methods know no contact; the schemes do.

use moreau_exact::scalar::Scalar;
use nalgebra::{DMatrix, DVector};

mod dormand_prince;
mod explicit_euler;
pub mod impact_flow;
pub mod jacobian;
pub mod root;
mod runge_kutta;
mod semi_implicit_euler;
mod spring_damper;
pub mod stability;
pub mod symplectic;
mod theta;
pub mod variational;

pub use dormand_prince::DormandPrinceStep;
pub use explicit_euler::ExplicitEuler;
pub use runge_kutta::RungeKutta;
pub use semi_implicit_euler::{Damping, SemiImplicitEuler};
pub use spring_damper::SpringDamper;
pub use theta::Theta;

/// A smooth motion, q̇ = v, v̇ = a(q, v), with n coordinates.
pub trait SmoothSystem {
    /// a(q, v) \[m/s², rad/s²\], n entries.
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T>;
}

/// A point (q, v) of the phase space.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase<T: Scalar> {
    /// q, n entries.
    pub position: DVector<T>,
    /// v, n entries.
    pub velocity: DVector<T>,
}

impl<T: Scalar> Phase<T> {
    /// The point of a motion with one coordinate.
    pub fn of_one(position: T, velocity: T) -> Self {
        Phase { position: DVector::from_element(1, position), velocity: DVector::from_element(1, velocity) }
    }

    /// The point with the 2n entries (q, v).
    pub fn from_stacked(entries: &DVector<T>) -> Self {
        let n = entries.len() / 2;
        Phase { position: entries.rows(0, n).into_owned(), velocity: entries.rows(n, n).into_owned() }
    }

    /// The 2n entries (q, v).
    pub fn stacked(&self) -> DVector<T> {
        DVector::from_iterator(2 * self.position.len(), self.position.iter().chain(self.velocity.iter()).cloned())
    }
}

/// A one-step method.
pub trait Method {
    /// The state after a step h \[s\].
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T>;

    /// D = ∂(q⁺, v⁺)/∂(q, v) of a step, 2n × 2n.
    fn jacobian<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> DMatrix<T>
    where
        Self: Sized,
    {
        jacobian::jacobian(&now.stacked(), |at| {
            let h = moreau_exact::scalar::Dual::constant(h.clone());
            self.step(system, &Phase::from_stacked(at), &h).stacked()
        })
    }
}

/// x + c y.
fn ahead<T: Scalar>(x: &DVector<T>, c: &T, y: &DVector<T>) -> DVector<T> {
    x + y * c.clone()
}

#[cfg(test)]
mod tests;
