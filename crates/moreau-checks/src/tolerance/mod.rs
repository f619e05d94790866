//! Tolerances of checks, each with the reason it has the value it has.

pub mod cone_projection;
pub mod convergence;
pub mod delassus;
pub mod zeno;
