//! The balance of a scheme whose step is v⁺ = v_free + M̂⁻¹Hᵀr, r from a contact law.
//!
//! ```text
//!     T̂(v⁺) = T̂(v_free) + r·u⁺ − ½ rᵀŴ r ,         r·u⁺ ≤ −r·(shift + R r) + w ,
//!     T̂(v⁺) ≤ T̂(v_free) − r·shift − rᵀR r − ½ rᵀŴ r + w .
//! ```
//! w is the residual's work ([`law`](super)), zero at a solution. The shift is the scheme's declared one, computed here.

use crate::energy_balance::exchange::Exchange;
use crate::energy_balance::law::Work;
use crate::energy_balance::position::Position;
use crate::energy_balance::shift::Shift;
use crate::energy_balance::{Taken, law};
use crate::tolerance::energy_balance as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// What is declared of a scheme through impulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WaistLaw {
    /// What the law adds to u.
    pub shift: Shift,
    /// How the positions move.
    pub position: Position,
    /// Whether velocity-dependent forces are those at the start of the step instead of their mean over it.
    pub explicit: bool,
    /// Whether linear forces are those at q_θ and v_θ.
    pub implicit: bool,
    /// Hunt and Crossley's law, which poses no contact problem.
    pub regularised: Option<Regularised>,
}

/// r_n = h k (δ − h z)₊ (1 − d z)₊, δ = −φ, and friction that opposes u_t, so that r·u ≤ r_n z for Drake's three laws: z = u_n, or the
/// smaller argument of Similar.
///
/// With d = 0, z = (δ − r_n/(h k))/h and r·u ≤ −r_n φ/h − r_n²/(h²k). With d > 0 this bounds r_n z where z ≥ 0; elsewhere r_n z ≤ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Regularised {
    /// k \[N/m\].
    pub stiffness: f64,
    /// Whether d > 0.
    pub damped: bool,
}

/// A step seen through its law: everything the bounds are made of.
pub(super) struct Posed {
    /// The impulses.
    pub exchange: Exchange,
    /// e per contact.
    pub restitutions: Vec<f64>,
    /// −r·shift − rᵀR r \[J\].
    pub given: f64,
    /// w \[J\].
    pub work: Work,
    /// Rounding of all of it \[J\].
    pub rounding: f64,
}

impl Regularised {
    /// r_n²/(h²k), at most r_n δ/h with d > 0, and the work of what the law's own iteration left between its velocity and v⁺.
    fn work(&self, taken: &Taken, exchange: &Exchange, shift: &DVector<f64>) -> Work {
        let rows = exchange.impulse.len() / taken.step.assembled.active.len().max(1);
        let normals = exchange.impulse.iter().zip(shift).step_by(rows.max(1));
        let soft = |(r, s): (&f64, &f64)| {
            let square = r * r / (taken.h * taken.h * self.stiffness);
            if self.damped { square.min((-r * s).max(0.0)) } else { square }
        };
        let softened: f64 = normals.map(soft).sum();
        let law = taken.step.solution.as_ref().map_or_else(|| exchange.after.clone(), |solution| solution.velocity.clone());
        let terms = exchange.impulse.abs().dot(&(law.abs() + exchange.after.abs()));
        let residual = exchange.impulse.dot(&(&exchange.after - law)).max(0.0);
        // ‖D(M(v⁺ − v_free) − Hᵀr)‖ ≤ τ ‖D Hᵀr‖ does as much work as τ rᵀW r at most
        let limit = tolerance::RESIDUAL_WORK * (terms + exchange.square);
        Work { residual, limit, softened, size: terms + softened }
    }
}

impl WaistLaw {
    /// The step's impulses, its declared shift and its residual.
    pub fn posed(&self, taken: &Taken) -> Result<Posed> {
        let exchange = Exchange::new(taken)?;
        let (shift, restitutions) = self.shift.declared(taken, &exchange)?;
        let step = taken.step;
        let work = match (&step.assembled.problem, &step.solution, self.regularised) {
            (_, _, Some(law)) => law.work(taken, &exchange, &shift),
            (Some(problem), Some(solution), None) => law::work(problem, solution, &exchange.impulse),
            _ if exchange.impulse.is_empty() => Work { residual: 0.0, limit: 0.0, softened: 0.0, size: 0.0 },
            _ => return Err(Error::Unsupported("a step that has impulses but not the contact problem that they solve".into())),
        };
        let size = exchange.size + work.size + exchange.impulse.abs().dot(&shift.abs());
        let rounding = tolerance::energy(exchange.impulse.len(), taken.before.velocity.len(), size);
        Ok(Posed { given: -exchange.impulse.dot(&shift) - work.softened, restitutions, work, rounding, exchange })
    }

    /// Whether the total energy has a bound by the step's data alone, and e: one e for all contacts that push, and friction only with
    /// e = 0 or with the full vector reversed.
    pub fn one_restitution(&self, posed: &Posed) -> Option<f64> {
        if !self.shift.is_newton() {
            return None;
        }
        let Posed { exchange, restitutions, .. } = posed;
        let rows = exchange.impulse.len() / restitutions.len().max(1);
        let parts = exchange.impulse.as_slice().chunks(rows.max(1));
        let pushing: Vec<(f64, &[f64])> = restitutions.iter().copied().zip(parts).filter(|(_, r)| r.iter().any(|r| *r != 0.0)).collect();
        let Some(&(first, _)) = pushing.first() else { return Some(0.0) };
        let rubs = pushing.iter().any(|(_, r)| r[1..].iter().any(|r| *r != 0.0));
        let fits = first == 0.0 || !rubs || self.shift == Shift::Newton { full: true };
        (fits && pushing.iter().all(|(e, _)| *e == first)).then_some(first)
    }
}

/// Σ|F_i||v_i| h, the work of a force over a step, without cancellation \[J\].
pub(super) fn effort(force: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> f64 {
    force.abs().dot(&velocity.abs()) * h
}
