//! What a scheme is: one step of a state; and what a scheme is whose step is one contact problem.

use super::carried::Carried;
use super::certified::{Certified, Rejected};
use super::context::StepContext;
use crate::mechanics::{Mechanism, State};
use crate::trajectory::LocatedImpact;
use moreau_contact::certificate::{Judgement, StepResidual};
use moreau_contact::contact::{ContactImpulse, Inertia, Jacobian, Place};
use moreau_contact::memory::spare::{self, Spare};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_exact::Result;
use nalgebra::DVector;
use std::sync::Arc;

/// The impulses of a step's law, and how well the scheme's own stopping rule is met, if it has one.
#[derive(Clone, Debug)]
pub struct OwnAnswer {
    /// Impulses and velocities.
    pub solution: Solution,
    /// The residual of the law; none where the solver certifies its answer.
    pub residual: Option<StepResidual>,
}

/// Where a step starts.
#[derive(Clone, Copy)]
pub struct Start<'a> {
    /// What moves.
    pub mechanism: &'a dyn Mechanism,
    /// The state before the step.
    pub state: &'a State,
    /// The size of the step \[s\].
    pub h: f64,
    /// The impulses of the step before, or what they were in the mean of the last ones, to start from; empty at the first one.
    pub previous: &'a [ContactImpulse],
}

/// What becomes of a step: the step, or why there is none.
pub type StepResult = Result<Step>;

/// One time-stepping scheme: one step of a state.
pub trait Scheme: Send + Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> String;
    /// Whether the scheme uses the mechanism's coefficients of restitution; without, every impact is plastic or as soft as its contact.
    fn has_restitution(&self) -> bool {
        true
    }
    /// Whether the scheme's algorithm is a declared number of sweeps, so that a step its certificate rejects counts as unconverged.
    fn is_truncated(&self) -> bool {
        false
    }
    /// One step; a scheme that passes the [`Waist`] takes this method from [`passes_the_waist!`](super::passes_the_waist).
    ///
    /// # Errors
    /// If the state, the step or the mechanism is outside the scheme's scope, or a contact problem has no answer.
    fn step(&self, solver: &Certified, start: &Start) -> Result<Step>;
    /// The scheme itself, if its step is one contact problem.
    fn waist(&self) -> Option<&dyn Waist> {
        None
    }
    /// The scheme that makes the next step of a motion, if this one remembers more than the state; `None`: the same scheme again.
    ///
    /// # Errors
    /// If what is to be remembered cannot be computed.
    fn successor(&self, mechanism: &dyn Mechanism, before: &State, step: &Step, h: f64) -> Result<Option<Box<dyn Scheme>>> {
        let _ = (mechanism, before, step, h);
        Ok(None)
    }
}

/// The outcome of one step.
#[derive(Clone, Debug)]
pub struct Step {
    /// The state after the step.
    pub state: State,
    /// Impulses of the active contacts.
    pub impulses: Vec<ContactImpulse>,
    /// What was assembled.
    pub assembled: StepProblem,
    /// The answer, if any contact was active.
    pub solution: Option<Solution>,
    /// The worst residual of everything the step solved; none if it solved nothing.
    pub residual: Option<StepResidual>,
    /// The first contact problem whose answer the certificate rejects.
    pub rejected: Option<Box<Rejected>>,
    /// The impacts within the step, of a scheme that locates them; `None` of the others.
    pub impacts: Option<Vec<LocatedImpact>>,
}

impl Step {
    /// Whether the step is accepted; `truncated` if its scheme or solver declares a number of sweeps.
    pub fn judgement(&self, truncated: bool) -> Judgement {
        Judgement::of(self.residual, truncated)
    }

    /// The state after the step, for the next one to start from, and its impulses for what is carried; the next step may take the memory of
    /// all else, and of the state before.
    pub(super) fn follow(self, state: State, carried: &mut Carried) -> State {
        let Step { state: next, impulses, assembled, solution, .. } = self;
        assembled.leave();
        if let Some(solution) = solution {
            solution.leave();
        }
        state.position.leave();
        state.velocity.leave();
        carried.follow(impulses);
        next
    }
}

/// What a scheme assembled for one step: the problem of the active contacts, and what turns impulses into velocities.
#[derive(Clone, Debug)]
pub struct StepProblem {
    /// The contact problem of the active contacts; `None` if no contact is active, or if the scheme's law is none of
    /// [`moreau_contact::problem::Law`].
    pub problem: Option<ContactProblem>,
    /// Indices of the active contacts into [`Mechanism::contacts`].
    pub active: Vec<usize>,
    /// Where the active contacts are, one entry per entry of `active`.
    pub places: Vec<Option<Place>>,
    /// M̂, effective mass of the step.
    pub effective_mass: Arc<Inertia>,
    /// v_free = v + h M̂⁻¹F, with the linear part of F as in [`super::moreau_jean`].
    pub free_velocity: DVector<f64>,
    /// H of the active contacts.
    pub jacobian: Arc<Jacobian>,
    /// The worst residual of problems that were solved to assemble this one; none for most schemes.
    pub residual: Option<StepResidual>,
    /// The first of their answers that was rejected.
    pub rejected: Option<Box<Rejected>>,
}

impl StepProblem {
    /// Leaves its memory to the next step.
    fn leave(self) {
        let StepProblem { problem, active, places, effective_mass, free_velocity, jacobian, residual: _, rejected: _ } = self;
        drop(problem); // which shares M̂ and H
        active.leave();
        places.leave();
        free_velocity.leave();
        spare::leave_shared(effective_mass);
        spare::leave_shared(jacobian);
    }
}

/// A scheme whose step is one contact problem.
pub trait Waist: Scheme {
    /// Poses the contact problem of the step.
    ///
    /// # Errors
    /// If the mass matrix is not positive definite or the mechanism is outside the scheme's scope.
    fn assemble(&self, at: &StepContext) -> Result<StepProblem>;
    /// The next configuration from the velocities before and after the step.
    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64>;
    /// The configuration after [`Waist::advance`], corrected for the contacts that the step held; the same one by default.
    ///
    /// # Errors
    /// If the correction does not come to an end.
    fn settle(&self, at: &StepContext, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        let _ = (at, assembled);
        Ok(position)
    }
}
