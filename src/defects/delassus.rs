//! Planted defects of the family `delassus`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
