//! The θ method with one Newton step from the old state x = (q, v), ẋ = f(x) = (v, a(q, v)).
//!
//! ```text
//!     x⁺ = x + h f((1−θ) x + θ x⁺)      hence      (I − hθ ∂f/∂x)(x⁺ − x) = h f(x)
//! ```
//! The second line is the first one solved where a is linear: θ = 0 explicit Euler, ½ the implicit midpoint rule (and, for linear
//! forces, the trapezoidal rule), 1 implicit Euler. Where a is not linear it is the linearly implicit form of the same order.

use super::jacobian::jacobian;
use super::{Method, Phase, SmoothSystem};
use moreau_exact::elimination::solve;
use moreau_exact::scalar::{Dual, Rational, Scalar};
use nalgebra::{DMatrix, DVector};

/// The θ method.
#[derive(Clone, Debug)]
pub struct Theta {
    /// θ ∈ \[0, 1\].
    pub theta: Rational,
}

/// f(x) = (v, a(q, v)).
fn rate<T: Scalar>(system: &impl SmoothSystem, stacked: &DVector<T>) -> DVector<T> {
    let Phase { position, velocity } = Phase::from_stacked(stacked);
    let acceleration = system.acceleration(&position, &velocity);
    Phase { position: velocity, velocity: acceleration }.stacked()
}

impl Method for Theta {
    /// # Panics
    /// If I − hθ ∂f/∂x is singular.
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        let x = now.stacked();
        let slope = jacobian(&x, |at: &DVector<Dual<T>>| rate(system, at));
        let matrix = DMatrix::identity(x.len(), x.len()) - slope * (h.clone() * T::nearest(&self.theta));
        let change = solve(&matrix, &(rate(system, &x) * h.clone())).expect("I − hθ ∂f/∂x has an inverse for small h");
        Phase::from_stacked(&(x + change))
    }
}
