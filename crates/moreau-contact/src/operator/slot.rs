//! Numbers that are read and written in place, whether one thread has them or several.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A number in its place.
pub(crate) trait Slot {
    /// The number that stands there.
    fn get(&self) -> f64;

    /// Puts another one there.
    fn set(&self, number: f64);
}

/// Of one thread.
impl Slot for Cell<f64> {
    #[inline(always)]
    fn get(&self) -> f64 {
        Cell::get(self)
    }

    #[inline(always)]
    fn set(&self, number: f64) {
        Cell::set(self, number);
    }
}

/// Its bits, of several threads. Nothing orders what they do, which costs a processor nothing; who needs an order waits.
impl Slot for AtomicU64 {
    #[inline(always)]
    fn get(&self) -> f64 {
        f64::from_bits(self.load(Relaxed))
    }

    #[inline(always)]
    fn set(&self, number: f64) {
        self.store(number.to_bits(), Relaxed);
    }
}

/// These numbers as slots of one thread.
#[inline(always)]
pub(crate) fn slots(numbers: &mut [f64]) -> &[Cell<f64>] {
    Cell::from_mut(numbers).as_slice_of_cells()
}

/// The numbers that stand next to each other.
#[inline(always)]
pub(crate) fn load<const N: usize>(slots: &[impl Slot; N]) -> [f64; N] {
    std::array::from_fn(|place| slots[place].get())
}

/// Adds to the numbers that stand next to each other: all are read before one is written.
#[inline(always)]
pub(crate) fn add<const N: usize>(slots: &[impl Slot; N], added: &[f64; N]) {
    let before = load(slots);
    (0..N).for_each(|place| slots[place].set(before[place] + added[place]));
}
