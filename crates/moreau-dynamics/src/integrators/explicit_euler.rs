//! Explicit Euler: v⁺ = v + h a(q, v), q⁺ = q + h v.

use super::{Method, Phase, SmoothSystem, ahead};
use moreau_exact::scalar::Scalar;

/// Explicit Euler: both right-hand sides at the old state.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitEuler;

impl Method for ExplicitEuler {
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        let velocity = ahead(&now.velocity, h, &system.acceleration(&now.position, &now.velocity));
        Phase { position: ahead(&now.position, h, &now.velocity), velocity }
    }
}
