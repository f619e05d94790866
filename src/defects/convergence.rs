//! Planted defects of the family `convergence`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
