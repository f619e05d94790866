//! Claims of §2: tangent and normal cones, the measure differential inclusion, and friction by the bipotential.

use super::Claim;

mod bipotential;
mod half_space;
mod inclusion;

mod worked_example;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[inclusion::CLAIMS, bipotential::CLAIMS, worked_example::CLAIMS];
