//! Claims on elastic continua (§11).

use super::super::rounding;

/// Below this share a number of the finest mesh, 80 elements, has come as near to its limit as first order lets it: the front and the
/// release are each spread over an element, the node that strikes has the energy of half a one, and a third is left for the waves it sends
/// out; 3/80.
/// Derived.
pub const CONVERGING: f64 = 3.0 / 80.0;

/// A force that oscillates by its own size has an error of the size of the impulse: one half is neither that nor convergence.
/// Set.
pub const OSCILLATING: f64 = 0.5;

/// Rounding of an energy ratio over 7 steps for each of N elements: each step solves with A, cond A ≤ 2, and adds N products.
/// Derived.
pub fn energy_rounding(elements: usize) -> f64 {
    rounding(7 * elements * elements, 4.0)
}
