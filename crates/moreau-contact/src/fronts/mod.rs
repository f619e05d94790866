//! Sparse matrices eliminated by dense fronts: whose entries they are, solvers and certificates say.
//!
//! ```text
//!     J = L U ,   symmetric: J = L Lᵀ        group by group, in an order of least degree
//! ```
//! [`Tree`] orders the groups and gathers them to fronts, [`Factor`] eliminates front by front (`front.rs`, `wide_front.rs`).

mod front;
mod multifrontal;
mod need;
mod tree;
#[cfg(feature = "faer")]
mod wide_front;

pub(crate) use multifrontal::{Factor, Front, Work};
pub(crate) use tree::Tree;
