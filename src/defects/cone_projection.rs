//! Planted defects of the family `cone_projection`.

use super::Defect;

/// The defects of this family.
pub const DEFECTS: &[Defect] = &[];
