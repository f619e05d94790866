//! `moreau simulate`: a scene through a scheme, with numbers, a file and a picture.

use super::asked::Asked;
use super::certificate_options::CertificateOptions;
use super::dump_options::DumpOptions;
use super::limits::CommonOptions;
use super::number::{self, seconds};
use super::output::{keep_files, no_answer, print, print_aside, require_svg, style};
use super::outputs::{self, HTML, JSON};
use super::progress;
use super::scene::{Steps, count_steps, find, in_scene, positive};
use super::scheme_options::SchemeOptions;
use super::solver_table::{self, check_name};
use super::{Answer, Format, time_limit};
use crate::files::write_together;
use crate::number::counted;
use crate::report::deepest;
use crate::report::json::pretty;
use crate::report::motion::MotionReport;
use crate::report::motion_page::MotionPage;
use crate::report::no_answer::NoAnswer;
use crate::report::plot;
use crate::report::steps::StepSummary;
use crate::report::summary::{Cut, MotionSummary};
use crate::scenes::{self, ExactMotion, Linkage, Scene, Staged};
use crate::schemes::{self, Scheme, Step};
use crate::solvers::watch::watched;
use crate::trajectory::{Producer, Recording, Trajectory};
use crate::{Error, Result, solvers};
use moreau_replicas::staging::{for_scheme, plastic_if_needed};
use std::path::{Path, PathBuf};

/// Simulate a scene with a scheme: summary, trajectory/1 and a picture.
///
/// Every step's contact problem is certified, and the summary says how many answers were rejected: then the exit code is 1.
/// Where scheme or solver is a declared number of sweeps (bullet, xpbd, pbd, sequential-impulses, gauss-pgs), which promises no solution,
/// rejected answers are counted as “unconverged by declaration”, and the exit code is 0.
/// The summary tells penetration, energy, restitution, rest and creep with units, and the distance from the closed
/// form where the scene has one; what rounding alone can make of a number is shown as 0. The picture shows position, velocity and energy
/// over time, with the closed form beneath. A penetration that is deep for the size of the body is remarked on.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A built-in scene or a file scene/1.
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "list")]
    scene: Option<String>,
    /// The time-stepping scheme: moreau-jean, moreau-jean-projection, schatzman-paoli, generalised-alpha, stewart-trinkle, anitescu,
    /// chrono, bullet, mujoco, explicit-euler, semi-implicit-euler, runge-kutta-flip, event-driven, variational, xpbd, pbd, drake-sap,
    /// drake-similar, drake-lagged or drake-tamsi.
    #[arg(long, value_name = "NAME", default_value = "moreau-jean")]
    scheme: String,
    /// Time step h [s], also as a fraction such as 1/240; of event-driven the time between samples.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.001, value_parser = seconds, allow_hyphen_values = true)]
    step: f64,
    /// Simulated time [s]; the scene's own if absent. The motion is made of whole steps: where they do not fit, the nearest number of
    /// them is made, and a remark says when the motion ends. A time shorter than a step is refused.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    duration: Option<f64>,
    #[command(flatten)]
    options: SchemeOptions,
    /// The solver of the contact problems.
    #[arg(long, value_name = "NAME", help = default_solver(solver_table::names()), long_help = default_solver(solver_table::table()))]
    solver: Option<String>,
    #[command(flatten)]
    certificate: CertificateOptions,
    #[command(flatten)]
    dumps: DumpOptions,
    /// End the motion after this time of computing, all steps together: the steps made are kept and written, the one that is being made is
    /// left out and named, the exit code is 1, and the motion is marked as not reproducible. The time is looked at between steps and,
    /// within a step, where solvers look for `--time-limit` of `moreau solve`.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true)]
    time_limit: Option<f64>,
    /// Write the motion to this file, a trajectory/1.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draw position, velocity and energy into this SVG file.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Write the motion in space as one self-contained HTML page: a time slider, contacts and impulses, and the certificate of each step.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// List the scenes, schemes and solvers there are.
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau simulate --list
  moreau simulate --scene bouncing-ball --step 0.01 --plot ball.svg
  moreau simulate --scene box-stack --step 1/240 --html stack.html       then open stack.html in a browser
  moreau simulate --scene bouncing-ball --theta 1 --activation D --restitution 0.8 --duration 5
  moreau simulate --scene incline-stick --scheme mujoco --cone elliptic --impratio 10
  moreau simulate --scene rolling-sphere --scheme mujoco --integrator rk4 --torsional 0.01 --rolling 0.01
  moreau simulate --scene incline-slide --scheme anitescu --out slide.json --format json
  moreau simulate --scene my-scene.json --scheme stewart-trinkle
  moreau simulate --scene my-scene.json --dump-rejected rejected
  moreau simulate --scene box-stack --dump-step 40 step40.json

Exit code 1: the certificate rejects a step, a step has no answer, as where the solver does not take the
problems of the scheme, or the time limit ended the motion; --accept-rejected makes the first a warning.
Of a motion that ends before its time the steps that were made are written, and the file says where and why.";

/// Who solves where nobody is named.
const DEFAULT_SOLVER: &str = "auto";

fn default_solver(help: String) -> String {
    format!("{help} [default: {DEFAULT_SOLVER}]")
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    match &arguments.scene {
        Some(scene) if !arguments.list => match simulate(arguments, scene) {
            Err(error) if arguments.common.format == Format::Json => no_answer(error, |failure| failure, false),
            answer => answer,
        },
        _ => list(arguments.common.format).map(|()| Answer::Yes),
    }
}

fn simulate(arguments: &Arguments, scene: &str) -> Result<Answer> {
    arguments.common.apply()?;
    time_limit::check(arguments.time_limit)?;
    let scheme = arguments.options.build(&arguments.scheme)?;
    arguments.keep_files(scene)?;
    let chosen = arguments.solver.as_deref().unwrap_or(DEFAULT_SOLVER);
    check_name(chosen)?;
    let named = arguments.certificate.asked(solvers::ALL.by_name(chosen)?);
    let solver = Asked::new(named.as_ref());
    let name = scene;
    let (staged, scene, note) = match scenes::linkage(name) {
        Some(linkage) => (arguments.build_linkage(linkage)?, None, None),
        None => {
            let (scene, note) = arguments.build_scene(name, scheme.as_ref())?;
            (for_scheme(&scene, &arguments.scheme).map_err(|error| in_scene(error, name))?, Some(scene), note)
        }
    };
    let Steps { count: steps, remark: ends, .. } = count_steps(staged.duration, arguments.step)?;
    let mechanism = staged.mechanism.as_ref();
    let certified = arguments.certificate.certified(&solver)?;
    let mut dumps = arguments.dumps.start(steps)?;
    let bar = progress::parts(steps, "steps");
    let mut touched = false;
    let observe = |step: &Step| {
        bar.inc(1);
        touched |= !step.impulses.is_empty();
        dumps.see(step)
    };
    let mut recording = Recording::new(mechanism.name(), scheme.name(), arguments.step, staged.start);
    let simulated = || schemes::record_certified(scheme.as_ref(), &certified, mechanism, &mut recording, steps, observe);
    let (ended, seen) = time_limit::within(arguments.time_limit, |over| progress::shown(&bar, || watched(over, simulated)));
    let cut = ended.as_ref().err().map(|error| Cut {
        step: recording.impulses.len() + 1,
        of: steps,
        time: recording.last().time - recording.samples[0].time,
        cause: (!seen.interrupted).then(|| error.to_string()),
    });
    let mut failed = ended.err().filter(|_| !seen.interrupted).map(|error| in_scene(error, name));
    if let Some(error) = failed.take_if(|error| recording.impulses.is_empty() || NoAnswer::of(error).is_none()) {
        // bad input, of which nothing is written, or nothing to write
        return Err(error);
    }
    if arguments.solver.is_some() && touched && !solver.was_asked() {
        let problem = format!("does nothing in {}, which has an iteration of its own", arguments.scheme);
        return Err(Error::invalid("--solver", problem, "leave it out, or choose a scheme that poses contact problems"));
    }
    let exact = staged.exact;
    let motion = MotionReport { mechanism, recording: &recording, exact: exact.as_ref(), gravity: staged.gravity };
    let summary = MotionSummary {
        scene: &staged.name,
        scheme: &recording.scheme,
        solver: named.name(),
        note,
        closed_form: exact.as_ref().map(ExactMotion::law),
        plastic_form: note.is_some() && exact.as_ref().is_some_and(ExactMotion::has_restitution),
        quantities: motion.summary(),
        remarks: ends.into_iter().chain(scene.iter().filter_map(|scene| deepest::remark(&recording, mechanism, scene))).collect(),
        steps: StepSummary::of(&recording, mechanism),
        reproducible: cut.as_ref().is_none_or(|cut| cut.cause.is_some()),
        cut,
    };
    write(arguments, &motion, scene.as_ref(), &summary)?;
    if let Some(error) = failed {
        if arguments.out.is_some() || arguments.plot.is_some() || arguments.html.is_some() {
            print_aside(&format!("{} made before are written\n", counted(recording.impulses.len(), "step")));
        }
        if let Some(wanted) = dumps.missing() {
            print_aside(&format!("--dump-step {wanted} wrote nothing: the motion ended before\n"));
        }
        if arguments.common.format == Format::Text {
            print(&summary.text(style()))?;
        }
        return Err(error);
    }
    print(&match arguments.common.format {
        Format::Text => summary.text(style()),
        Format::Json => pretty(&summary)?,
    })?;
    if arguments.common.format == Format::Text {
        summary.remarks.iter().for_each(|remark| print_aside(&format!("remark: {remark}\n")));
    }
    let judged = arguments.certificate.answer(summary.steps.rejected > 0);
    let Some(Cut { step, .. }) = summary.cut else { return Ok(judged) };
    print_aside(&format!("the time limit ended the motion in step {step}: exit code 1\n"));
    if let Some(wanted) = dumps.missing() {
        print_aside(&format!("--dump-step {wanted} wrote nothing: the motion was ended before\n"));
    }
    Ok(Answer::No)
}

/// Writes trajectory, picture and page, all or none; a linkage has a picture only.
fn write(arguments: &Arguments, motion: &MotionReport, scene: Option<&Scene>, summary: &MotionSummary) -> Result<()> {
    let title = format!("{}, {}, h = {} s", motion.recording.mechanism, motion.recording.scheme, motion.recording.time_step);
    let mut files: Vec<(&Path, String)> = Vec::new();
    if let Some(file) = &arguments.plot {
        files.push((file, plot::svg_with_note(&title, &motion.left_out(), &motion.panels())?));
    }
    if let (Some(file), Some(scene)) = (&arguments.out, scene) {
        let mut engine = Producer::ours(&motion.recording.scheme, summary.solver);
        if let Some(cut) = &summary.cut {
            engine.options.extend([("reproducible".into(), summary.reproducible.into()), ("cut".into(), serde_json::to_value(cut)?)]);
        }
        files.push((file, Trajectory::from_recording(motion.recording, motion.mechanism, scene, engine)?.to_json()?));
    }
    if let (Some(file), Some(scene)) = (&arguments.html, scene) {
        files.push((file, MotionPage { motion, scene, summary }.html()?));
    }
    let files: Vec<(&Path, &[u8])> = files.iter().map(|(file, text)| (*file, text.as_bytes())).collect();
    write_together(&files)
}

impl Arguments {
    /// No result may go over the scene or over another one.
    fn keep_files(&self, scene: &str) -> Result<()> {
        let all = [("--out", &self.out), ("--plot", &self.plot), ("--html", &self.html)];
        let mut outputs: Vec<_> = all.into_iter().filter_map(|(option, file)| Some((option, file.as_deref()?))).collect();
        let dumped = self.dumps.files();
        outputs.extend(dumped.iter().map(|file| ("--dump-step", file.as_path())));
        keep_files(&[Path::new(scene)], &outputs)?;
        require_svg("--plot", self.plot.as_deref())?;
        outputs::require("--out", self.out.as_deref(), JSON)?;
        outputs::require("--html", self.html.as_deref(), HTML)
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
        if self.html.is_some() {
            let problem = format!("cannot show {}", linkage.name);
            return Err(Error::invalid(
                "--html",
                problem,
                "the page draws the shapes of a scene/1, and a hinged link has none; use --plot",
            ));
        }
        if self.options.restitution()?.is_some() {
            let problem = format!("is fixed in {}", linkage.name);
            return Err(Error::invalid("--restitution", problem, "give it to a scene of bodies"));
        }
        let staged = linkage.staged()?;
        let duration = self.duration.map_or(Ok(staged.duration), |duration| positive("--duration", duration))?;
        Ok(Staged { duration, ..staged })
    }

    /// The scene with the options applied, and a note for the user if one is needed.
    fn build_scene(&self, name: &str, scheme: &dyn Scheme) -> Result<(Scene, Option<&'static str>)> {
        let mut scene = find(name, "--scene")?;
        if let Some(duration) = self.duration {
            scene.duration = positive("--duration", duration)?;
        }
        Ok(plastic_if_needed(scene, scheme, &self.scheme, self.options.restitution()?))
    }
}

/// What the list does not show.
const EXPLAINED: &str = "`moreau systems` says what each scheme is and how closely it agrees with its engine, `moreau solve --help` which \
                         laws a solver takes, `moreau verify --list --search NAME` what the chapter says of them.";

fn solver_names() -> Vec<&'static str> {
    solvers::ALL.names().collect()
}

fn list(format: Format) -> Result<()> {
    let bodies = scenes::NAMES.into_iter().map(scenes::named).collect::<Result<Vec<_>>>()?;
    let bodies = bodies.into_iter().map(|scene| (scene.name, scene.description));
    let linkages = scenes::LINKAGES.iter().map(|linkage| (linkage.name.to_string(), linkage.description.to_string()));
    let scenes: Vec<_> = bodies.chain(linkages).collect();
    if format == Format::Json {
        let entry = |(name, description): &(String, String)| serde_json::json!({"name": name, "description": description});
        let described: Vec<_> = scenes.iter().map(entry).collect();
        return print(&pretty(&serde_json::json!({"scenes": described, "schemes": schemes::NAMES, "solvers": solver_names()}))?);
    }
    let style = style();
    let line = |(name, description): &(String, String)| style.wrapped("  ", &" ".repeat(19), &format!("{name:16} {description}")) + "\n";
    let described: String = scenes.iter().map(line).collect();
    let (schemes, solvers) = (schemes::NAMES.join("\n  "), solver_names().join("\n  "));
    print(&format!("scenes\n{described}schemes\n  {schemes}\nsolvers\n  {solvers}\n\n{}\n", style.wrapped("", "", EXPLAINED)))
}
