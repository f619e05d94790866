//! Planted defects: each is a reference with one textbook mistake, and the check that exists to catch it.
//!
//! A check that no defect can fail is not a check.

use crate::finding::Finding;
use moreau_exact::Result;

pub mod cone_projection;
pub mod convergence;
pub mod delassus;
pub mod energy;
pub mod stewart_trinkle;
pub mod zeno;

/// One planted mistake beside the correct reference.
pub struct Defect {
    /// A short name, `family/mistake`.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// The family's check on the defective subject: at least one finding must fail.
    pub defective: fn() -> Result<Vec<Finding>>,
    /// The same check on the reference: every finding must hold.
    pub reference: fn() -> Result<Vec<Finding>>,
}
