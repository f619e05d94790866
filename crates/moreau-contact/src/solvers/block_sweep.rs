//! One sweep: colour after colour, of each colour block after block, of each block contact after contact.
//!
//! ```text
//!     y_k → r_k of the law of contact k alone → Δr_k → y                    Σ A_nn‖Δr‖² block by block
//! ```
//! Blocks of one colour touch no body in common ([`colours`](super::colours)), so that several threads sweep them at the same time to the
//! same bits. Each thread has contacts, impulses and a sum of its own; body velocities are read and written by whoever has the block, and
//! between two colours all threads wait for each other. Every number that threads share is an atomic: relaxed ones, which cost a processor
//! nothing, since the waiting orders them.

use super::colours::Blocks;
use super::one_contact::OneContact;
use super::watch::is_over;
use crate::memory::spare::spare_entries;
use crate::tolerance::sweeps::LOOKED;
use std::ops::Range;
use std::sync::Barrier;

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

    /// Sweeps in as many threads as there are `shares` of what they share: each gets its share into place before the first contact and
    /// back after the last one.
    pub fn side_by_side<A, S>(self, shares: Vec<S>, around: A, begin: impl Fn(&S) + Sync, end: impl Fn(&mut S) + Sync)
    where
        A: Surroundings<D> + Clone + Send,
        S: Send,
    {
        let barrier = Barrier::new(shares.len());
        let go = |mut share: S, work: Vec<Vec<Piece<'a, L, D>>>, mut around: A| {
            begin(&share);
            for mut pieces in work {
                barrier.wait();
                pieces.iter_mut().for_each(|piece| piece.sweep(&mut around));
            }
            barrier.wait();
            end(&mut share);
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
    use super::super::colours::coloured;
    use super::super::one_contact::Coulomb;
    use super::super::swept::{Bodies, Swept};
    use super::*;
    use crate::operator::{BlockRows, MatrixFree};
    use crate::problem::ContactProblem;
    use crate::tolerance::sweeps::BLOCK;
    use nalgebra::{DMatrix, DVector, Matrix3};

    /// Six blocks and a half of contacts along a chain of bodies, with numbers of no pattern.
    fn chain() -> ContactProblem {
        let n = 13 * BLOCK / 2;
        let number = |seed: usize| ((seed.wrapping_mul(2_654_435_761) >> 7) % 1000) as f64 / 500.0 - 1.0;
        let mut rows = BlockRows::new(3, vec![6; n + 1]).unwrap();
        for k in 0..n {
            let block = |side: usize| -> [f64; 18] { std::array::from_fn(|place| number(36 * k + 18 * side + place)) };
            rows.push(&[(k, &block(0)), (k + 1, &block(1))]).unwrap();
        }
        let mass = DMatrix::from_diagonal(&DVector::from_fn(6, |axis, _| 1.0 + axis as f64));
        let free = DVector::from_fn(3 * n, |row, _| number(7 * row + 3) - if row % 3 == 0 { 0.5 } else { 0.0 });
        let operator = MatrixFree::new(&vec![mass; n + 1], rows).unwrap();
        ContactProblem::new(operator, free).friction(vec![0.5; n]).build().unwrap()
    }

    /// Impulses, body velocities and changes after a few sweeps, bit by bit.
    fn swept(problem: &ContactProblem, blocks: &Blocks, threads: usize) -> Vec<u64> {
        let bodies = Bodies::<3>::with_threads(problem, problem.delassus().matrix_free().unwrap(), threads).unwrap();
        let one = |k: usize| Coulomb::new(&Matrix3::from_iterator(problem.diagonal_block(k).iter().copied()), 0.5).unwrap();
        let mut contacts: Vec<Coulomb> = (0..problem.contacts()).map(one).collect();
        let mut impulses = vec![[0.0; 3]; problem.contacts()];
        let mut state = vec![0.0; Swept::<3>::size(&bodies)];
        let mut changes = vec![Change::default(); blocks.count()];
        for _ in 0..4 {
            let (contacts, impulses, changes) = (&mut contacts[..], &mut impulses[..], &mut changes[..]);
            bodies.sweep(Sweep { blocks, contacts, impulses, changes }, &mut state);
        }
        assert!(changes.iter().all(|change| change.moved && change.squares > 0.0));
        let squares = changes.iter().map(|change| change.squares);
        impulses.as_flattened().iter().chain(&state).copied().chain(squares).map(f64::to_bits).collect()
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits_and_another_order_of_the_blocks_others() {
        let problem = chain();
        let blocks = coloured(problem.delassus().matrix_free().unwrap());
        assert_eq!(blocks.colours.iter().collect::<Vec<_>>(), [&[0, 2, 4, 6][..], &[1, 3, 5]]);
        let alone = swept(&problem, &blocks, 1);
        for threads in [2, 3, 64] {
            assert!(swept(&problem, &blocks, threads) == alone, "{threads} threads");
        }
        // what the comparison is for: blocks that share a body, swept in another order
        let mut other = blocks.clone();
        other.colours.collect(2, |show| (0..2).for_each(|colour| blocks.colours[1 - colour].iter().for_each(|block| show(colour, *block))));
        assert!(swept(&problem, &other, 1) != alone);
        assert!(swept(&problem, &other, 3) == swept(&problem, &other, 1));
    }

    #[test]
    fn a_sweep_whose_word_to_end_is_given_moves_nothing() {
        use crate::solvers::watch::{Interrupt, watched};
        let problem = chain();
        let (free, interrupt) = (problem.delassus().matrix_free().unwrap(), Interrupt::default());
        let bodies = Bodies::<3>::with_threads(&problem, free, 1).unwrap();
        let one = |k: usize| Coulomb::new(&Matrix3::from_iterator(problem.diagonal_block(k).iter().copied()), 0.5).unwrap();
        let mut contacts: Vec<Coulomb> = (0..problem.contacts()).map(one).collect();
        let (mut impulses, blocks) = (vec![[0.0; 3]; problem.contacts()], coloured(free));
        let (mut state, mut changes) = (vec![0.0; Swept::<3>::size(&bodies)], vec![Change::default(); blocks.count()]);
        interrupt.now();
        let sweep = Sweep { blocks: &blocks, contacts: &mut contacts, impulses: &mut impulses, changes: &mut changes };
        let (_, seen) = watched(&interrupt, || bodies.sweep(sweep, &mut state));
        assert!(seen.interrupted && impulses.as_flattened().iter().all(|r| *r == 0.0));
    }

    #[test]
    fn shares_of_all_threads_are_everything_once() {
        for (threads, count) in [(1, 0), (3, 2), (3, 10), (64, 7)] {
            assert_eq!((0..threads).flat_map(|thread| share(thread, threads, count)).collect::<Vec<_>>(), (0..count).collect::<Vec<_>>());
        }
    }
}
