//! How one number is held against another: equal, at most, at least, each within a tolerance.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a measured number is compared with the expected one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Relation {
    /// |measured − expected| ≤ tolerance.
    Equal,
    /// measured ≤ expected + tolerance.
    AtMost,
    /// measured ≥ expected − tolerance.
    AtLeast,
}

impl Relation {
    /// Whether a measured number is as the other one demands; never, if one of them is not finite.
    pub fn holds(self, measured: f64, other: f64, tolerance: f64) -> bool {
        let difference = measured - other;
        measured.is_finite()
            && other.is_finite()
            && match self {
                Relation::Equal => difference.abs() <= tolerance,
                Relation::AtMost => difference <= tolerance,
                Relation::AtLeast => difference >= -tolerance,
            }
    }

    /// Its sign.
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::AtMost => "≤",
            Relation::AtLeast => "≥",
        }
    }
}
