//! The linear systems of Newton's method and of interior points, J = B W + A with one block of A and B per contact: eliminated in
//! velocities where bodies are known, or the blocks of W determine them, and they are fewer, until too many digits are lost; else over
//! contacts.

use super::block_elimination::{BlockElimination, Slopes};
use super::velocity_elimination::VelocityElimination;
use crate::operator::{BlockSparse, VelocityFactor};
use crate::problem::ContactProblem;
use nalgebra::DVector;

/// How systems with one W are solved; the memory serves for another W, too.
#[derive(Debug, Default)]
pub(super) struct ContactSystems {
    velocities: VelocityElimination,
    /// Whether elimination in velocities is for this W.
    has_velocities: bool,
    contacts: BlockElimination,
    /// Whether the last J is factored in velocities, and whether it is symmetric.
    is_in_velocities: bool,
    is_symmetric: bool,
}

impl ContactSystems {
    /// Of this problem, W by blocks.
    pub(super) fn new(problem: &ContactProblem, w: &BlockSparse) -> Self {
        let mut systems = ContactSystems::default();
        systems.prepare(problem, w);
        systems
    }

    /// Those of another problem in the same memory.
    pub(super) fn prepare(&mut self, problem: &ContactProblem, w: &BlockSparse) {
        self.has_velocities = match problem.delassus().blocks() {
            Some(_) => problem.velocity_factor().map(|factor| self.velocities.prepare(factor)),
            None => VelocityFactor::recover(w).filter(VelocityFactor::pays).map(|factor| self.velocities.prepare(&factor)),
        }
        .is_some();
        self.contacts.forget();
        self.is_in_velocities = false;
    }

    /// False where what should be eliminated is singular. A J that is symmetric must be definite.
    pub(super) fn factor(&mut self, w: &BlockSparse, slopes: &[Slopes], is_symmetric: bool) -> bool {
        self.is_symmetric = is_symmetric;
        self.is_in_velocities = self.has_velocities && self.velocities.factor(slopes, is_symmetric);
        self.is_in_velocities || self.contacts.factor(w, slopes, is_symmetric)
    }

    /// Whether the last J should have been eliminated in velocities, and too many digits were lost there: over contacts it costs several
    /// times as much.
    pub(super) fn has_lost_digits(&self) -> bool {
        self.has_velocities && !self.is_in_velocities
    }

    /// The x with J x = b, of the last J that was factored; none where it is singular for rounding.
    ///
    /// # Panics
    /// If none was, or b has another size.
    pub(super) fn solve(&mut self, w: &BlockSparse, right_side: &DVector<f64>) -> Option<DVector<f64>> {
        if self.is_in_velocities {
            if let Some(found) = self.velocities.solve(right_side) {
                return Some(found);
            }
            let slopes: Vec<Slopes> = self.velocities.slopes().collect();
            if !self.contacts.factor(w, &slopes, self.is_symmetric) {
                return None;
            }
            self.is_in_velocities = false;
        }
        Some(self.contacts.solve(w, right_side))
    }

    /// W x of the x that was solved for last.
    pub(super) fn moved(&self, problem: &ContactProblem, x: &DVector<f64>) -> DVector<f64> {
        if self.is_in_velocities { self.velocities.moved().clone() } else { problem.apply(x) }
    }
}
