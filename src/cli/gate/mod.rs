//! `moreau gate`: any simulator through one set of checks.

mod list;
mod scenes;
mod selection;
mod subject;

use super::output::{print, print_aside, style};
use super::{Answer, Format};
use crate::files::{is_same_file, write_together};
use crate::gate::baseline::{Baseline, Change, ChangeKind};
use crate::gate::runner::{self, Plan};
use crate::gate::{Refusal, Report};
use crate::report::gate::{junit, page, text};
use crate::report::json::pretty;
use crate::{Error, Result};
use indicatif::{ProgressBar, ProgressStyle};
use jiff::Zoned;
use std::path::{Path, PathBuf};

/// Judge a simulator: every check over a sweep of time steps, against its own model and against Coulomb–Signorini.
///
/// COMMAND is a program that speaks the protocol moreau-engine/1 (docs/protocol.md): JSON lines on standard input and
/// output. Each check gets a verdict: pass; difference (documented: as the engine's declared contact law predicts);
/// fail; unsupported, with the engine's reason; errored, with the cause.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The engine: a command with its arguments.
    #[arg(last = true, value_name = "COMMAND", required_unless_present_any = ["trajectory", "list", "explain", "write_scenes"])]
    command: Vec<String>,
    /// Judge stored trajectories instead of a program.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "command")]
    trajectory: Vec<PathBuf>,
    /// The description that goes with --trajectory, a JSON file as `describe` returns it; without it the engine is taken for rigid.
    #[arg(long, value_name = "FILE", requires = "trajectory")]
    description: Option<PathBuf>,
    /// Only the checks of contact solvers.
    #[arg(long, conflicts_with_all = ["trajectory", "projection"])]
    solver: bool,
    /// Only the checks of cone projections.
    #[arg(long, conflicts_with = "trajectory")]
    projection: bool,
    /// The quick sweep for CI: h = 1/60, 1/240 and 0.001 s.
    #[arg(long, conflicts_with = "steps")]
    quick: bool,
    /// The time steps of the sweep [s], such as 0.01,1/240.
    #[arg(long, value_name = "H,H,…", value_delimiter = ',')]
    steps: Vec<String>,
    /// Only checks whose name contains one of these.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Leave out checks whose name contains one of these.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    skip: Vec<String>,
    /// An option for the engine, sent with every request; the value is JSON, or a text.
    #[arg(long = "option", value_name = "NAME=VALUE")]
    options: Vec<String>,
    /// Engines that run at once; the report is the same for every number.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    jobs: usize,
    /// Measure this often, perturbed by 1e-9, for the spread of each value; 3 with --save-baseline, otherwise 1.
    #[arg(long, value_name = "NUMBER")]
    repeat: Option<usize>,
    /// Seconds an engine may take for one request.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, allow_hyphen_values = true)]
    time_limit: f64,
    /// Compare with this baseline: exit code 1 only for what is worse.
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// Store this run as a baseline.
    #[arg(long, value_name = "FILE")]
    save_baseline: Option<PathBuf>,
    /// Write the report as JUnit XML.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the report as one self-contained HTML page.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the report as JSON.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// List the checks.
    #[arg(long)]
    list: bool,
    /// Explain one check: question, derivation, control.
    #[arg(long, value_name = "CHECK")]
    explain: Option<String>,
    /// Write the scenes of the sweep into this folder, for simulators that are run elsewhere and judged with --trajectory.
    #[arg(long, value_name = "FOLDER")]
    write_scenes: Option<PathBuf>,
    /// How to write the report to standard output.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau gate --quick -- python3 my_engine.py
  moreau gate --html report.html --junit report.xml -- ./my-engine --stdio
  moreau gate --option cone=elliptic --option impratio=10 -- .venv/mujoco/bin/python scripts/engines/mujoco.py
  moreau gate --save-baseline engine.toml -- ./my-engine      then, in CI:
  moreau gate --baseline engine.toml -- ./my-engine
  moreau gate --quick -- moreau engine --scheme anitescu      our own scheme behind the same door
  moreau gate --explain ball/energy

Exit codes: 0 nothing is bad (or nothing worse than the baseline); 1 a check fails or errors, or a regression;
2 usage; 3 the engine could not be run.";

/// The exit code for an engine that could not be run.
pub const CANNOT_RUN: u8 = 3;

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let Some(name) = &arguments.explain {
        return list::explain(name, arguments.format);
    }
    let checks = selection::checks(arguments)?;
    if arguments.list {
        return list::list(&checks, arguments.format);
    }
    let sweep = selection::sweep(arguments)?;
    if let Some(folder) = &arguments.write_scenes {
        return scenes::write(folder, &checks, &sweep);
    }
    arguments.keep_files()?;
    let baseline = arguments.baseline.as_deref().map(Baseline::read).transpose()?;
    let bar = progress();
    let plan = Plan {
        checks,
        sweep,
        options: selection::options(arguments)?,
        jobs: positive("--jobs", arguments.jobs)?,
        repeats: positive("--repeat", arguments.repeat.unwrap_or(if arguments.save_baseline.is_some() { 3 } else { 1 }))?,
        progress: &|| bar.inc(1),
    };
    bar.set_length(plan.tasks() as u64);
    let make = subject::maker(arguments)?;
    let answer = runner::run(make.as_ref(), &plan);
    bar.finish_and_clear();
    let report = match answer {
        Ok(report) => subject::audited(arguments, report)?,
        Err(refusal) => return cannot_run(&refusal),
    };
    for note in baseline.iter().flat_map(|baseline| baseline.notes(&report)) {
        print_aside(&format!("warning: {note}\n"));
    }
    let changes = baseline.map(|baseline| baseline.compare(&report, Zoned::now().date())).transpose()?;
    arguments.write(&report, changes.as_deref())?;
    arguments.show(&report, changes.as_deref())?;
    Ok(match &changes {
        Some(changes) => changes.iter().all(|change| change.kind != ChangeKind::Regression).into(),
        None => (!report.is_bad()).into(),
    })
}

fn cannot_run(refusal: &Refusal) -> Result<Answer> {
    print_aside(&format!("error: the engine could not be run: {refusal}\n"));
    Ok(Answer::CannotRun)
}

fn positive(option: &str, number: usize) -> Result<usize> {
    if number == 0 {
        return Err(Error::invalid(option, "is 0", "use a whole number from 1"));
    }
    Ok(number)
}

/// Hidden unless standard error is a terminal.
fn progress() -> ProgressBar {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} measurements  {elapsed}") {
        bar.set_style(style);
    }
    bar
}

impl Arguments {
    /// Every named output, with its option.
    fn outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let all = [("--save-baseline", &self.save_baseline), ("--junit", &self.junit), ("--html", &self.html), ("--out", &self.out)];
        all.into_iter().filter_map(|(option, file)| file.as_deref().map(|file| (option, file)))
    }

    /// Refuses outputs that would write over an input or over each other. Saving a baseline over the one that is compared is allowed:
    /// it is read first, and that is how one tightens it.
    fn keep_files(&self) -> Result<()> {
        let outputs: Vec<_> = self.outputs().collect();
        for (k, (option, file)) in outputs.iter().enumerate() {
            let inputs = self.trajectory.iter().chain(&self.description);
            if let Some(input) = inputs.into_iter().find(|input| input.is_file() && is_same_file(input, file)) {
                return Err(Error::invalid(*option, format!("is {}, a file that is read", input.display()), "write to another file"));
            }
            if let Some((other, _)) = outputs[..k].iter().find(|(_, other)| is_same_file(other, file) || other == file) {
                return Err(Error::invalid(*option, format!("is the same file as {other}"), "write to another file"));
            }
        }
        Ok(())
    }

    /// Writes all named outputs, or none.
    fn write(&self, report: &Report, changes: Option<&[Change]>) -> Result<()> {
        let mut texts = Vec::new();
        for (option, file) in self.outputs() {
            let text = match option {
                "--save-baseline" => self.new_baseline(report)?.to_toml()?,
                "--junit" => junit::xml(report, changes)?,
                "--html" => page::html(report, changes)?,
                _ => pretty(report)?,
            };
            texts.push((file, text));
        }
        let files: Vec<(&Path, &[u8])> = texts.iter().map(|(file, text)| (*file, text.as_bytes())).collect();
        write_together(&files)
    }

    /// The baseline of this run; known issues that somebody wrote into the old file stay.
    fn new_baseline(&self, report: &Report) -> Result<Baseline> {
        let mut baseline = Baseline::of(report);
        if let Some(old) = self.save_baseline.as_deref().filter(|file| file.is_file()) {
            baseline.known_issues = Baseline::read(old)?.known_issues;
        }
        Ok(baseline)
    }

    fn show(&self, report: &Report, changes: Option<&[Change]>) -> Result<()> {
        print(&match self.format {
            Format::Text => text::table(report, style()) + &changes.map(text::changes).unwrap_or_default(),
            Format::Json => pretty(&serde_json::json!({"report": report, "changes": changes}))?,
        })
    }
}
