//! Claims on event-driven methods (§1).

use super::super::event_driven::TOLERANCE;
pub use moreau_dynamics::tolerance::event_driven::{ACCURACY, SWITCHING};

const _: () = assert!(100.0 * TOLERANCE <= ACCURACY);

/// The order that a method of order five with located events has at least, if its constant drifts by less than a factor 2^1.1 a halving.
pub const LOCATED_ORDER: f64 = 3.9;
