//! What a sweep keeps beside the impulses, an affine function of them, and what the change of one contact does to it.
//!
//! ```text
//!     W stored            y = (W + R) r + q        y_k is read                            y += (W + R) e_k Δr_k
//!     W by bodies         w = D⁻¹ Σ_k Y_k r_k      y_k = q_k + R_k r_k + Σ_b Y_kbᵀ w_b    w_b += D_b⁻¹ Y_kb Δr_k
//! ```
//! Since both are affine, the state at a combination of impulses with weights that sum to one is the same combination of the states.

use super::block_sweep::{Surroundings, Sweep, share};
use super::colours::{Blocks, coloured};
use super::one_contact::OneContact;
use super::threads;
use crate::operator::{BlockRows, MatrixFree, passes};
use crate::problem::{Compliance, ContactProblem, Coordinates};
use crate::tolerance::sweeps::THREADED;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// W as a sweep over contacts of D rows sees it.
pub(super) trait Swept<const D: usize>: Sized {
    /// How many numbers the state is.
    fn size(&self) -> usize;

    /// Overwrites the state with that at these impulses.
    fn set_state(&self, impulse: &[f64], state: &mut [f64]);

    /// y of all contacts, from the state at these impulses.
    fn law_velocity(&self, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]);

    /// y of one contact.
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[f64]) -> [f64; D];

    /// Brings the state up to the change of one contact's impulse.
    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]);

    /// The order of the contacts.
    fn blocks(&self) -> Blocks;

    /// Solves every contact once, and brings the state up to the changes.
    fn sweep<L: OneContact>(&self, sweep: Sweep<L, D>, state: &mut [f64]) {
        sweep.one_after_another(&mut Around { swept: self, state });
    }
}

/// What one contact sees where one thread has the whole state.
struct Around<'a, S> {
    swept: &'a S,
    state: &'a mut [f64],
}

impl<S: Swept<D>, const D: usize> Surroundings<D> for Around<'_, S> {
    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D]) -> [f64; D] {
        self.swept.at(contact, impulse, self.state)
    }

    #[inline(always)]
    fn push(&mut self, contact: usize, change: &[f64; D]) {
        self.swept.push(contact, change, self.state);
    }
}

/// A W that is stored: the state is y.
pub(super) struct Stored<'a>(pub(super) &'a ContactProblem);

impl<const D: usize> Swept<D> for Stored<'_> {
    fn size(&self) -> usize {
        self.0.rows()
    }

    fn set_state(&self, impulse: &[f64], state: &mut [f64]) {
        self.0.write_law_velocity(impulse, state);
    }

    fn law_velocity(&self, _impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
        law_velocity.copy_from_slice(state);
    }

    #[inline(always)]
    fn at(&self, contact: usize, _impulse: &[f64; D], state: &[f64]) -> [f64; D] {
        state.as_chunks::<D>().0[contact]
    }

    #[inline(always)]
    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]) {
        self.0.add_contact(contact, change, state);
    }

    fn blocks(&self) -> Blocks {
        Blocks::one(self.0.contacts())
    }
}

/// What the law adds to the velocity of the bodies: q and R.
struct Given<'a> {
    velocity: Vec<f64>,
    softness: Option<&'a [f64]>,
}

impl<'a> Given<'a> {
    fn of(problem: &'a ContactProblem) -> Self {
        let velocity = problem.free_velocity().iter().zip(problem.shift()).map(|(free, shift)| free + shift).collect();
        let softness = match problem.compliance() {
            Some(Compliance { coordinates: Coordinates::Contact, diagonal }) => Some(diagonal.as_slice()),
            _ => None,
        };
        Given { velocity, softness }
    }

    #[inline(always)]
    fn at<const D: usize>(&self, contact: usize, impulse: &[f64; D]) -> [f64; D] {
        let mut y = self.velocity.as_chunks::<D>().0[contact];
        if let Some(softness) = self.softness {
            (0..D).for_each(|row| y[row] += softness[contact * D + row] * impulse[row]);
        }
        y
    }
}

/// W by bodies of any numbers of velocities.
pub(super) struct Free<'a> {
    free: &'a MatrixFree,
    given: Given<'a>,
}

impl<'a> Free<'a> {
    pub(super) fn new(problem: &'a ContactProblem, free: &'a MatrixFree) -> Self {
        Free { free, given: Given::of(problem) }
    }
}

impl<const D: usize> Swept<D> for Free<'_> {
    fn size(&self) -> usize {
        self.free.inverse().len()
    }

    fn set_state(&self, impulse: &[f64], state: &mut [f64]) {
        passes::note();
        self.free.write_body_velocity(impulse, state);
    }

    fn law_velocity(&self, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
        each_contact::<D>(self, impulse, state, law_velocity);
    }

    fn at(&self, contact: usize, impulse: &[f64; D], state: &[f64]) -> [f64; D] {
        let mut y = self.given.at(contact, impulse);
        self.free.add_velocity(contact, state, &mut y);
        y
    }

    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]) {
        self.free.push(contact, change, state);
    }

    fn blocks(&self) -> Blocks {
        coloured(self.free)
    }
}

/// Two numbers that the processor multiplies and adds side by side.
type Pair = [f64; 2];

/// sum + a b of each.
#[inline(always)]
fn add_product(sum: &mut Pair, a: Pair, b: Pair) {
    *sum = [sum[0] + a[0] * b[0], sum[1] + a[1] * b[1]];
}

/// W by bodies of 2 P velocities each.
pub(super) struct Bodies<'a, const P: usize> {
    free: &'a MatrixFree,
    given: Given<'a>,
    /// Rows of Y, D for each block.
    left: &'a [[Pair; P]],
    right: &'a [[Pair; P]],
    inverse: &'a [[Pair; P]],
    /// The state while several threads have it; empty where one has it.
    shared: Vec<[SharedPair; P]>,
    threads: usize,
}

/// The bits of two numbers that threads share.
type SharedPair = [AtomicU64; 2];

impl<'a, const P: usize> Bodies<'a, P> {
    /// W, if its bodies have 2 P velocities each.
    pub(super) fn new(problem: &'a ContactProblem, free: &'a MatrixFree) -> Option<Self> {
        let threads = if free.contacts() < THREADED { 1 } else { threads::limit().get() };
        Bodies::with_threads(problem, free, threads)
    }

    /// [`Bodies::new`] for so many threads, however small the problem is.
    pub(super) fn with_threads(problem: &'a ContactProblem, free: &'a MatrixFree, threads: usize) -> Option<Self> {
        let [left, right, inverse] =
            [free.left(), free.right(), free.inverse()].map(|numbers| numbers.as_chunks::<2>().0.as_chunks::<P>().0);
        let nothing = |_| std::array::from_fn(|_| std::array::from_fn(|_| AtomicU64::new(0)));
        (free.jacobian().equal_velocities() == Some(2 * P)).then(|| {
            let shared = (0..if threads > 1 { inverse.len() } else { 0 }).map(nothing).collect();
            Bodies { free, given: Given::of(problem), left, right, inverse, shared, threads }
        })
    }

    /// y of one contact, from the velocities of its bodies.
    #[inline(always)]
    fn velocity<const D: usize>(&self, contact: usize, impulse: &[f64; D], of: impl Fn(usize) -> [Pair; P]) -> [f64; D] {
        let (mut y, mut sums) = (self.given.at(contact, impulse), [[0.0; 2]; D]);
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.left, contact) {
            let w = of(body);
            for row in 0..D {
                // a sum of its own for each body: the processor forms them side by side
                let mut own = [block[row][0][0] * w[0][0], block[row][0][1] * w[0][1]];
                for pair in 1..P {
                    add_product(&mut own, block[row][pair], w[pair]);
                }
                sums[row] = [sums[row][0] + own[0], sums[row][1] + own[1]];
            }
        }
        for row in 0..D {
            y[row] += sums[row][0] + sums[row][1];
        }
        y
    }

    /// What the change of one contact's impulse adds to the velocities of its bodies.
    #[inline(always)]
    fn pushed<const D: usize>(&self, contact: usize, change: &[f64; D], mut add: impl FnMut(usize, [Pair; P])) {
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.right, contact) {
            let mut pushed = [[0.0; 2]; P];
            for row in 0..D {
                for pair in 0..P {
                    add_product(&mut pushed[pair], block[row][pair], [change[row]; 2]);
                }
            }
            let inverse = &self.inverse[body];
            (0..P).for_each(|pair| pushed[pair] = [inverse[pair][0] * pushed[pair][0], inverse[pair][1] * pushed[pair][1]]);
            add(body, pushed);
        }
    }
}

/// What one contact sees where several threads have the state: no two of them have a body in common.
struct Shared<'a, 'b, const P: usize>(&'a Bodies<'b, P>);

impl<const P: usize> Clone for Shared<'_, '_, P> {
    fn clone(&self) -> Self {
        Shared(self.0)
    }
}

impl<const D: usize, const P: usize> Surroundings<D> for Shared<'_, '_, P> {
    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D]) -> [f64; D] {
        self.0.velocity(contact, impulse, |body| load(&self.0.shared[body]))
    }

    #[inline(always)]
    fn push(&mut self, contact: usize, change: &[f64; D]) {
        self.0.pushed(contact, change, |body, added| {
            let w = load(&self.0.shared[body]);
            store(&self.0.shared[body], &std::array::from_fn(|pair| [w[pair][0] + added[pair][0], w[pair][1] + added[pair][1]]));
        });
    }
}

#[inline(always)]
fn load<const P: usize>(shared: &[SharedPair; P]) -> [Pair; P] {
    std::array::from_fn(|pair| std::array::from_fn(|one| f64::from_bits(shared[pair][one].load(Relaxed))))
}

#[inline(always)]
fn store<const P: usize>(shared: &[SharedPair; P], velocity: &[Pair; P]) {
    (0..P).for_each(|pair| (0..2).for_each(|one| shared[pair][one].store(velocity[pair][one].to_bits(), Relaxed)));
}

/// The blocks of a contact, each with its body.
#[inline(always)]
fn touched<'a, const D: usize, const P: usize>(
    rows: &'a BlockRows,
    blocks: &'a [[Pair; P]],
    contact: usize,
) -> impl Iterator<Item = (&'a [[Pair; P]; D], usize)> {
    let range = rows.blocks(contact);
    let blocks = blocks[range.start * D..range.end * D].as_chunks::<D>().0;
    blocks.iter().zip(rows.bodies(contact).iter().map(|body| *body as usize))
}

impl<const D: usize, const P: usize> Swept<D> for Bodies<'_, P> {
    fn size(&self) -> usize {
        self.inverse.len() * 2 * P
    }

    fn set_state(&self, impulse: &[f64], state: &mut [f64]) {
        passes::note();
        state.fill(0.0);
        let contacts = impulse.as_chunks::<D>().0.iter().enumerate();
        contacts.filter(|(_, r)| r.iter().any(|r| *r != 0.0)).for_each(|(k, r)| self.push(k, r, state));
    }

    fn law_velocity(&self, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
        each_contact::<D>(self, impulse, state, law_velocity);
    }

    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[f64]) -> [f64; D] {
        let bodies = state.as_chunks::<2>().0.as_chunks::<P>().0;
        self.velocity(contact, impulse, |body| bodies[body])
    }

    #[inline(always)]
    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]) {
        let bodies = state.as_chunks_mut::<2>().0.as_chunks_mut::<P>().0;
        self.pushed(contact, change, |body, added| {
            let w = &mut bodies[body];
            (0..P).for_each(|pair| w[pair] = [w[pair][0] + added[pair][0], w[pair][1] + added[pair][1]]);
        });
    }

    fn blocks(&self) -> Blocks {
        coloured(self.free)
    }

    fn sweep<L: OneContact>(&self, sweep: Sweep<L, D>, state: &mut [f64]) {
        let threads = self.threads.min(sweep.blocks.widest());
        if threads < 2 {
            return sweep.one_after_another(&mut Around { swept: self, state });
        }
        let (mut rest, mut shares) = (state.as_chunks_mut::<2>().0.as_chunks_mut::<P>().0, Vec::with_capacity(threads));
        for range in (0..threads).map(|thread| share(thread, threads, self.shared.len())) {
            let (own, others) = rest.split_at_mut(range.len());
            shares.push((&self.shared[range], own));
            rest = others;
        }
        sweep.side_by_side(
            shares,
            Shared(self),
            |(shared, own)| shared.iter().zip(own.iter()).for_each(|(shared, velocity)| store(shared, velocity)),
            |(shared, own)| shared.iter().zip(own.iter_mut()).for_each(|(shared, velocity)| *velocity = load(shared)),
        );
    }
}

/// y of every contact, one after the other.
fn each_contact<const D: usize>(swept: &impl Swept<D>, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
    let contacts = law_velocity.as_chunks_mut::<D>().0.iter_mut().zip(impulse.as_chunks::<D>().0).enumerate();
    contacts.for_each(|(k, (y, r))| *y = swept.at(k, r, state));
}
