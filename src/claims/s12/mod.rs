//! Claims of §12, the worked example: m = 1 kg, g = 10 m/s², e = ½, from 0.05 m, by hand with θ = 1.

use super::Claim;
use crate::scalar::{Rational, ratio};
use crate::schemes::exact_particle::Motion;

pub mod contact_step;
pub mod convex;
pub mod energy;
pub mod first_step;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[first_step::CLAIMS, contact_step::CLAIMS, energy::CLAIMS, convex::CLAIMS];

/// q₀ = 0.05 m, v₀ = 0.
fn start() -> Motion<Rational> {
    Motion { position: ratio(1, 20), velocity: ratio(0, 1) }
}

/// q = 0.005 m, v = −0.99 m/s, from where the chapter computes its contact step.
fn before_contact() -> Motion<Rational> {
    Motion { position: ratio(1, 200), velocity: ratio(-99, 100) }
}
