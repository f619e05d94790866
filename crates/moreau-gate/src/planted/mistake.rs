//! An engine with a planted mistake.

use crate::Engine;

/// An engine with a mistake, and the checks that exist to see it.
#[derive(Clone, Copy)]
pub struct Faulty {
    /// The engine.
    pub engine: fn() -> Box<dyn Engine>,
    /// Checks that must catch it, by name; the full matrix may show more.
    pub caught_by: &'static [&'static str],
}
