//! The pictures, one question each.

use crate::Picture;

/// Every picture, in the order of the chapter.
pub const PICTURES: &[&Picture] = &[];
