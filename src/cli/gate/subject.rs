//! What `moreau gate` judges: a program, or stored trajectories.

use super::Arguments;
use crate::cli::output::print_aside;
use crate::cli::time_limit::of_reply;
use crate::gate::audit::{AUDITS, audit};
use crate::gate::baseline::Baseline;
use crate::gate::library::{LACKS_SAMPLES, Library, NOT_STORED, read_description};
use crate::gate::process::{Limits, ProcessEngine, end_engines_on_interrupt};
use crate::gate::{CheckOutcome, Engine, Report, StepOutcome, Verdict};
use crate::number::{counted, significant};
use crate::trajectory::Trajectory;
use crate::{Error, Result};
use std::path::Path;

/// Makes engines for the workers.
pub fn maker(arguments: &Arguments) -> Result<Box<dyn Fn() -> Box<dyn Engine> + Sync>> {
    if !arguments.trajectory.is_empty() {
        let description = arguments.description.as_deref().map(read_description).transpose()?;
        let library = Library::read(&arguments.trajectory, description)?;
        return Ok(Box::new(move || Box::new(library.clone())));
    }
    let reply = of_reply("--time-limit", arguments.time_limit)?;
    let start = arguments.start_limit.map_or(Ok(reply), |limit| of_reply("--start-limit", limit))?;
    let limits = Limits { reply, start, ..Limits::default() };
    end_engines_on_interrupt()?;
    let command = arguments.command.clone();
    Ok(Box::new(move || Box::new(ProcessEngine::new(command.clone(), limits))))
}

/// Refuses a description without the motions that it goes with: a program describes itself.
pub fn require_motions(arguments: &Arguments) -> Result<()> {
    if arguments.description.is_none() || !arguments.trajectory.is_empty() {
        return Ok(());
    }
    let cure = "leave it out, for a program describes itself; or give the motions that it goes with: --trajectory FILE";
    Err(Error::invalid("--description", "is given without --trajectory", cure))
}

/// The name of the audit of a stored trajectory.
pub fn audit_name(file: &Path) -> String {
    format!("{AUDITS}{}", file.file_stem().unwrap_or_default().to_string_lossy())
}

/// The report of a run on stored trajectories: the checks whose scene is stored, and the audit of every file. Other checks are left out,
/// but where `--only` or `--require` asks for them or the baseline has them.
pub fn audited(arguments: &Arguments, mut report: Report, baseline: Option<&Baseline>) -> Result<Report> {
    if arguments.trajectory.is_empty() {
        return Ok(report);
    }
    let all_are_asked = !arguments.only.is_empty() || arguments.require.is_some();
    let is_held = |name: &str| baseline.is_some_and(|baseline| baseline.checks.iter().any(|check| check.name == name));
    report.checks.iter().filter_map(lacking).for_each(|remark| print_aside(&remark));
    report.checks.iter().filter_map(partly).for_each(|remark| print_aside(&remark));
    report.checks.retain(|check| check.verdict != Verdict::Unsupported || all_are_asked || is_held(&check.check));
    if report.checks.iter().all(|check| check.verdict == Verdict::Unsupported) {
        print_aside("remark: no check of the gate is answered by these motions, so that they are audited alone; see --write-scenes\n");
    }
    for file in &arguments.trajectory {
        let name = audit_name(file);
        let trajectory = Trajectory::read(file)?;
        if let Some(remark) = cut(&trajectory) {
            print_aside(&format!("remark: {}: {remark}\n", file.display()));
        }
        report.checks.push(audit(&name, &trajectory, &report.engine));
    }
    Ok(report)
}

/// That a check is left out though a motion is of its scene: a time that is written wrongly would pass.
fn lacking(check: &CheckOutcome) -> Option<String> {
    let mut reasons = check.steps.iter().filter_map(|step| step.reason.as_deref());
    let reason = reasons.find(|reason| reason.starts_with(LACKS_SAMPLES)).filter(|_| check.verdict == Verdict::Unsupported)?;
    Some(format!("remark: {} is not answered: {reason}\n", check.check))
}

/// That a check is answered at some of the time steps only: one that fails elsewhere would pass.
fn partly(check: &CheckOutcome) -> Option<String> {
    let is_missing = |step: &&StepOutcome| {
        let begins = |reason: &str| reason.starts_with(NOT_STORED) || reason.starts_with(LACKS_SAMPLES);
        step.verdict == Verdict::Unsupported && step.reason.as_deref().is_some_and(begins)
    };
    let (missing, answered): (Vec<&StepOutcome>, Vec<&StepOutcome>) = check.steps.iter().partition(is_missing);
    let told = |steps: &[&StepOutcome]| steps.iter().filter_map(|step| step.time_step).map(significant).collect::<Vec<_>>().join(", ");
    let is_partly = !missing.is_empty() && answered.iter().any(|step| step.verdict != Verdict::Unsupported);
    is_partly.then(|| {
        let (missing, answered) = (told(&missing), told(&answered));
        format!("remark: {} is answered at h = {answered} s only; no motion answers it at h = {missing} s\n", check.check)
    })
}

/// That a program answers checks at some of the time steps only: one that fails elsewhere would pass.
pub fn partly_answered(report: &Report) -> Option<String> {
    let is_missing = |step: &&StepOutcome| step.verdict == Verdict::Unsupported;
    let is_partly = |check: &&CheckOutcome| {
        let missing = check.steps.iter().filter(is_missing).count();
        0 < missing && missing < check.steps.len()
    };
    let partly: Vec<&CheckOutcome> = report.checks.iter().filter(is_partly).collect();
    let first = partly.first()?;
    let step = first.steps.iter().find(is_missing)?;
    let at = step.time_step.map_or(String::new(), |h| format!(" at h = {} s", significant(h)));
    let (count, reason) = (counted(partly.len(), "check"), step.reason.as_deref().unwrap_or("no reason is given"));
    Some(format!("remark: answered at some of the time steps only: {count}, such as {}, not{at}: {reason}\n", first.check))
}

/// That a motion ends before its scene does, and why where its producer says so: what is missing no check sees.
fn cut(trajectory: &Trajectory) -> Option<String> {
    let Trajectory { times, scene, time_step, engine, .. } = trajectory;
    let end = *times.last()?;
    // the last sample of a whole motion is at most one interval before its end
    let interval = times.windows(2).last().map_or(0.0, |last| last[1] - last[0]);
    let told = engine.options.get("cut");
    if told.is_none() && scene.duration - end <= interval.max(*time_step) {
        return None;
    }
    let number = |key: &str| told.and_then(|cut| cut.get(key)).and_then(serde_json::Value::as_u64);
    let is_broken = told.is_some_and(|cut| cut.get("cause").is_some());
    let why = match (number("step"), number("of")) {
        (Some(step), Some(of)) if is_broken => format!(": step {step} of {of} could not be made by `moreau simulate`"),
        (Some(step), Some(of)) => format!(": the time limit of `moreau simulate` ended it in step {step} of {of}"),
        _ => String::new(),
    };
    let [end, duration] = [end, scene.duration].map(significant);
    Some(format!(
        "the motion is cut, it ends at t = {end} s of {duration} s{why}; what it has is audited, and checks that need more are not answered"
    ))
}
