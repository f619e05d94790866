//! The threads that share a sweep.

use super::block_sweep::{Surroundings, Sweep, share};
use super::one_contact::OneContact;
use super::threads;
use crate::operator::slot::{Slot, slots};
use crate::tolerance::sweeps::THREADED;
use std::sync::atomic::AtomicU64;

/// What one contact sees and moves where threads may share the state.
pub(super) trait Shareable<const D: usize>: Sync {
    /// y of one contact.
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[impl Slot]) -> [f64; D];

    /// Brings the state up to the change of one contact's impulse.
    fn push(&self, contact: usize, change: &[f64; D], state: &[impl Slot]);
}

/// So many threads, and the state while they have it; where one has it, nothing.
pub(super) struct Crew {
    threads: usize,
    shared: Vec<AtomicU64>,
}

impl Crew {
    /// For so many contacts and numbers of the state: one thread for few contacts, as many as there are for others.
    pub fn new(contacts: usize, size: usize) -> Self {
        Crew::with_threads(if contacts < THREADED { 1 } else { threads::limit().get() }, size)
    }

    /// [`Crew::new`] of so many threads, however few contacts there are.
    pub fn with_threads(threads: usize, size: usize) -> Self {
        let shared = (0..if threads > 1 { size } else { 0 }).map(|_| AtomicU64::new(0)).collect();
        Crew { threads, shared }
    }

    /// Solves every contact once, and brings the state up to the changes: with the same bits, however many threads there are.
    pub fn sweep<S: Shareable<D>, L: OneContact, const D: usize>(&self, swept: &S, sweep: Sweep<L, D>, state: &mut [f64]) {
        let threads = self.threads.min(sweep.blocks.widest());
        if threads < 2 {
            return sweep.one_after_another(&mut Around { swept, state: slots(state) });
        }
        let (mut rest, mut shares) = (state, Vec::with_capacity(threads));
        for range in (0..threads).map(|thread| share(thread, threads, self.shared.len())) {
            let (own, others) = rest.split_at_mut(range.len());
            shares.push((&self.shared[range], own));
            rest = others;
        }
        sweep.side_by_side(shares, Around { swept, state: &self.shared });
    }
}

/// What one contact sees of the state, whoever has it.
struct Around<'a, S, E> {
    swept: &'a S,
    state: &'a [E],
}

impl<S, E> Clone for Around<'_, S, E> {
    fn clone(&self) -> Self {
        Around { swept: self.swept, state: self.state }
    }
}

impl<S: Shareable<D>, E: Slot, const D: usize> Surroundings<D> for Around<'_, S, E> {
    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D]) -> [f64; D] {
        self.swept.at(contact, impulse, self.state)
    }

    #[inline(always)]
    fn push(&mut self, contact: usize, change: &[f64; D]) {
        self.swept.push(contact, change, self.state);
    }
}
