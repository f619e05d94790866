//! Convex cones of contact: second-order, polyhedral, orthant; and the de Saxcé map.
//!
//! Vectors are slices in the order (normal, tangent₁, tangent₂) with one, two or three entries.

pub mod de_saxce;
mod decision;
pub mod orthant;
pub mod polyhedral;
mod projection_jacobian;
pub mod second_order;
pub(crate) mod self_dual;

pub use decision::{Case, decide};
pub use projection_jacobian::projection_jacobian;
