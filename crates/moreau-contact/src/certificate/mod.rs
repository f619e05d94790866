//! Certificates: whether an answer is a solution, decided without knowing where it came from.
//!
//! This module imports no solver and no scheme.

mod at_contact;
pub mod backward;
mod by_contact;
mod closing;
pub mod complementary_cones;
pub mod copositivity;
mod decision;
mod definite;
pub mod definiteness;
mod dictionary;
#[cfg(test)]
mod draw;
pub mod existence;
pub mod feasibility;
pub mod forward;
mod groups;
pub mod impulse_set;
mod in_fractions;
pub mod infeasible;
pub mod interval;
mod joint_scales;
pub mod jointed_proof;
pub mod joints;
mod judge;
mod judged;
mod kernel_witness;
pub mod lcp;
mod lcp_enclosure;
mod lcp_exact;
pub mod lcp_proof;
mod least;
mod monotone;
mod moving;
pub mod natural_map;
pub mod p_matrix;
pub mod p_structure;
mod part;
pub mod patterns;
mod planted;
mod polyhedral;
mod polyhedral_pair;
pub mod polyhedral_proof;
pub mod polyhedral_solutions;
mod rank;
mod reach;
mod remembered;
pub mod residuals;
#[cfg(feature = "files")]
mod residuals_json;
mod scales;
pub mod segment;
mod semidefinite;
pub mod separate;
pub mod several;
pub mod spatial;
mod step;
pub mod true_operator;
pub mod uniqueness;
pub mod verified_cholesky;

pub use by_contact::{ContactResiduals, by_contact};
pub use decision::Decision;
pub use judge::Judge;
pub use judged::{Judged, Worst};
pub use part::Part;
pub use residuals::{Residuals, residuals};
pub use step::{Judgement, StepResidual};
