//! Whether an adapter speaks `moreau-engine/1`: probes whose outcome tells its author what is wrong and how to cure it.
//!
//! The probes look for mistakes of the adapter – a frame, an order of components, a sample too early, a force for an impulse –, which
//! are off by a whole quantity. How well the engine simulates is the question of the checks of the gate.

mod contacts;
mod conversation;
mod description;
mod motion;
mod rotation;
mod scenes;
mod seen;
mod tasks;
mod unmoved;

pub use seen::{Probe, ProbeOutcome};

use crate::process::{Fate, Fault, Limits, ProcessEngine};
use crate::{Description, Engine, Level, Options, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use schemars::JsonSchema;
use seen::{Probes, Seen, demand, probe, problem, refused, skipped};
use serde::Serialize;

/// The outcomes of all probes, with the description if there is a sound one.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Conformance {
    /// What the adapter said of its engine.
    pub engine: Option<Description>,
    /// In the order in which they were asked.
    pub probes: Vec<Probe>,
}

impl Conformance {
    /// Whether no probe found a problem.
    pub fn is_sound(&self) -> bool {
        !self.probes.iter().any(|probe| matches!(probe.outcome, ProbeOutcome::Problem { .. }))
    }
}

/// What the probes of the description, of motion and of contact impulses find wrong with an engine under these options.
///
/// # Errors
/// [`Refusal`](crate::Refusal) if the engine does not describe itself: then no check can be run either, and nobody need wait for it again.
///
/// ```
/// use moreau_gate::{Engine, Options, conformance::misreported, own, planted};
///
/// let told = |mut engine: Box<dyn Engine>| misreported(engine.as_mut(), &Options::new()).map_or(0, |probes| probes.len());
/// assert_eq!(told(Box::new(own::by_name("moreau-jean")?)), 0);
/// let late = planted::find("flight/samples-a-step-late").expect("planted");
/// assert!(told((late.subject.engine)()) > 0);
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn misreported(engine: &mut dyn Engine, options: &Options) -> Reply<Vec<Probe>> {
    let description = engine.describe(options)?;
    let mut probes = Probes::heard_by(&|_| ());
    description::probe_all(&description, &mut probes.done);
    if description.levels.contains(&Level::Simulate) {
        motion::probe_all(&mut Under { engine, options }, &description, &mut probes);
    }
    probes.done.retain(|probe| matches!(probe.outcome, ProbeOutcome::Problem { .. }));
    Ok(probes.done)
}

/// The first probe.
const DESCRIBED: &str = "describe/answers";

/// An engine whose every simulation has these options.
struct Under<'a> {
    engine: &'a mut dyn Engine,
    options: &'a Options,
}

impl Engine for Under<'_> {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.engine.describe(options)
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let all: Options = self.options.clone().into_iter().chain(options.clone()).collect();
        self.engine.simulate(scene, time_step, sample_every, &all)
    }
}

/// Probes an adapter.
///
/// # Errors
/// [`Fault`] if the program cannot be started, or ends before it has answered anything.
pub fn conformance(command: &[String], limits: Limits) -> Result<Conformance, Fault> {
    conformance_heard(command, limits, &|_| ())
}

/// [`conformance`] with an ear: `asked` hears the name of each probe that waits for the adapter, before it does. An adapter that keeps
/// silent when it is asked to describe itself, or twice in a row later, is asked no more, and the probes left are skipped.
///
/// # Errors
/// Those of [`conformance`].
pub fn conformance_heard(command: &[String], limits: Limits, asked: &dyn Fn(&str)) -> Result<Conformance, Fault> {
    let mut talk = conversation::Talk::new(command, limits);
    let mut probes = Probes::heard_by(asked);
    probes.begin(DESCRIBED);
    let first = talk.describe();
    if let Err(fault) = &first
        && matches!(fault.cause, Fate::NotStarted(_) | Fate::Ended(..))
    {
        return Err(fault.clone());
    }
    let described = conversation::described(first);
    let engine = described.as_ref().ok().cloned();
    probes.push(probe(DESCRIBED, "describe is answered with the fields of the specification", described.map(drop)));
    conversation::probe_all(&mut talk, engine.as_ref(), &mut probes);
    if let Some(description) = &engine {
        description::probe_all(description, &mut probes.done);
    }
    if let Some(description) = engine.as_ref().filter(|_| !talk.is_over()) {
        let mut process = ProcessEngine::new(command.to_vec(), limits);
        if description.levels.contains(&Level::Simulate) {
            motion::probe_all(&mut process, description, &mut probes);
        }
        tasks::probe_all(&mut process, description, &mut probes);
    }
    conversation::probe_farewell(&mut talk, &mut probes);
    Ok(Conformance { engine, probes: probes.done })
}
