//! Schemes with a mistake: what agreements plant, to show that they can fail.

use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::schemes::{Scheme, StepProblem};
use moreau_exact::Result;
use nalgebra::DVector;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mistake {
    /// Forces act 10 % too strongly.
    Heavy,
    /// Half of every μ.
    HalfFriction,
    /// Positions move on by half the change of velocity as well.
    Ahead,
}

/// A scheme with a mistake.
pub struct Mistaken<S> {
    scheme: S,
    mistake: Mistake,
}

/// The scheme with this mistake.
pub fn planted<S: Scheme>(scheme: S, mistake: Mistake) -> Mistaken<S> {
    Mistaken { scheme, mistake }
}

impl<S: Scheme> Scheme for Mistaken<S> {
    fn name(&self) -> String {
        format!("{} with a mistake: {:?}", self.scheme.name(), self.mistake)
    }

    fn assemble(&self, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
        let mut step = self.scheme.assemble(mechanism, state, h)?;
        let more = (&step.free_velocity - &state.velocity) * if self.mistake == Mistake::Heavy { 0.1 } else { 0.0 };
        step.free_velocity += &more;
        if let Some(problem) = step.problem.take() {
            let free_velocity = problem.free_velocity() + &step.jacobian * more;
            let factor = if self.mistake == Mistake::HalfFriction { 0.5 } else { 1.0 };
            let friction = problem.friction().iter().map(|mu| mu * factor).collect();
            step.problem = Some(problem.into_builder().free_velocity(free_velocity).friction(friction).build()?);
        }
        Ok(step)
    }

    fn settle(&self, mechanism: &dyn Mechanism, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        let ahead = if self.mistake == Mistake::Ahead { f64::EPSILON.sqrt() } else { 0.0 };
        Ok(self.scheme.settle(mechanism, assembled, position)?.add_scalar(ahead))
    }

    fn advance(&self, mechanism: &dyn Mechanism, state: &State, velocity_post: &DVector<f64>, h: f64) -> DVector<f64> {
        let reached = self.scheme.advance(mechanism, state, velocity_post, h);
        // only where positions have as many entries as velocities: not with quaternions
        if self.mistake == Mistake::Ahead { reached + (velocity_post - &state.velocity) * (0.5 * h) } else { reached }
    }
}
