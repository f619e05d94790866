//! Schemes with a mistake: what agreements plant, to show that they can fail.

use moreau_dynamics::schemes::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
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
pub fn planted<S: Waist>(scheme: S, mistake: Mistake) -> Mistaken<S> {
    Mistaken { scheme, mistake }
}

impl<S: Waist> Scheme for Mistaken<S> {
    fn name(&self) -> String {
        format!("{} with a mistake: {:?}", self.scheme.name(), self.mistake)
    }

    fn has_restitution(&self) -> bool {
        self.scheme.has_restitution()
    }

    fn is_truncated(&self) -> bool {
        self.scheme.is_truncated()
    }

    passes_the_waist!();
}

impl<S: Waist> Waist for Mistaken<S> {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let state = at.state();
        let mut step = self.scheme.assemble(at)?;
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

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let reached = self.scheme.advance(at, velocity_post);
        // only where positions have as many entries as velocities: not with quaternions
        if self.mistake == Mistake::Ahead { reached + (velocity_post - &state.velocity) * (0.5 * h) } else { reached }
    }

    fn settle(&self, at: &StepContext, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        let ahead = if self.mistake == Mistake::Ahead { f64::EPSILON.sqrt() } else { 0.0 };
        Ok(self.scheme.settle(at, assembled, position)?.add_scalar(ahead))
    }
}
