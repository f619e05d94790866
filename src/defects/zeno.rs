//! Planted defects of the family `zeno`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
