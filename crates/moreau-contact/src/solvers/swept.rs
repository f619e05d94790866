//! What a sweep keeps beside the impulses, an affine function of them, and what the change of one contact does to it.
//!
//! ```text
//!     W stored            y = (W + R) r + q        y_k is read                            y += (W + R) e_k Δr_k
//!     W by bodies         w = D⁻¹ Σ_k Y_k r_k      y_k = q_k + R_k r_k + Σ_b Y_kbᵀ w_b    w_b += D_b⁻¹ Y_kb Δr_k
//! ```
//! Since both are affine, the state at a combination of impulses with weights that sum to one is the same combination of the states.

use crate::operator::{BlockRows, MatrixFree};
use crate::problem::{Compliance, ContactProblem, Coordinates};
use std::ops::Range;

/// W as a sweep over contacts of D rows sees it.
pub(super) trait Swept<const D: usize> {
    /// The state at these impulses.
    fn state(&self, impulse: &[f64]) -> Vec<f64>;

    /// y of all contacts, from the state at these impulses.
    fn law_velocity(&self, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]);

    /// y of one contact.
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[f64]) -> [f64; D];

    /// Brings the state up to the change of one contact's impulse.
    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]);

    /// The order of the contacts, as ranges.
    fn order(&self) -> Vec<Range<usize>>;
}

/// A W that is stored: the state is y.
pub(super) struct Stored<'a>(pub(super) &'a ContactProblem);

impl<const D: usize> Swept<D> for Stored<'_> {
    fn state(&self, impulse: &[f64]) -> Vec<f64> {
        self.0.law_velocity(&nalgebra::DVector::from_column_slice(impulse)).as_slice().to_vec()
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

    fn order(&self) -> Vec<Range<usize>> {
        std::iter::once(0..self.0.contacts()).collect()
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
    fn state(&self, impulse: &[f64]) -> Vec<f64> {
        self.free.body_velocity(impulse)
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

    fn order(&self) -> Vec<Range<usize>> {
        super::colours::coloured(self.free).into_iter().flatten().collect()
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
        (free.jacobian().equal_velocities() == Some(2 * P)).then(|| Bodies { free, given: Given::of(problem), left, right, inverse })
    }
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
    fn state(&self, impulse: &[f64]) -> Vec<f64> {
        let mut state = vec![0.0; self.inverse.len() * 2 * P];
        let contacts = impulse.as_chunks::<D>().0.iter().enumerate();
        contacts.filter(|(_, r)| r.iter().any(|r| *r != 0.0)).for_each(|(k, r)| self.push(k, r, &mut state));
        state
    }

    fn law_velocity(&self, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
        each_contact::<D>(self, impulse, state, law_velocity);
    }

    #[inline(always)]
    fn at(&self, contact: usize, impulse: &[f64; D], state: &[f64]) -> [f64; D] {
        let (mut y, bodies) = (self.given.at(contact, impulse), state.as_chunks::<2>().0.as_chunks::<P>().0);
        let mut sums = [[0.0; 2]; D];
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.left, contact) {
            let w = bodies[body];
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
    fn push(&self, contact: usize, change: &[f64; D], state: &mut [f64]) {
        let bodies = state.as_chunks_mut::<2>().0.as_chunks_mut::<P>().0;
        for (block, body) in touched::<D, P>(self.free.jacobian(), self.right, contact) {
            let mut pushed = [[0.0; 2]; P];
            for row in 0..D {
                for pair in 0..P {
                    add_product(&mut pushed[pair], block[row][pair], [change[row]; 2]);
                }
            }
            let (mut w, inverse) = (bodies[body], &self.inverse[body]);
            for pair in 0..P {
                add_product(&mut w[pair], inverse[pair], pushed[pair]);
            }
            bodies[body] = w;
        }
    }

    fn order(&self) -> Vec<Range<usize>> {
        super::colours::coloured(self.free).into_iter().flatten().collect()
    }
}

/// y of every contact, one after the other.
fn each_contact<const D: usize>(swept: &impl Swept<D>, impulse: &[f64], state: &[f64], law_velocity: &mut [f64]) {
    let contacts = law_velocity.as_chunks_mut::<D>().0.iter_mut().zip(impulse.as_chunks::<D>().0).enumerate();
    contacts.for_each(|(k, (y, r))| *y = swept.at(k, r, state));
}
