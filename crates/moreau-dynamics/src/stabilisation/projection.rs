//! Projection after the step, onto g(q) = 0 and, for coordinate projection, onto G v = 0.
//!
//! ```text
//!     q ← q − M⁻¹Gᵀ W⁻¹ g(q)   until g(q) = 0 to rounding ,        v ← v − M⁻¹Gᵀ W⁻¹ G v .
//! ```
//! Each correction is the smallest one in the norm of M to first order.

use super::{Constrained, ITERATIONS, Stabilisation, VelocityLevel, along, constrain, not_converged};
use crate::mechanics::State;
use crate::tolerance::stabilisation::on_constraint;
use moreau_exact::Result;
use nalgebra::DVector;

/// Projection of the position alone.
///
/// # Source
/// Chapter §9, constraint drift, (3).
#[derive(Clone, Copy, Debug)]
pub struct PositionProjection;

/// Projection of position and velocity.
///
/// # Source
/// Chapter §9, constraint drift, (3); Eich, SIAM J. Numer. Anal. 30 (1993).
#[derive(Clone, Copy, Debug)]
pub struct CoordinateProjection;

fn project(system: &dyn Constrained, mut position: DVector<f64>) -> Result<DVector<f64>> {
    for _ in 0..ITERATIONS {
        let violation = system.violation(&position);
        if violation.amax() <= on_constraint(position.amax()) {
            return Ok(position);
        }
        position -= along(system, &system.jacobian(&position), &violation)?;
    }
    Err(not_converged("position projection"))
}

impl Stabilisation for PositionProjection {
    fn name(&self) -> String {
        "position projection".into()
    }

    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State> {
        let State { time, position, velocity } = VelocityLevel.step(system, state, h)?;
        Ok(State { time, position: project(system, position)?, velocity })
    }
}

impl Stabilisation for CoordinateProjection {
    fn name(&self) -> String {
        "coordinate projection".into()
    }

    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State> {
        let State { time, position, velocity } = PositionProjection.step(system, state, h)?;
        let jacobian = system.jacobian(&position);
        let velocity = constrain(system, &jacobian, &velocity, &DVector::zeros(jacobian.nrows()))?;
        Ok(State { time, position, velocity })
    }
}
