//! The narrow waist: what every scheme builds, every solver solves and every certificate judges.
//!
//! This module imports no solver and no scheme.

mod carried;
mod contact_problem;
#[cfg(feature = "fclib")]
mod fclib;
mod jointed;
#[cfg(feature = "files")]
mod json;
mod keys;
mod law;
mod lcp;
mod made;
mod planar_problem;
mod posed;
#[cfg(feature = "files")]
mod siconos;
mod solution;
pub mod stewart_trinkle;

pub use carried::carried;
pub use contact_problem::{Compliance, ContactProblem, ContactProblemBuilder, Coordinates, Dynamics};
pub(crate) use contact_problem::{Weights, island_rows};
#[cfg(feature = "fclib")]
pub use fclib::StoredAnswers;
pub(crate) use jointed::{ByRows, MOST_ROWS};
pub use jointed::{ConstraintKind, JointedProblem};
#[cfg(feature = "files")]
pub use json::{LcpFile, ProblemFile, SolutionFile, WarmStart};
pub use keys::ContactKey;
pub use law::Law;
pub use lcp::Lcp;
pub(crate) use made::Made;
pub use planar_problem::{ImpulseLcp, PlanarProblem, Response};
pub use posed::Posed;
pub use solution::Solution;
