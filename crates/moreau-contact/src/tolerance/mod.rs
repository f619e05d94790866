//! Tolerances of problem, certificate and solvers, each with the reason it has the value it has.
//!
//! A tolerance is a rounding bound ([`moreau_exact::tolerance`]), a stopping rule with its reason, or a limit of sizes.

pub mod certificate;
pub mod cones;
pub mod fronts;
pub mod limits;
pub mod problem;
pub mod solvers;
pub mod velocities;
