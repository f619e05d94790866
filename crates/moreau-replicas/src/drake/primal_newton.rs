//! Newton's method on the velocities of a convex step
//!
//! ```text
//!     min  ½ ‖x‖²_M + Σ_i ℓ_i(u_i) ,      u = u_free + H x ,     x = v⁺ − v_free ,
//!     g = M x − Hᵀ r(u) ,   r_i = −∇ℓ_i ,     (M + Hᵀ G H) d = −g ,   G_i = ∇²ℓ_i ,     x ← x + α d .
//! ```
//! α is the minimiser along d, the root of the increasing function α ↦ dᵀM(x + αd) − (Hd)ᵀr(u + αHd); the value of ℓ is never needed.
//! The objective is strongly convex in the kinetic norm, so that ‖x − x*‖_M ≤ ‖g‖_{M⁻¹} however curved ℓ is. With ∇²ℓ only piecewise
//! continuous every step still descends, and the last ones converge quadratically.
//!
//! # Source
//! Castro, Permenter and Han, *An unconstrained convex formulation of compliant contact* (2022), §IV.

use crate::tolerance::solvers::{LINE_STEPS, NEAR_MINIMUM};
use moreau_contact::problem::Dynamics;
use moreau_contact::solvers::LineRoot;
use moreau_contact::solvers::watch::is_over;
use moreau_contact::tolerance::solvers::{NEWTON_STEPS, STOP};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// The convex potential of every contact's velocity, by its derivatives.
pub trait Potential {
    /// r_i = −∇ℓ_i(u_i) \[N·s\] of a contact with velocity u_i \[m/s\], as many entries as the contact has rows.
    fn impulse(&self, contact: usize, velocity: &[f64]) -> DVector<f64>;
    /// An element of ∇²ℓ_i(u_i) \[kg\], symmetric positive semidefinite.
    fn curvature(&self, contact: usize, velocity: &[f64]) -> DMatrix<f64>;
}

/// Where Newton's method ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// x = v⁺ − v_free.
    pub change: DVector<f64>,
    /// r(u) \[N·s\].
    pub impulse: DVector<f64>,
    /// Newton steps.
    pub iterations: usize,
    /// ‖D g‖ over the larger of ‖D M x‖ and ‖D Hᵀr‖, D = diag(M)^(−½): Drake's measure of a minimum.
    pub relative: f64,
}

/// The step's data and the potential.
struct Step<'a> {
    dynamics: &'a Dynamics,
    free_velocity: &'a DVector<f64>,
    rows: usize,
    potential: &'a dyn Potential,
}

/// Minimises from `start` = x₀ with contacts of `rows` rows each.
///
/// # Errors
/// [`Error::Solver`] in the name of `solver` if the effective mass is not positive definite or the numbers overflow.
pub fn minimise(
    solver: &str,
    dynamics: &Dynamics,
    free_velocity: &DVector<f64>,
    rows: usize,
    potential: &dyn Potential,
    start: DVector<f64>,
) -> Result<Minimum> {
    let step = Step { dynamics, free_velocity, rows, potential };
    let scale = dynamics.mass.diagonal().map(|m| 1.0 / m.sqrt());
    let size = |vector: &DVector<f64>| scale.component_mul(vector).norm();
    let mut change = start;
    let mut before = f64::INFINITY;
    let mut iterations = 0;
    loop {
        let velocity = step.velocity(&change);
        let impulse = step.impulse(&velocity);
        let (momentum, received) = (&dynamics.mass * &change, dynamics.jacobian.tr_mul(&impulse));
        let gradient = &momentum - &received;
        let terms = size(&momentum).max(size(&received));
        let relative = if terms > 0.0 { size(&gradient) / terms } else { 0.0 };
        // near the minimum only rounding keeps a step from reducing the gradient
        let stalled = relative >= before && before <= NEAR_MINIMUM;
        let converged = relative <= STOP || gradient.amax() == 0.0;
        let direction = if converged || stalled || iterations == NEWTON_STEPS || is_over() {
            None
        } else {
            let factor = step.hessian(&velocity).cholesky();
            let factor = factor.ok_or_else(|| Error::breakdown(solver, "met a Hessian that is not positive definite"))?;
            let direction = factor.solve(&-gradient);
            step.line_minimum(&change, &direction).map(|length| direction * length)
        };
        let Some(direction) = direction else { return Ok(Minimum { change, impulse, iterations, relative }) };
        change += direction;
        before = relative;
        iterations += 1;
    }
}

impl Step<'_> {
    fn velocity(&self, change: &DVector<f64>) -> DVector<f64> {
        self.free_velocity + &self.dynamics.jacobian * change
    }

    fn impulse(&self, velocity: &DVector<f64>) -> DVector<f64> {
        let parts = velocity.as_slice().chunks(self.rows).enumerate();
        DVector::from_iterator(
            velocity.len(),
            parts.flat_map(|(contact, part)| self.potential.impulse(contact, part).data.as_vec().clone()),
        )
    }

    /// M + Hᵀ G H.
    fn hessian(&self, velocity: &DVector<f64>) -> DMatrix<f64> {
        let mut hessian = self.dynamics.mass.clone();
        for (contact, part) in velocity.as_slice().chunks(self.rows).enumerate() {
            let rows = self.dynamics.jacobian.rows(contact * self.rows, self.rows);
            hessian += rows.tr_mul(&(self.potential.curvature(contact, part) * rows));
        }
        (&hessian + hessian.transpose()) * 0.5
    }

    /// The root α of the slope along d: bracketed by doubling, then by Newton's method that falls back on bisection. `None` if d does not
    /// descend.
    fn line_minimum(&self, change: &DVector<f64>, direction: &DVector<f64>) -> Option<f64> {
        let along = &self.dynamics.jacobian * direction;
        let weighted = &self.dynamics.mass * direction;
        let (at_start, own_curvature) = (weighted.dot(change), weighted.dot(direction));
        let slope_and_curvature = |length: f64| {
            let velocity = self.velocity(change) + &along * length;
            let mut curvature = own_curvature;
            for (contact, part) in velocity.as_slice().chunks(self.rows).enumerate() {
                let row = along.rows(contact * self.rows, self.rows);
                curvature += row.dot(&(self.potential.curvature(contact, part) * row));
            }
            (at_start + length * own_curvature - along.dot(&self.impulse(&velocity)), curvature)
        };
        let (slope, _) = slope_and_curvature(0.0);
        // also where a number is not finite
        if !(slope < 0.0 && own_curvature > 0.0) {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        while slope_and_curvature(high).0 < 0.0 {
            (low, high) = (high, 2.0 * high);
        }
        let start = if low == 0.0 { 1.0 } else { low };
        let root = LineRoot { low, high, start, limit: STOP * slope.abs(), evaluations: LINE_STEPS };
        Some(root.find(slope_and_curvature))
    }
}
