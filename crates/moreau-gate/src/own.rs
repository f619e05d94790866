//! Our own schemes behind the engine's door: rigid bodies in space, one scheme, one solver, nothing else.

use crate::description::{BodyKind, Friction, OneOrMany, Precision, ShapeKind};
use crate::tolerance::SAME_TIME;
use crate::{ContactModel, Description, Engine, Kind, Level, Options, Parameter, Refusal, Reply};
use moreau_contact::certificate::{Judgement, StepResidual};
use moreau_contact::cones::second_order;
use moreau_contact::problem::{self, ContactProblem, Solution};
use moreau_contact::solvers::{ContactSolver, Solvers};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::schemes;
use moreau_dynamics::schemes::{Activation, Anitescu, MoreauJean, Scheme, Step, StewartTrinkle};
use moreau_dynamics::trajectory::{Recorder, Trajectory};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};
use serde_json::Value;
use std::collections::BTreeMap;

/// The names [`by_name`] knows.
pub const NAMES: [&str; 4] = ["moreau-jean", "moreau-jean-theta-1", "stewart-trinkle", "anitescu"];

/// The mechanism of a scene with its initial state.
pub type Mechanics = fn(&Scene) -> Result<(Box<dyn Mechanism>, State)>;

/// The options of our schemes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnParameters {
    /// θ of Moreau–Jean.
    pub theta: f64,
    /// Activation rule of Moreau–Jean.
    pub activation: Activation,
    /// Friction directions of Stewart–Trinkle at spatial contacts.
    pub directions: usize,
}

impl Default for OwnParameters {
    fn default() -> Self {
        let MoreauJean { theta, activation, .. } = MoreauJean::default();
        OwnParameters { theta, activation, directions: StewartTrinkle::default().directions }
    }
}

/// Moreau–Jean with these options.
///
/// # Errors
/// θ outside \[0, 1\].
pub fn moreau_jean(&OwnParameters { theta, activation, .. }: &OwnParameters) -> Result<Box<dyn Scheme>> {
    let scheme = MoreauJean { theta, activation, ..MoreauJean::default() };
    scheme.validate()?;
    Ok(Box::new(scheme))
}

fn stewart_trinkle(&OwnParameters { directions, .. }: &OwnParameters) -> Result<Box<dyn Scheme>> {
    let scheme = StewartTrinkle { directions };
    scheme.validate()?;
    Ok(Box::new(scheme))
}

/// One of our schemes as an engine. Every part can be exchanged: a planted engine is one with one part wrong.
#[derive(Clone)]
pub struct OwnEngine {
    /// What it is called.
    pub name: String,
    /// The contact law it declares.
    pub law: OwnScheme,
    /// The options that apply when a request gives none.
    pub parameters: OwnParameters,
    /// Whether a step that the certificate rejects is an error. A planted engine is let through: the checks have to see its mistake.
    pub certified: bool,
    /// The solver when a request names none.
    pub solver_name: String,
    /// The scheme.
    pub scheme: fn(&OwnParameters) -> Result<Box<dyn Scheme>>,
    /// The solvers that a request may name.
    pub solvers: Solvers,
    /// The mechanism of a scene with its initial state.
    pub mechanism: Mechanics,
    /// Replaces a point (n, t₁, …) by its projection on K_μ.
    pub project: fn(&mut [f64], f64),
}

/// The law a scheme declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnScheme {
    /// Moreau–Jean: Coulomb–Signorini with restitution; options θ and activation.
    Coulomb,
    /// Stewart–Trinkle: d friction directions, no restitution.
    StewartTrinkle,
    /// Anitescu: the convex relaxation, no restitution.
    Anitescu,
}

/// One of our schemes as an engine.
///
/// # Errors
/// [`Error::Unsupported`] lists the known names.
///
/// ```
/// use moreau_gate::{Engine, Options, own};
///
/// let mut engine = own::by_name("anitescu")?;
/// let description = engine.describe(&Options::new()).expect("it describes itself");
/// assert_eq!(description.contact_model.law.as_deref(), Some("anitescu"));
/// assert!(!description.restitution && own::by_name("no-such-engine").is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn by_name(name: &str) -> Result<OwnEngine> {
    let default = OwnParameters::default();
    let engine = |law, parameters, scheme: fn(&OwnParameters) -> Result<Box<dyn Scheme>>| OwnEngine {
        name: name.into(),
        law,
        parameters,
        certified: true,
        solver_name: "auto".into(),
        scheme,
        solvers: Solvers::own(),
        mechanism: Scene::spatial_mechanism,
        project: second_order::project,
    };
    match name {
        "moreau-jean" => Ok(engine(OwnScheme::Coulomb, default, moreau_jean)),
        "moreau-jean-theta-1" => Ok(engine(OwnScheme::Coulomb, OwnParameters { theta: 1.0, ..default }, moreau_jean)),
        "stewart-trinkle" => Ok(engine(OwnScheme::StewartTrinkle, default, stewart_trinkle)),
        "anitescu" => Ok(engine(OwnScheme::Anitescu, default, |_| Ok(Box::new(Anitescu)))),
        _ => Err(Error::Unsupported(format!("there is no engine `{name}`; use one of {}", NAMES.join(", ")))),
    }
}

impl OwnEngine {
    /// The same engine under the options of a request.
    fn with(&self, options: &Options) -> Reply<OwnEngine> {
        let mut engine = self.clone();
        for (option, value) in options {
            engine.set(option, value).map_err(Refusal::errored)?;
        }
        Ok(engine)
    }

    fn set(&mut self, option: &str, value: &Value) -> Result<()> {
        let wrong = |cure: &str| Error::invalid(format!("options.{option}"), format!("is {value}"), cure);
        match (self.law, option) {
            (_, "solver") => self.solver_name = value.as_str().ok_or_else(|| wrong("use the name of a solver"))?.into(),
            (OwnScheme::Coulomb, "theta") => self.parameters.theta = value.as_f64().ok_or_else(|| wrong("use a number from 0 to 1"))?,
            (OwnScheme::Coulomb, "activation") => {
                self.parameters.activation = Activation::by_name(value.as_str().ok_or_else(|| wrong("use the name of a rule"))?)?;
            }
            (OwnScheme::StewartTrinkle, "directions") => {
                let whole = value.as_f64().filter(|d| d.fract() == 0.0 && *d >= 3.0 && *d <= f64::from(u32::MAX));
                self.parameters.directions = whole.ok_or_else(|| wrong("use a whole number from 3 on"))? as usize;
            }
            _ => return Err(Error::invalid(format!("options.{option}"), "is unknown", format!("use one of {}", self.known()))),
        }
        Ok(())
    }

    fn known(&self) -> &'static str {
        match self.law {
            OwnScheme::Coulomb => "solver, theta, activation",
            OwnScheme::StewartTrinkle => "solver, directions",
            OwnScheme::Anitescu => "solver",
        }
    }

    /// Scheme and solver, or why there are none.
    fn parts(&self) -> Reply<(Box<dyn Scheme>, Box<dyn ContactSolver>)> {
        let scheme = (self.scheme)(&self.parameters).map_err(Refusal::errored)?;
        Ok((scheme, self.solvers.by_name(&self.solver_name).map_err(Refusal::errored)?))
    }

    fn chosen(&self) -> Options {
        let mut options = Options::new();
        options.insert("solver".into(), self.solver_name.clone().into());
        if self.law == OwnScheme::Coulomb {
            options.insert("theta".into(), self.parameters.theta.into());
            options.insert("activation".into(), self.parameters.activation.name().into());
        }
        options
    }

    fn contact_model(&self) -> ContactModel {
        let directions = || Parameter { value: OneOrMany::One(self.parameters.directions as f64), unit: OneOrMany::One("1".into()) };
        let (law, parameters) = match self.law {
            OwnScheme::Coulomb => ("coulomb", BTreeMap::new()),
            OwnScheme::StewartTrinkle => ("stewart-trinkle", BTreeMap::from([("directions".to_string(), directions())])),
            OwnScheme::Anitescu => ("anitescu", BTreeMap::new()),
        };
        ContactModel { kind: Kind::Rigid, law: Some(law.into()), parameters }
    }
}

impl Engine for OwnEngine {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        let engine = self.with(options)?;
        let (_, solver) = engine.parts()?;
        Ok(Description {
            name: engine.name.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            precision: Precision::Double,
            contact_model: engine.contact_model(),
            restitution: engine.law == OwnScheme::Coulomb,
            friction: if engine.law == OwnScheme::StewartTrinkle { Friction::Pyramid } else { Friction::Cone },
            reports_contacts: true,
            levels: vec![Level::Simulate, Level::Solve, Level::Project],
            laws: laws(solver.as_ref()),
            shapes: ShapeKind::ALL.to_vec(),
            bodies: BodyKind::ALL.to_vec(),
            sleeping: None,
            options: engine.chosen(),
        })
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let engine = self.with(options)?;
        if engine.law != OwnScheme::Coulomb && bounces(scene) {
            return Err(Refusal::unsupported("this scheme has no restitution: every impact is plastic"));
        }
        let steps = count_steps(scene.duration, time_step, sample_every)?;
        let (scheme, solver) = engine.parts()?;
        let (mechanism, start) = (engine.mechanism)(scene).map_err(refusal)?;
        let who = moreau_dynamics::trajectory::Producer {
            name: engine.name.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            options: engine.chosen(),
        };
        let mut recorder = Recorder::new(mechanism.as_ref(), scene, who, time_step, sample_every, &start);
        let truncated = scheme.is_truncated() || solver.is_truncated();
        let mut rejected: Option<(usize, f64, StepResidual)> = None;
        let mut made = 0;
        let observe = |step: &Step| {
            made += 1;
            recorder.push(&step.state, &step.impulses);
            let judgement = step.judgement(truncated);
            recorder.push_residual(step.residual, judgement);
            if let (Judgement::Rejected, Some(residual), None) = (judgement, step.residual, rejected) {
                rejected = Some((made, step.state.time, residual));
            }
        };
        schemes::run(scheme.as_ref(), solver.as_ref(), mechanism.as_ref(), start, time_step, steps, observe).map_err(refusal)?;
        if let Some((step, time, StepResidual { residual, relative, limit, .. })) = rejected.filter(|_| engine.certified) {
            let reason = format!(
                "the certificate rejects step {step} (t = {time} s): {residual} residual {relative:.1e} of its scale, limit {limit:.0e}"
            );
            return Err(Refusal::errored(reason));
        }
        recorder.finish().map_err(Refusal::errored)
    }

    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        let (_, solver) = self.with(options)?.parts()?;
        if !solver.takes(problem.law(), problem.rows_per_contact(), true) {
            return Err(Refusal::unsupported(format!("solver `{}` does not take the law `{}`", solver.name(), problem.law().name())));
        }
        solver.solve(problem, None).map_err(refusal)
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        let engine = self.with(options)?;
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(Refusal::errored(format!("`friction` is {friction}; use a number ≥ 0")));
        }
        if points.iter().any(Vec::is_empty) {
            return Err(Refusal::errored("`points` has an empty row; use (n, t₁) or (n, t₁, t₂)"));
        }
        let projected = |point: &Vec<f64>| {
            let mut point = point.clone();
            (engine.project)(&mut point, friction);
            point
        };
        Ok(points.iter().map(projected).collect())
    }
}

/// The laws a solver takes at contacts in space, with a symmetric W; those with directions are asked for with four.
fn laws(solver: &dyn ContactSolver) -> Vec<String> {
    let directions = 4;
    let all = [
        problem::Law::Frictionless,
        problem::Law::Coulomb,
        problem::Law::Associated,
        problem::Law::PolyhedralCoulomb { directions },
        problem::Law::PolyhedralAssociated { directions },
    ];
    all.into_iter().filter(|law| solver.takes(*law, 3, true)).map(|law| law.name().into()).collect()
}

fn bounces(scene: &Scene) -> bool {
    scene.material.restitution > 0.0 || scene.material.pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e > 0.0))
}

/// What an error of ours means in the protocol.
fn refusal(error: Error) -> Refusal {
    match error {
        Error::Unsupported(reason) => Refusal::Unsupported(reason),
        // not a problem for this solver: the engine cannot express the question
        refused @ Error::Solver { failure: Failure::Refused, .. } => Refusal::unsupported(refused.to_string()),
        other => Refusal::errored(other),
    }
}

/// The number of steps n with n h = duration.
fn count_steps(duration: f64, time_step: f64, sample_every: usize) -> Reply<usize> {
    let steps = (duration / time_step).round();
    if !(time_step > 0.0 && steps >= 1.0 && steps < f64::from(u32::MAX)) {
        return Err(Refusal::errored(format!("`time_step` is {time_step} with a duration of {duration} s")));
    }
    if (steps * time_step - duration).abs() > SAME_TIME * duration {
        return Err(Refusal::errored(format!("`time_step` {time_step} does not divide the duration {duration}")));
    }
    if sample_every == 0 {
        return Err(Refusal::errored("`sample_every` is 0; use at least 1"));
    }
    Ok(steps as usize)
}

#[cfg(test)]
#[path = "own_tests.rs"]
mod tests;
