//! Planted defects of the family `energy`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
