//! From the steps of a simulation to a `trajectory/1`: states at every N-th step, impulses of each pair of bodies summed in between.

use super::Recording;
use super::file::{BodyTrack, ContactRecord, Producer, SCHEMA, Trajectory};
use crate::mechanics::{Mechanism, State};
use crate::scenes::Scene;
use moreau_contact::certificate::{Judgement, StepResidual};
use moreau_contact::contact::{ContactImpulse, Place};
use moreau_exact::Result;
use std::collections::BTreeMap;

/// The first and the second body; `None` is the ground.
type Pair = (usize, Option<usize>);

/// Σ r and Σ r_n n over the points of a pair, in the world \[N·s\].
#[derive(Clone, Copy, Default)]
struct Sum {
    impulse: [f64; 3],
    normal: [f64; 3],
}

impl Trajectory {
    /// The samples of a recording, body by body through [`Mechanism::bodies`], and the impulses between them.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if the recording and the scene do not fit together.
    pub fn from_recording(recording: &Recording, mechanism: &dyn Mechanism, scene: &Scene, engine: Producer) -> Result<Self> {
        let mut recorder = Recorder::new(mechanism, scene, engine, recording.time_step, 1, &recording.samples[0]);
        for (state, impulses) in recording.samples[1..].iter().zip(&recording.impulses) {
            recorder.push(state, impulses);
        }
        for (residual, judgement) in recording.residuals.iter().zip(&recording.judgements) {
            recorder.push_residual(*residual, *judgement);
        }
        recorder.finish()
    }
}

/// Collects a trajectory step by step.
///
/// The impulses of all points of a pair are added. The normal of the pair is the mean of the points' normals, weighted by their normal
/// impulses. The first body of the pair is the one whose name comes first. A pair without impulse is left out.
pub struct Recorder<'a> {
    mechanism: &'a dyn Mechanism,
    sample_every: usize,
    steps: usize,
    start: f64,
    pending: BTreeMap<Pair, Sum>,
    trajectory: Trajectory,
}

impl<'a> Recorder<'a> {
    /// Starts with the initial state; every `sample_every`-th step becomes a sample (0 counts as 1).
    pub fn new(
        mechanism: &'a dyn Mechanism,
        scene: &Scene,
        engine: Producer,
        time_step: f64,
        sample_every: usize,
        initial: &State,
    ) -> Recorder<'a> {
        let names = mechanism.bodies(&initial.position, &initial.velocity).into_iter().map(|body| body.name);
        let trajectory = Trajectory {
            schema: SCHEMA.into(),
            scene: scene.clone(),
            engine,
            time_step,
            times: Vec::new(),
            bodies: names.map(|name| BodyTrack::empty(&name)).collect(),
            contacts: Vec::new(),
            steps: None,
            provenance: None,
        };
        let sample_every = sample_every.max(1);
        let mut recorder = Recorder { mechanism, sample_every, steps: 0, start: initial.time, pending: BTreeMap::new(), trajectory };
        recorder.sample(initial);
        recorder
    }

    /// Adds the state after a step and the impulses that acted during it. Impulses without a place are not known to a file.
    pub fn push(&mut self, state: &State, impulses: &[ContactImpulse]) {
        for contact in impulses {
            if let Some(place) = &contact.place {
                self.add(place, &contact.impulse);
            }
        }
        self.steps += 1;
        if self.steps.is_multiple_of(self.sample_every) {
            self.sample(state);
        }
    }

    /// Adds the worst residual of a step and the judgement of that residual.
    pub fn push_residual(&mut self, residual: Option<StepResidual>, judgement: Judgement) {
        let steps = self.trajectory.steps.get_or_insert_default();
        if let Some(StepResidual { limit, .. }) = residual {
            steps.limit = limit;
        }
        // a file has no infinite number, and no other number is as far from a solution
        let written = |StepResidual { relative, .. }: StepResidual| if relative.is_finite() { relative } else { f64::MAX };
        steps.relative.push(residual.map(written));
        steps.accepted.push(judgement == Judgement::Accepted);
    }

    /// The trajectory so far.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if the motion is not one of the scene, or not finite.
    pub fn finish(self) -> Result<Trajectory> {
        self.trajectory.validate()?;
        Ok(self.trajectory)
    }

    fn add(&mut self, place: &Place, impulse: &[f64]) {
        let (first, second) = place.bodies;
        let name = |body: usize| &self.trajectory.bodies[body].name;
        let (pair, sign) = match second {
            Some(second) if name(second) < name(first) => ((second, Some(first)), -1.0),
            _ => ((first, second), 1.0),
        };
        let total = place.world_impulse(impulse);
        let sum = self.pending.entry(pair).or_default();
        for (axis, part) in total.into_iter().enumerate() {
            sum.impulse[axis] += sign * part;
            sum.normal[axis] += sign * impulse[0] * place.frame[0][axis];
        }
    }

    fn sample(&mut self, state: &State) {
        let states = self.mechanism.bodies(&state.position, &state.velocity);
        let trajectory = &mut self.trajectory;
        let sample = trajectory.times.len();
        trajectory.times.push(state.time - self.start);
        for (track, state) in trajectory.bodies.iter_mut().zip(states) {
            track.position.push(state.position);
            track.orientation.push(state.orientation);
            track.linear_velocity.push(state.linear_velocity);
            track.angular_velocity.push(state.angular_velocity);
        }
        for ((first, second), Sum { impulse, normal }) in std::mem::take(&mut self.pending) {
            let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
            if length > 0.0 {
                let name = |body: usize| trajectory.bodies[body].name.clone();
                let bodies = [name(first), second.map_or_else(|| "ground".into(), name)];
                trajectory.contacts.push(ContactRecord { sample, bodies, normal: normal.map(|part| part / length), impulse });
            }
        }
    }
}
