//! `moreau compare`: one scene through several schemes, beside each other.

use super::asked::Asked;
use super::certificate_options::CertificateOptions;
use super::limits::CommonOptions;
use super::near::suggestion;
use super::number::seconds;
use super::output::{keep_input, print, print_aside, require_svg, style};
use super::progress;
use super::scene::{Steps, count_steps, find, positive, stage};
use super::solver_table::check_name;
use super::{Answer, Format};
use crate::files::write_together;
use crate::number::significant;
use crate::report::comparison::{Comparison, SchemeOutcome, overlaid};
use crate::report::json::pretty;
use crate::report::motion::MotionReport;
use crate::report::plot;
use crate::report::steps::StepSummary;
use crate::scenes::{self, ExactMotion, Staged};
use crate::schemes::{self, Certified, SchemeParameters};
use crate::solvers;
use crate::trajectory::Recording;
use crate::{Error, Result};
use moreau_replicas::staging::plastic_if_needed;
use std::path::{Path, PathBuf};

/// Run a scene through several schemes and compare what they make of it.
///
/// The table tells penetration, energy, effective restitution, creep and settling time per scheme; the picture lays position,
/// velocity and energy of all of them over the closed form, where the scene has one. A scheme that cannot run the scene is
/// reported as unsupported with its reason, and the others go on; if none could run the answer is no (exit code 1). Every step is
/// certified: a scheme with rejected steps is named below the table, and the exit code is 1 unless `--accept-rejected` is given;
/// what is unconverged by declaration, as `simulate` has it, does not count.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A built-in scene or a file scene/1; `moreau simulate --list` names them.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The schemes, with commas between them; all of them if absent.
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    schemes: Vec<String>,
    /// Time step h [s], also as a fraction such as 1/240.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.001, value_parser = seconds, allow_hyphen_values = true)]
    step: f64,
    /// Simulated time [s]; the scene's own if absent. The motion is made of whole steps: where they do not fit, the nearest number of
    /// them is made, and a remark says when the motion ends. A time shorter than a step is refused.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    duration: Option<f64>,
    /// The solver of the contact problems.
    #[arg(long, value_name = "NAME", default_value = "auto", help = super::solver_table::names(), long_help = super::solver_table::table())]
    solver: String,
    #[command(flatten)]
    certificate: CertificateOptions,
    /// Draw the motions over each other into this SVG file.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau compare bouncing-ball --step 0.01
  moreau compare incline-slide --schemes moreau-jean,stewart-trinkle,anitescu --step 0.005 --plot slide.svg
  moreau compare my-scene.json --schemes moreau-jean,semi-implicit-euler --format json";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.common.apply()?;
    let names = arguments.names()?;
    keep_input(Path::new(&arguments.scene), "--plot", arguments.plot.as_deref())?;
    require_svg("--plot", arguments.plot.as_deref())?;
    check_name(&arguments.solver)?;
    let solver = arguments.certificate.asked(solvers::ALL.by_name(&arguments.solver)?);
    let duration = arguments.duration.map(|duration| positive("--duration", duration)).transpose()?;
    let staged = stage(&arguments.scene, "SCENE", "")?;
    let duration = duration.unwrap_or(staged.duration);
    let Steps { count: steps, lasts: duration, remark } = count_steps(duration, arguments.step)?;
    let asked = Asked::new(solver.as_ref());
    let certified = arguments.certificate.certified(&asked)?;
    let run = |name: &str| Run::simulate(&arguments.scene, name, &certified, arguments.step, steps);
    let bar = progress::parts(names.len(), "schemes");
    let runs: Vec<_> = progress::shown(&bar, || names.iter().map(|name| (*name, run(name))).inspect(|_| bar.inc(1)).collect());
    let motions: Vec<_> = runs.iter().filter_map(|(name, run)| Some((*name, run.as_ref().ok()?.motion()))).collect();
    let outcome = |(name, run): &(&str, Result<Run>)| match run {
        Ok(run) => SchemeOutcome::ran(name, &run.motion().summary(), run.steps(), run.note),
        Err(error) => SchemeOutcome::refused(name, error.to_string()),
    };
    let comparison = Comparison {
        scene: staged.name.clone(),
        time_step: arguments.step,
        duration,
        solver: solver.name().into(),
        closed_form: staged.exact.as_ref().map(|exact| ExactMotion::law(exact).into()),
        form_has_restitution: staged.exact.as_ref().is_some_and(ExactMotion::has_restitution),
        schemes: runs.iter().map(outcome).collect(),
    };
    if let Some(file) = arguments.plot.as_deref().filter(|_| !motions.is_empty()) {
        let title = format!("{}, h = {} s", staged.name, significant(arguments.step));
        write_together(&[(file, plot::svg(&title, &overlaid(&motions))?.as_bytes())])?;
    }
    print(&match arguments.common.format {
        Format::Text => comparison.text(style()),
        Format::Json => pretty(&comparison)?,
    })?;
    remark.iter().for_each(|remark| print_aside(&format!("remark: {remark}\n")));
    let rejected = runs.iter().filter_map(|(_, run)| run.as_ref().ok()).any(|run| run.steps().rejected > 0);
    if motions.is_empty() {
        return Ok(Answer::No);
    }
    Ok(arguments.certificate.answer(rejected))
}

/// A scheme's motion and the mechanism that made it.
struct Run {
    staged: Staged,
    recording: Recording,
    /// What the scheme makes of the scene's restitution, where it has none.
    note: Option<&'static str>,
}

impl Run {
    fn simulate(scene: &str, name: &str, solver: &Certified, h: f64, steps: usize) -> Result<Self> {
        let staged = stage(scene, "SCENE", name)?;
        let scheme = schemes::by_name(name, SchemeParameters::default())?;
        let recording =
            schemes::simulate_certified(scheme.as_ref(), solver, staged.mechanism.as_ref(), staged.start.clone(), h, steps, |_| Ok(()))?;
        let scene = if scenes::linkage(scene).is_some() { None } else { Some(find(scene, "SCENE")?) };
        let note = scene.and_then(|scene| plastic_if_needed(scene, scheme.as_ref(), name, None).1);
        Ok(Run { staged, recording, note })
    }

    fn steps(&self) -> StepSummary {
        StepSummary::of(&self.recording, self.staged.mechanism.as_ref())
    }

    fn motion(&self) -> MotionReport<'_> {
        let Staged { mechanism, exact, gravity, .. } = &self.staged;
        MotionReport { mechanism: mechanism.as_ref(), recording: &self.recording, exact: exact.as_ref(), gravity: *gravity }
    }
}

impl Arguments {
    /// The schemes to run, each known and named once.
    fn names(&self) -> Result<Vec<&str>> {
        if self.schemes.is_empty() {
            return Ok(schemes::NAMES.to_vec());
        }
        for (k, name) in self.schemes.iter().enumerate() {
            if !schemes::NAMES.contains(&name.as_str()) {
                let known = format!("use some of {}", schemes::NAMES.join(", "));
                return Err(Error::invalid("--schemes", format!("`{name}` is unknown"), suggestion(name, schemes::NAMES, &known)));
            }
            if self.schemes[..k].contains(name) {
                return Err(Error::invalid("--schemes", format!("names {name} twice"), "name every scheme once"));
            }
        }
        Ok(self.schemes.iter().map(String::as_str).collect())
    }
}
