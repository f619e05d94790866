//! Tolerances of problem, certificate and solvers, each with the reason it has the value it has.
//!
//! A tolerance is a rounding bound ([`moreau_exact::tolerance`]), a stopping rule with its reason, or a limit of sizes.

pub mod answered;
pub mod certificate;
pub mod complementarity;
pub mod cones;
pub mod first_order;
pub mod fronts;
pub mod joints;
pub mod least_norm;
pub mod limits;
pub mod newton;
pub mod problem;
pub mod proof;
#[cfg(test)]
pub mod sharpness;
pub mod solvers;
pub mod sweeps;
pub mod velocities;
