//! `moreau gate`: any simulator through one set of checks.

mod arguments;
mod failures;
mod list;
mod scenes;
mod selection;
mod subject;

use super::output::{keep_files, print, print_aside, style};
use super::outputs::{self, HTML, JSON, JUNIT, TOML};
use super::{Answer, Format};
use crate::files::write_together;
use crate::gate::audit::AUDITS;
use crate::gate::baseline::{Baseline, Change, ChangeKind};
use crate::gate::conformance;
use crate::gate::runner::{self, Plan};
use crate::gate::{Check, CheckOutcome, Refusal, Report, Verdict};
use crate::number::counted;
use crate::report::gate::{junit, page, text};
use crate::report::json::pretty;
use crate::{Error, Result};
pub use arguments::Arguments;
use indicatif::{ProgressBar, ProgressStyle};
use jiff::Zoned;
use jiff::civil::Date;
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;

/// The exit code for an engine that could not be run.
pub const CANNOT_RUN: u8 = 3;

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let Some(name) = &arguments.explain {
        return list::explain(name, arguments.format);
    }
    if let Some(file) = &arguments.failures {
        return failures::write(file);
    }
    let checks = selection::checks(arguments)?;
    if arguments.list {
        return list::list(&checks, arguments.format);
    }
    let sweep = selection::sweep(arguments)?;
    if let Some(folder) = &arguments.write_scenes {
        return scenes::write(folder, &checks, &sweep, arguments.description.as_deref());
    }
    subject::require_motions(arguments)?;
    arguments.keep_files()?;
    arguments.keep_checks(&checks)?;
    let required = required(arguments.require)?;
    let baseline = arguments.baseline.as_deref().map(|file| baseline(arguments, file, &sweep, &checks)).transpose()?;
    let bar = progress();
    let today = Zoned::now().date();
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
    let watched = Mutex::new(Watched { times: BTreeMap::new(), written: Ok(()) });
    let watch = |report: &Report, name: &'static str, time: Duration| {
        let mut watched = watched.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        watched.times.insert(name.into(), time);
        if !std::io::stderr().is_terminal() {
            print_aside(&finished(report, name, time, watched.times.len()));
        }
        if watched.written.is_ok() && arguments.trajectory.is_empty() {
            let changes = baseline.as_ref().map(|baseline| baseline.compare(report, today)).transpose();
            watched.written = changes.and_then(|changes| arguments.write(report, changes.as_deref(), (&watched.times, today), false));
        }
    };
    let mut first = make();
    if let Some((baseline, file)) = baseline.as_ref().zip(arguments.baseline.as_deref()) {
        match first.describe(&plan.options) {
            Ok(description) => baseline.require_engine(&description.name).map_err(|error| error.in_file(file))?,
            Err(refusal) => return cannot_run(&refusal),
        }
    }
    let adapter = match arguments.trajectory[..] {
        [] => conformance::misreported(first.as_mut(), &plan.options),
        _ => Ok(Vec::new()),
    };
    drop(first);
    let adapter = match adapter {
        Ok(adapter) => adapter,
        Err(refusal) => return cannot_run(&refusal),
    };
    let answer = runner::run_watched(make.as_ref(), &plan, &watch);
    bar.finish_and_clear();
    let Watched { times, written } = watched.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    written?;
    let report = match answer {
        Ok(report) => Report { adapter, ..subject::audited(arguments, report, baseline.as_ref())? },
        Err(refusal) => return cannot_run(&refusal),
    };
    if arguments.trajectory.is_empty() {
        subject::partly_answered(&report).into_iter().for_each(|remark| print_aside(&remark));
    }
    for note in baseline.iter().flat_map(|baseline| baseline.notes(&report)) {
        print_aside(&format!("warning: {note}\n"));
    }
    let changes = baseline.map(|baseline| baseline.compare(&report, today)).transpose()?;
    arguments.write(&report, changes.as_deref(), (&times, today), true)?;
    arguments.show(&report, changes.as_deref())?;
    let is_fine = match &changes {
        Some(changes) => changes.iter().all(|change| change.kind != ChangeKind::Regression),
        None => !report.is_bad(),
    };
    Ok((is_enough(&report, required, arguments) && is_fine).into())
}

/// The baseline, if there is something in it to be compared with.
fn baseline(arguments: &Arguments, file: &Path, sweep: &[f64], checks: &[&Check]) -> Result<Baseline> {
    let baseline = Baseline::read(file)?;
    let audits: Vec<String> = arguments.trajectory.iter().map(|file| subject::audit_name(file)).collect();
    let names: Vec<&str> = checks.iter().map(|check| check.name).chain(audits.iter().map(String::as_str)).collect();
    baseline.require_run(sweep, &names).map_err(|error| error.in_file(file))?;
    Ok(baseline)
}

/// What is kept of a run while it goes on.
struct Watched {
    /// How long the measurements of each finished check took.
    times: BTreeMap<String, Duration>,
    /// Whether the reports could be written.
    written: Result<()>,
}

/// One line for a log.
fn finished(report: &Report, name: &str, time: Duration, count: usize) -> String {
    let verdict = report.checks.iter().find(|outcome| outcome.check == name).map_or("", |outcome| outcome.verdict.word());
    format!("{count}/{} {verdict} {name} ({:.1} s)\n", report.checks.len(), time.as_secs_f64())
}

/// --require, in percent.
fn required(percent: Option<f64>) -> Result<Option<f64>> {
    match percent {
        Some(percent) if !(0.0..=100.0).contains(&percent) => {
            Err(Error::invalid("--require", format!("is {percent}"), "use a number of percent from 0 to 100"))
        }
        other => Ok(other),
    }
}

/// Whether enough of the checks were answered; if not, it is told. A failure is an answer, too, where a baseline says whether it is
/// accepted and no part is required.
fn is_enough(report: &Report, required: Option<f64>, arguments: &Arguments) -> bool {
    // the audit of a file is none of the checks that were selected
    let counts = |check: &&CheckOutcome| arguments.only.is_empty() || !check.check.starts_with(AUDITS);
    let asked: Vec<&CheckOutcome> = report.checks.iter().filter(counts).collect();
    let is_compared = arguments.baseline.is_some() && required.is_none();
    let is_answer = |verdict: Verdict| matches!(verdict, Verdict::Pass | Verdict::Difference) || is_compared && verdict == Verdict::Fail;
    let answered = asked.iter().filter(|check| is_answer(check.verdict)).count();
    let count = asked.len();
    let is_enough = required.map_or(answered > 0, |percent| 100.0 * answered as f64 >= percent * count as f64);
    if !is_enough {
        let wanted = required.map_or("at least one is needed".to_string(), |percent| format!("--require asks for {percent} %"));
        let checks = counted(count, "check");
        let with = if is_compared { "pass, difference or fail" } else { "pass or difference" };
        print_aside(&format!("answered with {with}: {answered} of {checks}; {wanted}\n"));
    }
    is_enough
}

fn cannot_run(refusal: &Refusal) -> Result<Answer> {
    let (Refusal::Unsupported(why) | Refusal::Errored(why)) = refusal;
    print_aside(&format!("error: the engine could not be run: {why}; `moreau protocol-check -- PROGRAM` shows what it answers\n"));
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
        let inputs: Vec<&Path> = self.trajectory.iter().chain(&self.description).map(PathBuf::as_path).collect();
        keep_files(&inputs, &self.outputs().collect::<Vec<_>>())?;
        self.outputs().try_for_each(|(option, file)| {
            let content = match option {
                "--save-baseline" => TOML,
                "--junit" => JUNIT,
                "--html" => HTML,
                _ => JSON,
            };
            outputs::require(option, Some(file), content)
        })
    }

    /// Refuses to write a baseline of some checks over one that has others.
    fn keep_checks(&self, checks: &[&Check]) -> Result<()> {
        let Some(file) = self.save_baseline.as_deref().filter(|file| file.is_file()) else { return Ok(()) };
        let Ok(old) = Baseline::read(file) else {
            let problem = format!("is {}, which is there and is no baseline", file.display());
            return Err(Error::invalid("--save-baseline", problem, "take it away, or name another file"));
        };
        let left_out = |name: &&str| crate::gate::checks::find(name).is_some() && checks.iter().all(|check| check.name != *name);
        match old.checks.iter().map(|check| check.name.as_str()).find(left_out) {
            Some(name) => {
                let problem = format!("is {}, which has checks that this run leaves out, such as {name}", file.display());
                Err(Error::invalid("--save-baseline", problem, "run all of its checks, or name another file"))
            }
            None => Ok(()),
        }
    }

    /// Writes all named outputs, or none; a baseline only of a whole run.
    fn write(
        &self,
        report: &Report,
        changes: Option<&[Change]>,
        (times, day): (&BTreeMap<String, Duration>, Date),
        is_whole: bool,
    ) -> Result<()> {
        let mut texts = Vec::new();
        for (option, file) in self.outputs().filter(|(option, _)| is_whole || *option != "--save-baseline") {
            let text = match option {
                "--save-baseline" => self.new_baseline(report)?.to_toml()?,
                "--junit" => junit::xml(report, changes, times)?,
                "--html" => page::html(report, changes, day)?,
                _ => pretty(report)?,
            };
            texts.push((file, text));
        }
        let files: Vec<(&Path, &[u8])> = texts.iter().map(|(file, text)| (*file, text.as_bytes())).collect();
        write_together(&files)
    }

    /// The baseline of this run. It keeps the known issues of the file that it replaces.
    fn new_baseline(&self, report: &Report) -> Result<Baseline> {
        let mut baseline = Baseline::of(report);
        if let Some(old) = self.save_baseline.as_deref().filter(|file| file.is_file()) {
            baseline.known_issues = Baseline::read(old)?.known_issues;
        }
        Ok(baseline)
    }

    fn show(&self, report: &Report, changes: Option<&[Change]>) -> Result<()> {
        print(&match self.format {
            Format::Text => text::table(report, style()) + &changes.map(|changes| text::changes(changes, style())).unwrap_or_default(),
            Format::Json => pretty(&serde_json::json!({"report": report, "changes": changes}))?,
        })
    }
}
