//! Certificates: whether an answer is a solution, decided without knowing where it came from.
//!
//! This module imports no solver and no scheme.

pub mod copositivity;
mod decision;
pub mod definiteness;
pub mod existence;
pub mod feasibility;
pub mod lcp;
pub mod natural_map;
pub mod p_matrix;
mod polyhedral;
pub mod residuals;

pub use decision::Decision;
pub use residuals::{Residuals, residuals};
