//! `moreau simulate`: a scene through a scheme, with numbers, a file and a picture.

use super::drake_options::DrakeOptions;
use super::near::suggestion;
use super::output::{keep_input, print};
use super::scene::{count_steps, find, finite, positive};
use super::{Answer, Format};
use crate::files::{is_same_file, write_together};
use crate::report::json::pretty;
use crate::report::motion::{Motion, Quantity, lines};
use crate::report::plot;
use crate::scenes::{self, ExactMotion, Linkage, Scene, Staged};
use crate::schemes::mujoco::{Cone, Softness};
use crate::schemes::{self, Activation, Mujoco, Parameters, RestitutionRule, Scheme};
use crate::trajectory::{Engine, Trajectory};
use crate::{Error, Result, solvers};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Simulate a scene with a scheme: summary, trajectory/1 and a picture.
///
/// The summary tells penetration, energy, restitution, rest and creep with units, and the distance from the closed
/// form where the scene has one. The picture shows position, velocity and energy over time, with the closed form
/// beneath.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A built-in scene or a file scene/1.
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "list")]
    scene: Option<String>,
    /// The time-stepping scheme: moreau-jean, moreau-jean-projection, schatzman-paoli, generalised-alpha, stewart-trinkle, anitescu, chrono, bullet, mujoco, explicit-euler, semi-implicit-euler, runge-kutta-flip, event-driven, xpbd, pbd, drake-sap, drake-similar, drake-lagged or drake-tamsi.
    #[arg(long, value_name = "NAME", default_value = "moreau-jean")]
    scheme: String,
    /// Time step h [s]; of event-driven the time between samples.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.001, allow_hyphen_values = true)]
    step: f64,
    /// Simulated time [s]; the scene's own if absent.
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    duration: Option<f64>,
    /// θ of moreau-jean and moreau-jean-projection, from 0 (explicit) over 1/2 (default) to 1 (implicit).
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    theta: Option<f64>,
    /// Restitution e of every pair, for the schemes that have one, in place of the scene's.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    restitution: Option<f64>,
    /// Whether e reverses the normal velocity only (normal-only, default) or the whole contact velocity (full-vector).
    #[arg(long, value_name = "RULE")]
    restitution_rule: Option<String>,
    /// Which contacts of moreau-jean are active: A (gap), B (half-step-forecast, default) or D (free-velocity-forecast).
    #[arg(long, value_name = "RULE")]
    activation: Option<String>,
    /// Friction directions of stewart-trinkle at spatial contacts.
    #[arg(long, value_name = "NUMBER")]
    friction_directions: Option<usize>,
    /// ρ of generalised-alpha, the share that a step keeps of infinitely stiff motion, from 0 to 1 (0.8).
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    spectral_radius: Option<f64>,
    /// Friction cone of mujoco in space: pyramidal (default) or elliptic.
    #[arg(long, value_name = "NAME")]
    cone: Option<String>,
    /// solref of mujoco: time constant [s] and damping ratio, or −stiffness [1/s²] and −damping [1/s].
    #[arg(long, value_name = "A,B", value_delimiter = ',', allow_hyphen_values = true)]
    solref: Option<Vec<f64>>,
    /// solimp of mujoco: impedance at the surface and beyond the width, width [m], midpoint, power.
    #[arg(long, value_name = "D0,DW,WIDTH,MID,POWER", value_delimiter = ',')]
    solimp: Option<Vec<f64>>,
    /// impratio of mujoco, normal over tangential regularisation.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    impratio: Option<f64>,
    /// margin of mujoco: gap below which a contact is active [m].
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    margin: Option<f64>,
    #[command(flatten)]
    drake: DrakeOptions,
    /// Who solves the contact problems.
    #[arg(long, value_name = "NAME", default_value = "auto", help = super::solve::solver_help())]
    solver: String,
    /// Write the motion to this file, a trajectory/1.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draw position, velocity and energy into this SVG file.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// List the scenes, schemes and solvers there are.
    #[arg(long)]
    list: bool,
    /// How to write the summary.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The schemes whose impacts use e.
const RESTITUTING: [&str; 9] = [
    "moreau-jean",
    "moreau-jean-projection",
    "schatzman-paoli",
    "generalised-alpha",
    "chrono",
    "bullet",
    "explicit-euler",
    "semi-implicit-euler",
    "runge-kutta-flip",
];

const EXAMPLES: &str = "\
Examples:
  moreau simulate --list
  moreau simulate --scene bouncing-ball --step 0.01 --plot ball.svg
  moreau simulate --scene bouncing-ball --theta 1 --activation D --restitution 0.8 --duration 5
  moreau simulate --scene incline-stick --scheme mujoco --cone elliptic --impratio 10
  moreau simulate --scene incline-slide --scheme anitescu --out slide.json --format json
  moreau simulate --scene my-scene.json --scheme stewart-trinkle";

/// What was simulated, for the summary.
#[derive(Serialize)]
struct Summary<'a> {
    scene: &'a str,
    scheme: &'a str,
    solver: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'static str>,
    closed_form: Option<&'static str>,
    quantities: Vec<Quantity>,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    match &arguments.scene {
        Some(scene) if !arguments.list => simulate(arguments, scene)?,
        _ => list(arguments.format)?,
    }
    Ok(Answer::Yes)
}

fn simulate(arguments: &Arguments, scene: &str) -> Result<()> {
    let scheme = arguments.build_scheme()?;
    arguments.keep_files(scene)?;
    let solver = solvers::by_name(&arguments.solver).map_err(|error| Error::Unsupported(format!("--solver: {error}")))?;
    let (staged, scene, note) = match scenes::linkage(scene) {
        Some(linkage) => (arguments.build_linkage(linkage)?, None, None),
        None => {
            let (scene, note) = arguments.build_scene(scene, scheme.as_ref())?;
            (arguments.stage(&scene)?, Some(scene), note)
        }
    };
    let steps = count_steps(staged.duration, arguments.step)?;
    let mechanism = staged.mechanism.as_ref();
    let recording = schemes::simulate(scheme.as_ref(), solver.as_ref(), mechanism, staged.start, arguments.step, steps)?;
    finite(&recording)?;
    let exact = staged.exact;
    let motion = Motion { mechanism, recording: &recording, exact: exact.as_ref(), gravity: staged.gravity };
    write(arguments, &motion, scene.as_ref(), solver.name())?;
    let summary = Summary {
        scene: &staged.name,
        scheme: &recording.scheme,
        solver: solver.name(),
        note,
        closed_form: exact.as_ref().map(ExactMotion::law),
        quantities: motion.summary(),
    };
    print(&match arguments.format {
        Format::Text => summary.text(),
        Format::Json => pretty(&summary)?,
    })
}

/// Writes the trajectory and the picture, both or none; a linkage has no trajectory.
fn write(arguments: &Arguments, motion: &Motion, scene: Option<&Scene>, solver: &str) -> Result<()> {
    let title = format!("{}, {}, h = {} s", motion.recording.mechanism, motion.recording.scheme, motion.recording.time_step);
    let mut files: Vec<(&Path, String)> = Vec::new();
    if let Some(file) = &arguments.plot {
        files.push((file, plot::svg(&title, &motion.panels())?));
    }
    if let (Some(file), Some(scene)) = (&arguments.out, scene) {
        let engine = Engine::ours(&motion.recording.scheme, solver);
        files.push((file, Trajectory::from_recording(motion.recording, motion.mechanism, scene, engine)?.to_json()?));
    }
    let files: Vec<(&Path, &[u8])> = files.iter().map(|(file, text)| (*file, text.as_bytes())).collect();
    write_together(&files)
}

impl Arguments {
    /// Neither result may go over the scene or over the other one.
    fn keep_files(&self, scene: &str) -> Result<()> {
        for (option, file) in [("--out", &self.out), ("--plot", &self.plot)] {
            keep_input(Path::new(scene), option, file.as_deref())?;
        }
        match (&self.out, &self.plot) {
            (Some(out), Some(plot)) if is_same_file(out, plot) => {
                Err(Error::invalid("--plot", "is the file of --out", "give each its own file"))
            }
            _ => Ok(()),
        }
    }

    fn build_scheme(&self) -> Result<Box<dyn Scheme>> {
        let own = [
            ("--theta", self.theta.is_some(), &["moreau-jean", "moreau-jean-projection"][..]),
            ("--restitution", self.restitution.is_some(), &RESTITUTING),
            ("--restitution-rule", self.restitution_rule.is_some(), &["moreau-jean"]),
            ("--activation", self.activation.is_some(), &["moreau-jean"]),
            ("--spectral-radius", self.spectral_radius.is_some(), &["generalised-alpha"]),
            ("--friction-directions", self.friction_directions.is_some(), &["stewart-trinkle"]),
            ("--cone", self.cone.is_some(), &["mujoco"]),
            ("--solref", self.solref.is_some(), &["mujoco"]),
            ("--solimp", self.solimp.is_some(), &["mujoco"]),
            ("--impratio", self.impratio.is_some(), &["mujoco"]),
            ("--margin", self.margin.is_some(), &["mujoco"]),
        ];
        if !schemes::NAMES.contains(&self.scheme.as_str()) {
            let known = format!("use one of {}", schemes::NAMES.join(", "));
            return Err(Error::invalid(
                "--scheme",
                format!("`{}` is unknown", self.scheme),
                suggestion(&self.scheme, schemes::NAMES, &known),
            ));
        }
        if let Some((option, _, owners)) = own.into_iter().find(|(_, given, owners)| *given && !owners.contains(&self.scheme.as_str())) {
            return Err(Error::invalid(
                option,
                format!("does nothing in {}", self.scheme),
                format!("it belongs to {}", owners.join(" and ")),
            ));
        }
        let drake = self.drake.material(&self.scheme)?;
        let default = Parameters::default();
        let parameters = Parameters {
            theta: self.theta.unwrap_or(default.theta),
            activation: self.activation.as_deref().map_or(Ok(default.activation), activation)?,
            restitution: self.restitution_rule.as_deref().map_or(Ok(default.restitution), RestitutionRule::by_name).map_err(option)?,
            directions: self.friction_directions.unwrap_or(default.directions),
            spectral_radius: self.spectral_radius.unwrap_or(default.spectral_radius),
            mujoco: self.mujoco()?,
            drake,
        };
        schemes::by_name(&self.scheme, parameters).map_err(option)
    }

    /// The scene's mechanism. How soft a body rests depends on the number of its contact points, which is that of the body in space.
    fn stage(&self, scene: &Scene) -> Result<Staged> {
        let staged = scene.staged()?;
        if self.scheme != "mujoco" {
            return Ok(staged);
        }
        let (mechanism, start) = scene.spatial_mechanism()?;
        Ok(Staged { mechanism, start, exact: None, ..staged })
    }

    /// Cone and softness of mujoco.
    fn mujoco(&self) -> Result<Mujoco> {
        let softness = Softness::default();
        Ok(Mujoco {
            cone: self.cone.as_deref().map_or(Ok(Cone::default()), Cone::by_name).map_err(option)?,
            softness: Softness {
                reference: self.solref.as_deref().map_or(Ok(softness.reference), |given| numbers("--solref", given))?,
                impedance: self.solimp.as_deref().map_or(Ok(softness.impedance), |given| numbers("--solimp", given))?,
                impedance_ratio: self.impratio.unwrap_or(softness.impedance_ratio),
                margin: self.margin.unwrap_or(softness.margin),
                ..softness
            },
        })
    }

    /// The linkage with the options applied.
    fn build_linkage(&self, linkage: &Linkage) -> Result<Staged> {
        if self.out.is_some() {
            let problem = format!("cannot hold {}", linkage.name);
            return Err(Error::invalid(
                "--out",
                problem,
                "a trajectory/1 repeats its scene/1, which has no hinges; use --plot or --format json",
            ));
        }
        if self.restitution.is_some() {
            let problem = format!("is fixed in {}", linkage.name);
            return Err(Error::invalid("--restitution", problem, "give it to a scene of bodies"));
        }
        let staged = linkage.staged()?;
        let duration = self.duration.map_or(Ok(staged.duration), |duration| positive("--duration", duration))?;
        Ok(Staged { duration, ..staged })
    }

    /// The scene with the options applied, and what has to be said about it.
    fn build_scene(&self, name: &str, scheme: &dyn Scheme) -> Result<(Scene, Option<&'static str>)> {
        let mut scene = find(name, "--scene")?;
        if let Some(duration) = self.duration {
            scene.duration = positive("--duration", duration)?;
        }
        if let Some(value) = self.restitution.filter(|e| !(0.0..=1.0).contains(e)) {
            return Err(Error::invalid("--restitution", format!("is {value}"), "use a number from 0 to 1"));
        }
        let bounces =
            scene.material.restitution != 0.0 || scene.material.pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e != 0.0));
        let plastic = !scheme.has_restitution() && bounces;
        if let Some(restitution) = if plastic { Some(0.0) } else { self.restitution } {
            scene.material.restitution = restitution;
            scene.material.pairs.iter_mut().for_each(|pair| pair.restitution = None);
        }
        let note = if self.scheme == "mujoco" {
            "soft contact has no restitution: how far a body bounces follows from solref and solimp, not from the scene's e"
        } else {
            "this scheme has no restitution: every impact is plastic, e = 0 in place of the scene's"
        };
        Ok((scene, plastic.then_some(note)))
    }
}

/// As many numbers as there have to be.
fn numbers<const N: usize>(field: &str, given: &[f64]) -> Result<[f64; N]> {
    given
        .try_into()
        .map_err(|_| Error::invalid(field, format!("has {} numbers", given.len()), format!("give {N}, with commas between them")))
}

/// A rule by its letter or its name.
fn activation(name: &str) -> Result<Activation> {
    match name {
        "A" => Ok(Activation::Gap),
        "B" => Ok(Activation::HalfStepForecast),
        "D" => Ok(Activation::FreeVelocityForecast),
        "C" => Err(Error::invalid("--activation", "is C, under which a resting body sinks", "use A, B or D")),
        _ => Activation::by_name(name).map_err(option),
    }
}

/// The error with the field spelt as the option it came from.
fn option(error: Error) -> Error {
    match error {
        Error::Invalid { field, problem, cure } if field == "directions" => {
            Error::Invalid { field: "--friction-directions".into(), problem, cure }
        }
        Error::Invalid { field, problem, cure } => Error::Invalid { field: format!("--{}", field.replace([' ', '_'], "-")), problem, cure },
        other => other,
    }
}

impl Summary<'_> {
    fn text(&self) -> String {
        let note = self.note.map(|note| format!("note: {note}\n")).unwrap_or_default();
        let form = self.closed_form.unwrap_or("none for this scene");
        format!(
            "scene {}\nscheme {}, solver {}\nclosed form: {form}\n{note}{}",
            self.scene,
            self.scheme,
            self.solver,
            lines(&self.quantities)
        )
    }
}

fn list(format: Format) -> Result<()> {
    let bodies = scenes::NAMES.into_iter().map(scenes::named).collect::<Result<Vec<_>>>()?;
    let bodies = bodies.into_iter().map(|scene| (scene.name, scene.description));
    let linkages = scenes::LINKAGES.iter().map(|linkage| (linkage.name.to_string(), linkage.description.to_string()));
    let scenes: Vec<_> = bodies.chain(linkages).collect();
    if format == Format::Json {
        let entry = |(name, description): &(String, String)| serde_json::json!({"name": name, "description": description});
        let described: Vec<_> = scenes.iter().map(entry).collect();
        return print(&pretty(&serde_json::json!({"scenes": described, "schemes": schemes::NAMES, "solvers": solvers::NAMES}))?);
    }
    let described: String = scenes.iter().map(|(name, description)| format!("  {name:16} {description}\n")).collect();
    print(&format!("scenes\n{described}schemes\n  {}\nsolvers\n  {}\n", schemes::NAMES.join("\n  "), solvers::NAMES.join("\n  ")))
}
