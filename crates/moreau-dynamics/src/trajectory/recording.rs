//! A recorded motion: the states at t_k = t_0 + k h and the impulses between them.

use crate::mechanics::State;
use moreau_contact::certificate::{Judgement, StepResidual};
use moreau_contact::contact::ContactImpulse;

/// An impact that its scheme has located within a step.
#[derive(Clone, Debug, PartialEq)]
pub struct LocatedImpact {
    /// When \[s\].
    pub time: f64,
    /// u_n of every contact candidate before and after it \[m/s\].
    pub normal_velocities: Vec<[f64; 2]>,
}

/// States of a mechanism at equidistant times, and the contact impulses of each step.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Name of the mechanism.
    pub mechanism: String,
    /// Name of the scheme.
    pub scheme: String,
    /// h \[s\].
    pub time_step: f64,
    /// Sample 0 is the initial state.
    pub samples: Vec<State>,
    /// `impulses[k]` acts over (t_k, t_{k+1}].
    pub impulses: Vec<Vec<ContactImpulse>>,
    /// The worst residual of the step from t_k to t_{k+1}; none where nothing was solved.
    pub residuals: Vec<Option<StepResidual>>,
    /// What it means.
    pub judgements: Vec<Judgement>,
    /// The impacts, of a scheme that locates them; `None` of the others.
    pub impacts: Option<Vec<LocatedImpact>>,
}

impl Recording {
    /// A recording that holds the initial state only.
    pub fn new(mechanism: &str, scheme: String, time_step: f64, initial: State) -> Self {
        Recording {
            mechanism: mechanism.into(),
            scheme,
            time_step,
            samples: vec![initial],
            impulses: Vec::new(),
            residuals: Vec::new(),
            judgements: Vec::new(),
            impacts: None,
        }
    }

    /// Appends the state after a step and the impulses that acted during it.
    pub fn push(&mut self, state: State, impulses: Vec<ContactImpulse>) {
        self.push_judged(state, impulses, None, Judgement::Accepted);
    }

    /// Appends the state after a step, its impulses, its worst residual and the judgement of that residual.
    pub fn push_judged(&mut self, state: State, impulses: Vec<ContactImpulse>, residual: Option<StepResidual>, judgement: Judgement) {
        self.samples.push(state);
        self.impulses.push(impulses);
        self.residuals.push(residual);
        self.judgements.push(judgement);
    }

    /// Appends the impacts located within a step.
    pub fn locate(&mut self, impacts: Option<&[LocatedImpact]>) {
        if let Some(impacts) = impacts {
            self.impacts.get_or_insert_default().extend_from_slice(impacts);
        }
    }

    /// The last state.
    pub fn last(&self) -> &State {
        self.samples.last().expect("a recording holds its initial state")
    }
}
