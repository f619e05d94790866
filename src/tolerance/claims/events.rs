//! Claims on event-driven methods (§1).

use super::super::event_driven::TOLERANCE;

/// Error of an event-driven motion of size 1 to 10 over a few seconds: at most 10 steps of error [`TOLERANCE`] (1 + |x|) for each of at most 10
/// events, which each hand it on with a factor below 1 + e: 100 · 10⁻¹² = 10⁻¹⁰.
pub const ACCURACY: f64 = 1e-10;

/// The same of a motion that sticks and slips: the instant of a switch is the error of s over ṡ, here at least 1/10.
pub const SWITCHING: f64 = 10.0 * ACCURACY;

const _: () = assert!(100.0 * TOLERANCE <= ACCURACY);

/// The order that a method of order five with located events has at least, if its constant drifts by less than a factor 2^1.1 a halving.
pub const LOCATED_ORDER: f64 = 3.9;
