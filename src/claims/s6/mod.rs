//! Claims of §6: the soft contact of MuJoCo.

use super::Claim;

mod algorithms;
mod cones;
mod duality;
mod engine;
mod impedance;
mod opinions;
mod program;
mod reference;
mod smooth;
mod solvers;
mod time_constant;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    reference::CLAIMS,
    time_constant::CLAIMS,
    impedance::CLAIMS,
    duality::CLAIMS,
    smooth::CLAIMS,
    cones::CLAIMS,
    solvers::CLAIMS,
    engine::CLAIMS,
    algorithms::CLAIMS,
    opinions::CLAIMS,
];
