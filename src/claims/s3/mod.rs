//! Claims of §3: the Moreau–Jean θ scheme, its Delassus operator, its energy.

use super::Claim;

mod contact_energy;
mod delassus;
mod drift;
pub(super) mod elastic;
mod lcp;
mod order;
mod pendulum;
mod siconos;
pub(super) mod smooth_energy;
mod solvers;
mod step;
pub(super) mod theta_step;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[
    step::CLAIMS,
    order::CLAIMS,
    delassus::CLAIMS,
    lcp::CLAIMS,
    solvers::CLAIMS,
    smooth_energy::CLAIMS,
    elastic::CLAIMS,
    contact_energy::CLAIMS,
    drift::CLAIMS,
    siconos::CLAIMS,
];
