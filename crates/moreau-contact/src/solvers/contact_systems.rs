//! The linear systems of Newton's method and of interior points, J = B W + A with one block of A and B per contact: eliminated in
//! velocities where bodies are known, or the blocks of W determine them, and they are fewer, until too many digits are lost; else over
//! contacts.

use super::block_elimination::{BlockElimination, Slopes};
use super::velocity_elimination::VelocityElimination;
use crate::operator::{BlockSparse, VelocityFactor};
use crate::problem::ContactProblem;
use nalgebra::DVector;

/// How systems with one W are solved.
#[derive(Debug)]
pub(super) struct ContactSystems {
    velocities: Option<VelocityElimination>,
    contacts: BlockElimination,
    /// The last J, where it is factored in velocities.
    last: Option<(Vec<Slopes>, bool)>,
}

impl ContactSystems {
    /// Of this problem, W by blocks.
    pub(super) fn new(problem: &ContactProblem, w: &BlockSparse) -> Self {
        let rows = w.rows_per_contact();
        let velocities = match problem.delassus().blocks() {
            Some(_) => problem.velocity_factor().map(|factor| VelocityElimination::new(factor, rows)),
            None => VelocityFactor::recover(w).filter(VelocityFactor::pays).map(|factor| VelocityElimination::new(&factor, rows)),
        };
        ContactSystems { velocities, contacts: BlockElimination::default(), last: None }
    }

    /// False where what should be eliminated is singular. A J that is symmetric must be definite.
    pub(super) fn factor(&mut self, w: &BlockSparse, slopes: &[Slopes], is_symmetric: bool) -> bool {
        if self.velocities.as_mut().is_some_and(|velocities| velocities.factor(slopes, is_symmetric)) {
            self.last = Some((slopes.to_vec(), is_symmetric));
            return true;
        }
        self.last = None;
        self.contacts.factor(w, slopes, is_symmetric)
    }

    /// The x with J x = b, of the last J that was factored; none where it is singular for rounding.
    ///
    /// # Panics
    /// If none was, or b has another size.
    pub(super) fn solve(&mut self, w: &BlockSparse, right_side: &DVector<f64>) -> Option<DVector<f64>> {
        if let (Some((slopes, is_symmetric)), Some(velocities)) = (&self.last, &mut self.velocities) {
            if let Some(found) = velocities.solve(w, right_side) {
                return Some(found);
            }
            if !self.contacts.factor(w, slopes, *is_symmetric) {
                return None;
            }
            self.last = None;
        }
        Some(self.contacts.solve(w, right_side))
    }
}
