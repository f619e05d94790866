//! The classical Runge–Kutta method for ẋ = f(x), x = (q, v):
//!
//! ```text
//!     k₁ = f(x), k₂ = f(x + ½h k₁), k₃ = f(x + ½h k₂), k₄ = f(x + h k₃) ,   x⁺ = x + h (k₁ + 2k₂ + 2k₃ + k₄)/6
//! ```
//! For linear forces x⁺ = R(hA) x with R(z) = 1 + z + z²/2 + z³/6 + z⁴/24.

use super::{Method, Phase, SmoothSystem, ahead};
use moreau_exact::scalar::Scalar;

/// The classical Runge–Kutta method of order four.
#[derive(Clone, Copy, Debug)]
pub struct RungeKutta;

impl Method for RungeKutta {
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        let rate = |at: &Phase<T>| Phase { position: at.velocity.clone(), velocity: system.acceleration(&at.position, &at.velocity) };
        let along = |share: &T, k: &Phase<T>| Phase {
            position: ahead(&now.position, share, &k.position),
            velocity: ahead(&now.velocity, share, &k.velocity),
        };
        let half = h.clone() * T::ratio(1, 2);
        let first = rate(now);
        let second = rate(&along(&half, &first));
        let third = rate(&along(&half, &second));
        let fourth = rate(&along(h, &third));
        let sum = |of: fn(&Phase<T>) -> &nalgebra::DVector<T>| of(&first) + (of(&second) + of(&third)) * T::ratio(2, 1) + of(&fourth);
        let mean = Phase { position: sum(|k| &k.position), velocity: sum(|k| &k.velocity) };
        along(&(h.clone() * T::ratio(1, 6)), &mean)
    }
}
