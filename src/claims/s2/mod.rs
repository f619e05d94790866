//! Claims of §2: tangent and normal cones, the measure differential inclusion, and friction by the bipotential.

use super::Claim;

mod bipotential;
mod half_space;
mod inclusion;
mod levels;
mod literature;
mod measures;
mod soft_contact;
mod worked_example;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    inclusion::CLAIMS,
    measures::CLAIMS,
    levels::CLAIMS,
    bipotential::CLAIMS,
    worked_example::CLAIMS,
    soft_contact::CLAIMS,
    literature::CLAIMS,
];
