//! What a sweep keeps beside the impulses, an affine function of them, and what the change of one contact does to it.
//!
//! ```text
//!     W stored            y = (W + R) r + q        y_k is read                            y += (W + R) e_k Δr_k
//!     W by bodies         w = D⁻¹ Σ_k Y_k r_k      y_k = q_k + R_k r_k + Σ_b Y_kbᵀ w_b    w_b += D_b⁻¹ Y_kb Δr_k
//! ```
//! Since both are affine, the state at a combination of impulses with weights that sum to one is the same combination of the states.
//!
//! Threads share a sweep where contacts touch few others: by bodies ([`Bodies`](super::swept_bodies::Bodies),
//! [`Free`](super::swept_bodies::Free)) and by blocks of the plane ([`Joined`]). Where W is a square matrix every contact
//! moves every other.

use super::block_sweep::{Surroundings, Sweep};
use super::colours::{Blocks, coloured};
use super::crew::{Crew, Shareable};
use super::one_contact::OneContact;
use crate::operator::BlockSparse;
use crate::operator::slot::{Slot, add, load};
use crate::problem::ContactProblem;
use crate::tolerance::sweeps::THREADED;

/// W as a sweep over contacts of D rows sees it.
pub(super) trait Swept<const D: usize> {
    /// How many numbers the state is.
    fn size(&self) -> usize;

    /// Overwrites the state with that at these impulses.
    fn set_state(&self, impulse: &[f64], state: &mut [f64]);

    /// y of all contacts, from the state at these impulses, which stays as it is.
    fn law_velocity(&self, impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]);

    /// The order of the contacts.
    fn blocks(&self) -> Blocks;

    /// Solves every contact once, and brings the state up to the changes.
    fn sweep<L: OneContact>(&self, crew: &Crew, sweep: Sweep<L, D>, state: &mut [f64]);
}

/// A W that is stored and swept by one thread, as its contacts are listed: a square matrix, where every contact moves every other, or
/// blocks of fewer or larger contacts than threads pay for. The state is y.
pub(super) struct Stored<'a>(pub(super) &'a ContactProblem);

impl<const D: usize> Swept<D> for Stored<'_> {
    fn size(&self) -> usize {
        self.0.rows()
    }

    fn set_state(&self, impulse: &[f64], state: &mut [f64]) {
        self.0.write_law_velocity(impulse, state);
    }

    fn law_velocity(&self, _impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]) {
        law_velocity.copy_from_slice(state);
    }

    fn blocks(&self) -> Blocks {
        Blocks::one(self.0.contacts())
    }

    fn sweep<L: OneContact>(&self, _crew: &Crew, sweep: Sweep<L, D>, state: &mut [f64]) {
        sweep.one_after_another(&mut Alone { problem: self.0, state });
    }
}

/// What one contact sees of a stored W.
struct Alone<'a> {
    problem: &'a ContactProblem,
    state: &'a mut [f64],
}

impl<const D: usize> Surroundings<D> for Alone<'_> {
    #[inline(always)]
    fn at(&self, contact: usize, _impulse: &[f64; D]) -> [f64; D] {
        self.state.as_chunks::<D>().0[contact]
    }

    #[inline(always)]
    fn push(&mut self, contact: usize, change: &[f64; D]) {
        self.problem.add_contact(contact, change, self.state);
    }
}

/// Rows of a contact in space.
const SPATIAL: usize = 3;

/// A W of many contacts that is stored by blocks: the state is y, of which a contact moves those that W joins with it.
pub(super) struct Joined<'a> {
    problem: &'a ContactProblem,
    blocks: &'a BlockSparse,
}

impl<'a> Joined<'a> {
    /// W, if it is stored by the blocks of so many contacts that threads pay: not in space, where one thread already takes what the memory
    /// gives.
    pub(super) fn new(problem: &'a ContactProblem) -> Option<Self> {
        Joined::of(problem).filter(|_| problem.contacts() >= THREADED && problem.rows_per_contact() < SPATIAL)
    }

    /// [`Joined::new`], however few contacts there are.
    pub(super) fn of(problem: &'a ContactProblem) -> Option<Self> {
        Some(Joined { problem, blocks: problem.delassus().stored_blocks()? })
    }
}

impl<const D: usize> Swept<D> for Joined<'_> {
    fn size(&self) -> usize {
        self.problem.rows()
    }

    fn set_state(&self, impulse: &[f64], state: &mut [f64]) {
        self.problem.write_law_velocity(impulse, state);
    }

    fn law_velocity(&self, _impulse: &[f64], state: &mut [f64], law_velocity: &mut [f64]) {
        law_velocity.copy_from_slice(state);
    }

    fn blocks(&self) -> Blocks {
        coloured(self.blocks)
    }

    fn sweep<L: OneContact>(&self, crew: &Crew, sweep: Sweep<L, D>, state: &mut [f64]) {
        crew.sweep(self, sweep, state);
    }
}

impl<const D: usize> Shareable<D> for Joined<'_> {
    #[inline(always)]
    fn at(&self, contact: usize, _impulse: &[f64; D], state: &[impl Slot]) -> [f64; D] {
        load(&state.as_chunks::<D>().0[contact])
    }

    #[inline(always)]
    fn push(&self, contact: usize, change: &[f64; D], state: &[impl Slot]) {
        self.blocks.push_contact(contact, change, state);
        if let Some(softness) = self.problem.row_compliances() {
            let softness = &softness.as_chunks::<D>().0[contact];
            add(&state.as_chunks::<D>().0[contact], &std::array::from_fn(|row| softness[row] * change[row]));
        }
    }
}
