//! Claims of §12, the worked example: m = 1 kg, g = 10 m/s², e = ½, from 0.05 m, by hand with θ = 1.

use super::Claim;

pub mod contact_step;
pub mod convex;
pub mod energy;
pub mod first_step;
mod motion;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[first_step::CLAIMS, contact_step::CLAIMS, energy::CLAIMS, convex::CLAIMS];
