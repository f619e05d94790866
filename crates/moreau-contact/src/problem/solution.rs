//! A proposed solution of a [`ContactProblem`](super::ContactProblem); it becomes one only by its certificate.

use nalgebra::DVector;

/// Impulses and velocities proposed by a solver.
#[derive(Clone, Debug, PartialEq)]
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
}
