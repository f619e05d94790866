//! When an iteration may stop: the natural map of every contact is at the rounding floor.

use crate::certificate::natural_map;
use crate::problem::ContactProblem;
use nalgebra::DVector;

/// `‖r_k − P_K(r_k − ρ_k ŷ_k)‖ ≤ relative · max(‖r‖, max_k ρ_k ‖u_free + shift‖_∞)` at every contact k.
pub(super) struct Stopping<'a> {
    problem: &'a ContactProblem,
    rho: Vec<f64>,
    data: f64,
    relative: f64,
}

impl<'a> Stopping<'a> {
    pub(super) fn new(problem: &'a ContactProblem, relative: f64) -> Self {
        let rho = natural_map::scales(problem);
        let velocity = (&problem.free_velocity + &problem.shift).amax();
        let data = velocity * rho.iter().copied().fold(0.0, f64::max);
        Stopping { problem, rho, data, relative }
    }

    /// Whether (r, y = u_free + shift + (W + R) r) is a solution up to the tolerance.
    pub(super) fn holds(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>) -> bool {
        let rows = self.problem.rows_per_contact;
        let bound = self.relative * impulse.norm().max(self.data);
        // an infinite bound would be met by anything
        bound.is_finite()
            && self.rho.iter().enumerate().all(|(k, &rho)| {
                let range = k * rows..(k + 1) * rows;
                let (r, y) = (&impulse.as_slice()[range.clone()], &law_velocity.as_slice()[range]);
                natural_map::natural_map(self.problem.law, self.problem.friction[k], r, y, rho) <= bound
            })
    }
}
