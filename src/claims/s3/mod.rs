//! Claims of §3: the Moreau–Jean θ scheme, its Delassus operator, its energy.

use super::Claim;

mod contact_energy;
mod delassus;
mod drift;
mod elastic;
mod lcp;
mod order;
mod siconos;
mod smooth_energy;
mod solvers;
mod step;

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
