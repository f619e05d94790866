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
    /// Its sign.
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::AtMost => "≤",
            Relation::AtLeast => "≥",
        }
    }
}
