//! Claims on event-driven methods (§1).

use super::super::event_driven::TOLERANCE;
pub use moreau_dynamics::tolerance::event_driven::ACCURACY;

/// The same of a motion that sticks and slips: the instant of a switch is the error of s over ṡ, here at least 1/10.
pub const SWITCHING: f64 = 10.0 * ACCURACY;

const _: () = assert!(100.0 * TOLERANCE <= ACCURACY);

/// The order that a method of order five with located events has at least, if its constant drifts by less than a factor 2^1.1 a halving.
pub const LOCATED_ORDER: f64 = 3.9;
