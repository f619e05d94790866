//! One planted mistake.

use crate::Engine;

/// One planted mistake.
pub struct Planted {
    /// A short name, `family/mistake`.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// The engine with the mistake.
    pub engine: fn() -> Box<dyn Engine>,
    /// Checks that must catch it, by name; the full matrix may show more.
    pub caught_by: &'static [&'static str],
}
