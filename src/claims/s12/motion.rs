//! The states of the worked example.

use crate::exact_particle::BallState;
use crate::scalar::{Rational, ratio};

/// q₀ = 0.05 m, v₀ = 0.
pub(super) fn start() -> BallState<Rational> {
    BallState { position: ratio(1, 20), velocity: ratio(0, 1) }
}

/// q = 0.005 m, v = −0.99 m/s, from where the chapter computes its contact step.
pub(super) fn before_contact() -> BallState<Rational> {
    BallState { position: ratio(1, 200), velocity: ratio(-99, 100) }
}
