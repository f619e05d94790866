//! What `moreau gate` judges: a program, or stored trajectories.

use super::Arguments;
use crate::gate::audit::audit;
use crate::gate::library::{Library, read_description};
use crate::gate::process::{Limits, ProcessEngine, end_engines_on_interrupt};
use crate::gate::{Engine, Report, Verdict};
use crate::trajectory::Trajectory;
use crate::{Error, Result};
use std::time::Duration;

/// Makes engines for the workers.
pub fn maker(arguments: &Arguments) -> Result<Box<dyn Fn() -> Box<dyn Engine> + Sync>> {
    if !arguments.trajectory.is_empty() {
        let description = arguments.description.as_deref().map(read_description).transpose()?;
        let library = Library::read(&arguments.trajectory, description)?;
        return Ok(Box::new(move || Box::new(library.clone())));
    }
    let reply = seconds("--time-limit", arguments.time_limit)?;
    let start = arguments.start_limit.map_or(Ok(reply), |limit| seconds("--start-limit", limit))?;
    let limits = Limits { reply, start, ..Limits::default() };
    end_engines_on_interrupt()?;
    let command = arguments.command.clone();
    Ok(Box::new(move || Box::new(ProcessEngine::new(command.clone(), limits))))
}

fn seconds(option: &str, number: f64) -> Result<Duration> {
    let limit = Duration::try_from_secs_f64(number).ok().filter(|limit| !limit.is_zero());
    limit.ok_or_else(|| Error::invalid(option, format!("is {number}"), "use a positive number of seconds"))
}

/// The report of a run on stored trajectories: the checks whose scene is stored, and the audit of every file. Other checks are left out.
pub fn audited(arguments: &Arguments, mut report: Report) -> Result<Report> {
    if arguments.trajectory.is_empty() {
        return Ok(report);
    }
    report.checks.retain(|check| check.verdict != Verdict::Unsupported);
    for file in &arguments.trajectory {
        let name = format!("trajectory/{}", file.file_stem().unwrap_or_default().to_string_lossy());
        report.checks.push(audit(&name, &Trajectory::read(file)?, &report.engine));
    }
    Ok(report)
}
