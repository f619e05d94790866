//! The checks, listed or explained.

use crate::checks::text::{Style, counted};
use crate::cli::near::suggestion;
use crate::cli::output::{print, style};
use crate::cli::{Answer, Format};
use crate::gate::{Check, Run, checks, planted};
use crate::report::json::pretty;
use crate::{Error, Result};
use serde::Serialize;

#[derive(Serialize)]
struct Entry {
    check: &'static str,
    level: crate::gate::Level,
    each_time_step: bool,
    question: &'static str,
    derivation: &'static str,
    source: &'static str,
    passed_by: &'static str,
    failed_by: Vec<&'static str>,
}

impl From<&Check> for Entry {
    fn from(check: &Check) -> Self {
        let mut failed_by = vec![check.control.fails];
        let others = planted::all().filter(|planted| planted.subject.caught_by.contains(&check.name)).map(|planted| planted.name);
        failed_by.extend(others.filter(|name| *name != check.control.fails));
        Entry {
            check: check.name,
            level: check.level,
            each_time_step: matches!(check.run, Run::EachStep(_)),
            question: check.question,
            derivation: check.derivation,
            source: check.source,
            passed_by: check.control.passes,
            failed_by,
        }
    }
}

/// One line per check.
pub fn list(checks: &[&'static Check], format: Format) -> Result<Answer> {
    print(&match format {
        Format::Text => listed(checks, style()),
        Format::Json => pretty(&checks.iter().map(|&check| Entry::from(check)).collect::<Vec<_>>())?,
    })?;
    Ok(Answer::Yes)
}

fn listed(checks: &[&'static Check], style: Style) -> String {
    let width = checks.iter().map(|check| check.name.len()).max().unwrap_or(0);
    let next = " ".repeat(width + 2);
    let line = |check: &&Check| style.wrapped("", &next, &format!("{:width$}  {}", check.name, check.question)) + "\n";
    let lines: String = checks.iter().map(line).collect();
    let count = counted(checks.len(), "check");
    let more = format!("{count}. `moreau gate --explain CHECK` explains one: question, derivation, source, control.");
    format!("{lines}\n{}\n", style.wrapped("", "", &more))
}

/// One check in full.
pub fn explain(name: &str, format: Format) -> Result<Answer> {
    let check = checks::find(name).ok_or_else(|| {
        let cure = suggestion(name, checks::all().map(|check| check.name), "`moreau gate --list` shows every check");
        Error::Unsupported(format!("no check `{name}`; {cure}"))
    })?;
    let entry = Entry::from(check);
    print(&match format {
        Format::Text => explained(&entry, style()),
        Format::Json => pretty(&entry)?,
    })?;
    Ok(Answer::Yes)
}

fn explained(entry: &Entry, style: Style) -> String {
    let failed_by = entry.failed_by.join(", ");
    let parts = [
        ("Question", entry.question),
        ("Derivation", entry.derivation),
        ("Source", entry.source),
        ("Passed by", entry.passed_by),
        ("Failed by", failed_by.as_str()),
    ];
    let part = |(name, text): (&str, &str)| format!("\n{}\n", style.wrapped("", "  ", &format!("{}: {text}", style.heading(name))));
    format!("{}\n{}", style.heading(entry.check), parts.map(part).concat())
}
