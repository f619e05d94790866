//! One sweep: colour after colour, of each colour block after block, of each block contact after contact.
//!
//! ```text
//!     y_k → r_k of the law of contact k alone → Δr_k → y                    Σ A_nn‖Δr‖² block by block
//! ```
//! Blocks of one colour touch nothing in common ([`colours`](super::colours)), so that several threads sweep them at the same time to the
//! same bits. Each thread has contacts, impulses and a sum of its own; what contacts move is read and written by whoever has the block, and
//! between two colours all threads wait for each other. Every number that threads share is an atomic: relaxed ones, which cost a processor
//! nothing, since the waiting orders them.

use super::colours::Blocks;
use super::one_contact::OneContact;
use super::watch::is_over;
use crate::memory::spare::spare_entries;
use crate::operator::slot::Slot;
use crate::tolerance::sweeps::LOOKED;
use std::ops::Range;
use std::sync::Barrier;
use std::sync::atomic::AtomicU64;

/// What contacts see of all others, and move of them.
pub(super) trait Surroundings<const D: usize> {
    /// y of one contact.
    fn at(&self, contact: usize, impulse: &[f64; D]) -> [f64; D];

    /// Brings everything up to the change of one contact's impulse.
    fn push(&mut self, contact: usize, change: &[f64; D]);
}

/// What a sweep of one block changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Change {
    /// Σ A_nn‖Δr‖² \[J\].
    pub squares: f64,
    /// Whether any impulse changed.
    pub moved: bool,
}

spare_entries![Change];

/// Contacts that are swept one after the other, and their impulses.
struct Piece<'a, L, const D: usize> {
    first: usize,
    contacts: &'a mut [L],
    impulses: &'a mut [[f64; D]],
    change: &'a mut Change,
}

impl<L: OneContact, const D: usize> Piece<'_, L, D> {
    #[inline(always)]
    fn sweep(&mut self, around: &mut impl Surroundings<D>) {
        let mut all = Change::default();
        for (place, (contact, impulse)) in self.contacts.iter_mut().zip(self.impulses.iter_mut()).enumerate() {
            // of several threads the first one is watched
            if place % LOOKED == 0 && is_over() {
                break;
            }
            let k = self.first + place;
            let new = contact.solve(without(contact.block(), impulse, &around.at(k, impulse)));
            let mut change = [0.0; D];
            (0..D).for_each(|row| change[row] = new[row] - impulse[row]);
            impulse.copy_from_slice(&new[..D]);
            if change.iter().any(|change| *change != 0.0) {
                all.moved = true;
                all.squares += contact.block()[0] * change.iter().map(|change| change * change).sum::<f64>();
                around.push(k, &change);
            }
        }
        *self.change = all;
    }
}

/// q = y − A r, padded: the velocity of the contact without its own impulse.
#[inline(always)]
fn without<const D: usize>(block: &[f64; 9], impulse: &[f64; D], velocity: &[f64; D]) -> [f64; 3] {
    let mut q = [0.0; 3];
    for row in 0..D {
        let own: f64 = (0..D).map(|column| block[3 * row + column] * impulse[column]).sum();
        q[row] = velocity[row] - own;
    }
    q
}

/// What a sweep goes over: the contacts in their blocks, their impulses, and a change for each block.
pub(super) struct Sweep<'a, L, const D: usize> {
    pub blocks: &'a Blocks,
    pub contacts: &'a mut [L],
    pub impulses: &'a mut [[f64; D]],
    pub changes: &'a mut [Change],
}

impl<'a, L: OneContact, const D: usize> Sweep<'a, L, D> {
    /// Sweeps in one thread.
    pub fn one_after_another(self, around: &mut impl Surroundings<D>) {
        let Sweep { blocks, contacts, impulses, changes } = self;
        for &block in blocks.colours.iter().flatten() {
            let range = blocks.range(block, contacts.len());
            let (contacts, impulses) = (&mut contacts[range.clone()], &mut impulses[range.clone()]);
            Piece { first: range.start, contacts, impulses, change: &mut changes[block] }.sweep(around);
        }
    }

    /// Sweeps in as many threads as there are `shares` of the state: each puts its own into the slots that all share before the first
    /// contact, and takes it back after the last one.
    pub fn side_by_side<A: Surroundings<D> + Clone + Send>(self, shares: Vec<(&[AtomicU64], &mut [f64])>, around: A) {
        let barrier = Barrier::new(shares.len());
        let go = |(shared, own): (&[AtomicU64], &mut [f64]), work: Vec<Vec<Piece<'a, L, D>>>, mut around: A| {
            shared.iter().zip(own.iter()).for_each(|(shared, number)| shared.set(*number));
            for mut pieces in work {
                barrier.wait();
                pieces.iter_mut().for_each(|piece| piece.sweep(&mut around));
            }
            barrier.wait();
            shared.iter().zip(own).for_each(|(shared, number)| *number = shared.get());
        };
        let (go, work) = (&go, self.shared_out(shares.len()));
        std::thread::scope(|scope| {
            let mut threads = shares.into_iter().zip(work);
            let own = threads.next();
            for (share, work) in threads {
                let around = around.clone();
                scope.spawn(move || go(share, work, around));
            }
            if let Some((share, work)) = own {
                go(share, work, around);
            }
        });
    }

    /// For each thread, of every colour consecutive blocks.
    fn shared_out(self, threads: usize) -> Vec<Vec<Vec<Piece<'a, L, D>>>> {
        let Sweep { blocks, contacts, impulses, changes } = self;
        let parts = contacts.chunks_mut(blocks.size).zip(impulses.chunks_mut(blocks.size)).zip(changes);
        let piece = |(block, ((contacts, impulses), change))| Some(Piece { first: block * blocks.size, contacts, impulses, change });
        let mut pieces: Vec<Option<Piece<L, D>>> = parts.enumerate().map(piece).collect();
        let mut work: Vec<Vec<Vec<Piece<L, D>>>> = (0..threads).map(|_| Vec::with_capacity(blocks.colours.len())).collect();
        for colour in blocks.colours.iter() {
            for (thread, own) in work.iter_mut().enumerate() {
                let blocks = colour[share(thread, threads, colour.len())].iter();
                own.push(blocks.map(|block| pieces[*block].take().expect("every block has one colour")).collect());
            }
        }
        work
    }
}

/// Which of so many things are the share of one thread.
pub(super) fn share(thread: usize, threads: usize, count: usize) -> Range<usize> {
    thread * count / threads..(thread + 1) * count / threads
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_all_threads_are_everything_once() {
        for (threads, count) in [(1, 0), (3, 2), (3, 10), (64, 7)] {
            assert_eq!((0..threads).flat_map(|thread| share(thread, threads, count)).collect::<Vec<_>>(), (0..count).collect::<Vec<_>>());
        }
    }
}
