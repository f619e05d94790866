//! Claims on event-driven methods (§1).

use super::super::event_driven::TOLERANCE;
pub use moreau_dynamics::tolerance::event_driven::{ACCURACY, SWITCHING};

const _: () = assert!(100.0 * TOLERANCE <= ACCURACY);

/// The order that a method of order five with located events has at least.
/// Derived.
pub const LOCATED_ORDER: f64 = 5.0 - super::ORDER_GAP;
