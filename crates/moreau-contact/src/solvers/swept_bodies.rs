//! W by bodies as a sweep sees it: the state are the velocities w of the bodies ([`swept`](super::swept)).

use super::block_sweep::Sweep;
use super::colours::{Blocks, coloured};
use super::crew::{Crew, Shareable};
use super::one_contact::OneContact;
use super::swept::Swept;
use crate::operator::slot::{Slot, load, slots};
use crate::operator::{BlockRows, MatrixFree, passes};
use crate::problem::ContactProblem;

/// What the law adds to the velocity of the bodies: q and R.
struct Given<'a> {
    velocity: Vec<f64>,
    softness: Option<&'a [f64]>,
}

impl<'a> Given<'a> {
    fn of(problem: &'a ContactProblem) -> Self {
        let velocity = problem.free_velocity().iter().zip(problem.shift()).map(|(free, shift)| free + shift).collect();
        Given { velocity, softness: problem.row_compliances() }
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

    fn law_velocity(&self, impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]) {
        each_contact::<D>(self, impulse, state, law_velocity);
    }

    fn blocks(&self) -> Blocks {
        coloured(self.free)
    }

    fn sweep<L: OneContact>(&self, crew: &Crew, sweep: Sweep<L, D>, state: &mut [f64]) {
        crew.sweep(self, sweep, state);
    }
}

impl<const D: usize> Shareable<D> for Free<'_> {
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[impl Slot]) -> [f64; D] {
        let mut y = self.given.at(contact, impulse);
        self.free.add_velocity(contact, state, &mut y);
        y
    }

    fn push(&self, contact: usize, change: &[f64; D], state: &[impl Slot]) {
        self.free.push(contact, change, state);
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
}

impl<'a, const P: usize> Bodies<'a, P> {
    /// W, if its bodies have 2 P velocities each.
    pub(super) fn new(problem: &'a ContactProblem, free: &'a MatrixFree) -> Option<Self> {
        let [left, right, inverse] =
            [free.left(), free.right(), free.inverse()].map(|numbers| numbers.as_chunks::<2>().0.as_chunks::<P>().0);
        let is_one = free.jacobian().equal_velocities() == Some(2 * P);
        is_one.then(|| Bodies { free, given: Given::of(problem), left, right, inverse })
    }
}

/// The velocities of a body.
#[inline(always)]
fn of_body<E, const P: usize>(state: &[E], body: usize) -> &[[E; 2]; P] {
    &state.as_chunks::<2>().0.as_chunks::<P>().0[body]
}

/// The numbers in their slots.
#[inline(always)]
fn numbers<const P: usize>(slots: &[[impl Slot; 2]; P]) -> [Pair; P] {
    std::array::from_fn(|pair| load(&slots[pair]))
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
        let (contacts, state) = (impulse.as_chunks::<D>().0.iter().enumerate(), slots(state));
        contacts.filter(|(_, r)| r.iter().any(|r| *r != 0.0)).for_each(|(k, r)| self.push(k, r, state));
    }

    fn law_velocity(&self, impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]) {
        each_contact::<D>(self, impulse, state, law_velocity);
    }

    fn blocks(&self) -> Blocks {
        coloured(self.free)
    }

    fn sweep<L: OneContact>(&self, crew: &Crew, sweep: Sweep<L, D>, state: &mut [f64]) {
        crew.sweep(self, sweep, state);
    }
}

impl<const D: usize, const P: usize> Shareable<D> for Bodies<'_, P> {
    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[impl Slot]) -> [f64; D] {
        let (mut y, mut sums) = (self.given.at(contact, impulse), [[0.0; 2]; D]);
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.left, contact) {
            let w = numbers(of_body::<_, P>(state, body));
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

    #[inline(always)]
    fn push(&self, contact: usize, change: &[f64; D], state: &[impl Slot]) {
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.right, contact) {
            let mut pushed = [[0.0; 2]; P];
            for row in 0..D {
                for pair in 0..P {
                    add_product(&mut pushed[pair], block[row][pair], [change[row]; 2]);
                }
            }
            let (inverse, slots) = (&self.inverse[body], of_body::<_, P>(state, body));
            let w = numbers(slots);
            (0..P).for_each(|pair| pushed[pair] = [inverse[pair][0] * pushed[pair][0], inverse[pair][1] * pushed[pair][1]]);
            (0..P).for_each(|pair| pushed[pair] = [w[pair][0] + pushed[pair][0], w[pair][1] + pushed[pair][1]]);
            // nothing is read any more, so that the processor may write side by side
            (0..P).for_each(|pair| (0..2).for_each(|one| slots[pair][one].set(pushed[pair][one])));
        }
    }
}

/// y of every contact, one after the other.
fn each_contact<const D: usize>(swept: &impl Shareable<D>, impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]) {
    let (contacts, state) = (law_velocity.as_chunks_mut::<D>().0.iter_mut().zip(impulse.as_chunks::<D>().0).enumerate(), slots(state));
    contacts.for_each(|(k, (y, r))| *y = swept.at(k, r, state));
}
