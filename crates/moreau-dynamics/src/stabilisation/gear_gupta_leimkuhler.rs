//! Gear, Gupta and Leimkuhler: position and velocity constraint in one step, with a second multiplier.
//!
//! ```text
//!     M (v⁺ − v) = h F(q) + G(q⁺)ᵀ λ ,     q⁺ = q + h v⁺ + M⁻¹ G(q⁺)ᵀ μ ,     G(q⁺) v⁺ = 0 ,     g(q⁺) = 0 .
//! ```
//! Two multipliers per constraint in place of one, and no parameter. Solved by a fixed point: G at the last iterate, λ from it, and a
//! Newton correction of μ with W⁻¹; the factor is O(h).

use super::{Constrained, ITERATIONS, Stabilisation, along, constrain, free_velocity, not_converged};
use crate::mechanics::State;
use crate::tolerance::stabilisation::on_constraint;
use moreau_exact::Result;
use nalgebra::DVector;

/// The stabilised index-2 formulation with the implicit Euler rule.
///
/// # Source
/// Chapter §9, constraint drift, (2); Gear, Leimkuhler and Gupta, J. Comput. Appl. Math. 12–13 (1985).
#[derive(Clone, Copy, Debug)]
pub struct GearGuptaLeimkuhler;

impl Stabilisation for GearGuptaLeimkuhler {
    fn name(&self) -> String {
        "Gear–Gupta–Leimkuhler".into()
    }

    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State> {
        let free = free_velocity(system, state, h)?;
        let mut position = state.position.clone();
        // W μ: what the second multiplier adds to g, to first order
        let mut correction = DVector::zeros(system.violation(&position).len());
        for _ in 0..ITERATIONS {
            let jacobian = system.jacobian(&position);
            let velocity = constrain(system, &jacobian, &free, &DVector::zeros(jacobian.nrows()))?;
            let next = &state.position + &velocity * h + along(system, &jacobian, &correction)?;
            let (violation, moved) = (system.violation(&next), (&next - &position).amax());
            position = next;
            if violation.amax().max(moved) <= on_constraint(position.amax()) {
                return Ok(State { time: state.time + h, position, velocity });
            }
            correction -= violation;
        }
        Err(not_converged("Gear–Gupta–Leimkuhler"))
    }
}
