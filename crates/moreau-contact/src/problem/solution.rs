//! A proposed solution of a [`ContactProblem`](super::ContactProblem); it becomes one only by its certificate.

use super::ContactKey;
use crate::memory::spare::Spare;
use nalgebra::DVector;

/// Impulses and velocities proposed by a solver.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// r \[N·s\], ordered (n, t₁, t₂) per contact.
    pub impulse: DVector<f64>,
    /// u = W r + u_free \[m/s\].
    pub velocity: DVector<f64>,
    /// β (Stewart–Trinkle) or the edge impulses f (polyhedral associated), d per contact \[N·s\].
    pub beta: Option<DVector<f64>>,
    /// σ, the slip speeds of Stewart–Trinkle, one per contact \[m/s\].
    pub sigma: Option<DVector<f64>>,
    /// The solver's name.
    pub solver: String,
    /// Iterations or pivots used.
    pub iterations: usize,
    /// Which contact each is, where that is known: solvers leave it out, files carry it, so that a start survives a changed list.
    pub keys: Option<Vec<ContactKey>>,
    /// Whether the same command finds it again: false where a time limit ended its solver, absent where nobody says so.
    pub reproducible: Option<bool>,
}

impl Solution {
    /// What a solver proposes: r \[N·s\], u = W r + u_free \[m/s\], and the iterations it took; β, σ, keys and whether it is
    /// reproducible are not given.
    /// ```
    /// use moreau_contact::Solution;
    /// use moreau_contact::nalgebra::dvector;
    ///
    /// let mut answer = Solution::new("by hand", dvector![1.0, -0.5], dvector![0.0, 1.5], 0);
    /// answer.sigma = Some(dvector![1.5]);
    /// assert!(answer.beta.is_none());
    /// ```
    pub fn new(solver: impl Into<String>, impulse: DVector<f64>, velocity: DVector<f64>, iterations: usize) -> Self {
        Solution { impulse, velocity, beta: None, sigma: None, solver: solver.into(), iterations, keys: None, reproducible: None }
    }

    /// Leaves its memory to the answers that follow in this thread, see [`spare`](crate::memory::spare).
    pub fn leave(self) {
        self.impulse.leave();
        self.velocity.leave();
        self.solver.leave();
    }
}
