//! Planted defects of the family `stewart_trinkle`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
