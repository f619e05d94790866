//! The gate: any simulator, in any language, judged by one set of checks ([`moreau_gate`]), with the matrix of planted mistakes.

pub use crate::defects::matrix;
pub use moreau_gate::*;
