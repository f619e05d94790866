//! The states of the worked example.

use crate::exact_particle::Motion;
use crate::scalar::{Rational, ratio};

/// q₀ = 0.05 m, v₀ = 0.
pub(super) fn start() -> Motion<Rational> {
    Motion { position: ratio(1, 20), velocity: ratio(0, 1) }
}

/// q = 0.005 m, v = −0.99 m/s, from where the chapter computes its contact step.
pub(super) fn before_contact() -> Motion<Rational> {
    Motion { position: ratio(1, 200), velocity: ratio(-99, 100) }
}
