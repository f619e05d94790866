//! Numbers of any ordered field, and what rounding does to them: the ground floor of moreau.
//!
//! [`scalar::Scalar`] is a field with an order: exact rationals, `f64`, dual numbers. [`elimination`] solves linear systems in any of them,
//! [`tolerance::rounding`] bounds the error of a sum, [`Error`] is the error of every crate of the workspace.

mod cause;
pub mod doubled;
pub mod elimination;
pub mod error;
pub mod lifting;
pub mod minimum;
pub mod number;
pub mod scalar;
pub mod tolerance;
pub mod witness;

pub use error::{Error, Result};
