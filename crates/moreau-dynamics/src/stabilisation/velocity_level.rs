//! The constraint at velocity level only: G(q) v⁺ = 0, q⁺ = q + h v⁺. Its position drifts.

use super::{Constrained, Stabilisation, constrain, free_velocity};
use crate::mechanics::State;
use moreau_exact::Result;
use nalgebra::DVector;

/// No stabilisation.
///
/// # Source
/// Chapter §9, why stabilisation is needed.
#[derive(Clone, Copy, Debug)]
pub struct VelocityLevel;

impl Stabilisation for VelocityLevel {
    fn name(&self) -> String {
        "velocity level".into()
    }

    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State> {
        let jacobian = system.jacobian(&state.position);
        let velocity = constrain(system, &jacobian, &free_velocity(system, state, h)?, &DVector::zeros(jacobian.nrows()))?;
        Ok(State { time: state.time + h, position: &state.position + &velocity * h, velocity })
    }
}
