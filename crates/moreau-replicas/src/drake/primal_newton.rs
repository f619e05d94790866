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
use moreau_contact::augmented_mass::AugmentedMass;
use moreau_contact::contact::{Inertia, Jacobian, Mass};
use moreau_contact::solvers::LineRoot;
use moreau_contact::solvers::watch::is_over;
use moreau_contact::tolerance::solvers::{NEWTON_STEPS, STOP};
use moreau_exact::Result;
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
    mass: &'a Mass,
    jacobian: &'a Jacobian,
    free_velocity: &'a DVector<f64>,
    potential: &'a dyn Potential,
}

/// Minimises from `start` = x₀; d is found over the bodies that contacts join ([`AugmentedMass`]).
///
/// # Errors
/// [`moreau_exact::Error::Solver`] in the name of `solver` if the numbers overflow; [`moreau_exact::Error::Invalid`] if a velocity has the
/// inertia +∞, sizes do not fit or elimination takes more memory than is allowed.
pub fn minimise(
    solver: &str,
    inertia: &Inertia,
    jacobian: &Jacobian,
    free_velocity: &DVector<f64>,
    potential: &dyn Potential,
    start: DVector<f64>,
) -> Result<Minimum> {
    let mut augmented = AugmentedMass::new(inertia, jacobian.contacts())?;
    let step = Step { mass: inertia.mass(), jacobian, free_velocity, potential };
    let scale = step.mass.diagonal().map(|m| 1.0 / m.sqrt());
    let size = |vector: &DVector<f64>| scale.component_mul(vector).norm();
    let mut change = start;
    let mut before = f64::INFINITY;
    let mut iterations = 0;
    loop {
        let velocity = step.velocity(&change);
        let impulse = step.impulse(&velocity);
        let (momentum, received) = (step.mass.times(&change), jacobian.tr_mul(&impulse));
        let gradient = &momentum - &received;
        let terms = size(&momentum).max(size(&received));
        let relative = if terms > 0.0 { size(&gradient) / terms } else { 0.0 };
        // near the minimum only rounding keeps a step from reducing the gradient
        let stalled = relative >= before && before <= NEAR_MINIMUM;
        let converged = relative <= STOP || gradient.amax() == 0.0;
        let direction = if converged || stalled || iterations == NEWTON_STEPS || is_over() {
            None
        } else {
            match augmented.solve_definite(solver, &step.curvatures(&velocity), &-gradient) {
                Ok(direction) => step.line_minimum(&change, &direction).map(|length| direction * length),
                Err(_) if is_over() => None,
                Err(reason) => return Err(reason),
            }
        };
        let Some(direction) = direction else { return Ok(Minimum { change, impulse, iterations, relative }) };
        change += direction;
        before = relative;
        iterations += 1;
    }
}

impl Step<'_> {
    fn velocity(&self, change: &DVector<f64>) -> DVector<f64> {
        self.free_velocity + self.jacobian * change
    }

    /// The velocity of every contact.
    fn contacts<'a>(&self, velocity: &'a DVector<f64>) -> impl Iterator<Item = (usize, &'a [f64])> {
        velocity.as_slice().chunks(self.jacobian.rows_per_contact().max(1)).enumerate()
    }

    fn impulse(&self, velocity: &DVector<f64>) -> DVector<f64> {
        let impulses = self.contacts(velocity).flat_map(|(contact, part)| self.potential.impulse(contact, part).data.as_vec().clone());
        DVector::from_iterator(velocity.len(), impulses)
    }

    /// G_i of every contact.
    fn curvatures(&self, velocity: &DVector<f64>) -> Vec<DMatrix<f64>> {
        self.contacts(velocity).map(|(contact, part)| self.potential.curvature(contact, part)).collect()
    }

    /// The root α of the slope along d: bracketed by doubling, then by Newton's method that falls back on bisection. `None` if d does not
    /// descend.
    fn line_minimum(&self, change: &DVector<f64>, direction: &DVector<f64>) -> Option<f64> {
        let along = self.jacobian * direction;
        let weighted = self.mass.times(direction);
        let (at_start, own_curvature) = (weighted.dot(change), weighted.dot(direction));
        let slope_and_curvature = |length: f64| {
            let velocity = self.velocity(change) + &along * length;
            let mut curvature = own_curvature;
            for (contact, part) in self.contacts(&velocity) {
                let row = along.rows(contact * part.len(), part.len());
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
