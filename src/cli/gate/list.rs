//! The checks, listed or explained.

use crate::cli::near::suggestion;
use crate::cli::output::print;
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
    let width = checks.iter().map(|check| check.name.len()).max().unwrap_or(0);
    print(&match format {
        Format::Text => checks.iter().map(|check| format!("{:width$}  {}\n", check.name, check.question)).collect(),
        Format::Json => pretty(&checks.iter().map(|&check| Entry::from(check)).collect::<Vec<_>>())?,
    })?;
    Ok(Answer::Yes)
}

/// One check in full.
pub fn explain(name: &str, format: Format) -> Result<Answer> {
    let check = checks::find(name).ok_or_else(|| {
        let cure = suggestion(name, checks::all().map(|check| check.name), "`moreau gate --list` shows every check");
        Error::Unsupported(format!("no check `{name}`; {cure}"))
    })?;
    let entry = Entry::from(check);
    print(&match format {
        Format::Text => format!(
            "{}\n\nQuestion: {}\n\nDerivation: {}\n\nSource: {}\n\nPassed by: {}\nFailed by: {}\n",
            entry.check,
            entry.question,
            entry.derivation,
            entry.source,
            entry.passed_by,
            entry.failed_by.join(", ")
        ),
        Format::Json => pretty(&entry)?,
    })?;
    Ok(Answer::Yes)
}
