//! Causes: why an engine does not pass a check, found by experiment and written down beside the stored results.
//!
//! ```text
//!     every cell of the scoreboard that fails or errs has one cause; no other cell has one
//! ```
//! The files are TOML, one per family of engines, in `references/scoreboard/causes/`; `gate` and the verdicts never look at them.

use crate::checks;
use crate::scoreboard::Standing;
use moreau_contact::files::read_text;
use moreau_exact::{Error, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a difference from the ideal belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Component {
    /// The step's problem is not solved: iterations end early, or at a wrong point.
    Solver,
    /// The step's problem is not the one that the law and h demand.
    Discretisation,
    /// The law is another than the one declared.
    Model,
    /// Contact points, normals, gaps, or the moment at which they are found.
    Collision,
    /// What goes in or comes out: units, thresholds, reported impulses.
    Interface,
    /// Not established; the evidence says what was tried.
    Unknown,
}

impl Component {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Component::Solver => "solver",
            Component::Discretisation => "discretisation",
            Component::Model => "model",
            Component::Collision => "collision",
            Component::Interface => "interface",
            Component::Unknown => "unknown",
        }
    }
}

/// Why some checks are not passed by some configurations of an engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cause {
    /// Names of configurations.
    pub engines: Vec<String>,
    /// Names of checks.
    pub checks: Vec<String>,
    /// What it belongs to.
    pub error: Component,
    /// The mechanism.
    pub cause: String,
    /// The experiment that shows it, with its numbers.
    pub evidence: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    cause: Vec<Cause>,
}

/// Every cause of a folder, file by file in the order of their names; none if there is no folder.
///
/// # Errors
/// [`Error::Read`], or [`Error::Invalid`] with the file's name if it is not TOML of this form or names a check that does not exist.
pub fn read(folder: &Path) -> Result<Vec<Cause>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let unreadable = |source| Error::Read { file: folder.to_path_buf(), source };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?.collect::<std::io::Result<Vec<_>>>().map_err(unreadable)?;
    let mut files: Vec<_> =
        entries.into_iter().map(|entry| entry.path()).filter(|file| file.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    let causes = files.iter().map(|file| read_file(file)).collect::<Result<Vec<_>>>()?;
    Ok(causes.into_iter().flatten().collect())
}

fn read_file(file: &Path) -> Result<Vec<Cause>> {
    from_toml(&read_text(file)?).map_err(|error| error.in_file(file))
}

/// The causes in a text.
///
/// # Errors
/// [`Error::Invalid`] if it is not TOML of this form or names a check that does not exist.
///
/// ```
/// use moreau_gate::cause::{find, from_toml};
///
/// let causes = from_toml(
///     "[[cause]]\nengines = ['mine']\nchecks = ['stack/ten']\nerror = 'solver'\ncause = 'One sweep.'\nevidence = 'With 50 it passes.'",
/// )?;
/// assert_eq!(find(&causes, "mine", "stack/ten").map(|cause| cause.error.word()), Some("solver"));
/// assert!(find(&causes, "mine", "stack/five").is_none());
/// assert!(from_toml("[[cause]]\nengines = []\nchecks = ['no/check']\nerror = 'solver'\ncause = ''\nevidence = ''").is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn from_toml(text: &str) -> Result<Vec<Cause>> {
    let causes = toml::from_str::<File>(text)
        .map_err(|error| Error::invalid("the file", error.message().to_string(), "see the other files of the folder"))?
        .cause;
    match causes.iter().flat_map(|cause| &cause.checks).find(|name| checks::find(name).is_none()) {
        Some(name) => Err(Error::invalid("cause.checks", format!("there is no check `{name}`"), "see `moreau gate --list`")),
        None => Ok(causes),
    }
}

/// The cause of a cell.
pub fn find<'a>(causes: &'a [Cause], engine: &str, check: &str) -> Option<&'a Cause> {
    causes.iter().find(|cause| is_of(cause, engine, check))
}

/// Whether it is the cause of this cell.
pub fn is_of(cause: &Cause, engine: &str, check: &str) -> bool {
    let names = |list: &[String], name: &str| list.iter().any(|one| one == name);
    names(&cause.engines, engine) && names(&cause.checks, check)
}

/// One line for each failed or errored cell without a stored cause, for each cell with two causes, and for each cause of a cell that
/// neither fails nor errs.
pub fn misfits(causes: &[Cause], standings: &[Standing]) -> Vec<String> {
    let bad = |engine: &str, check: &str| {
        let report = standings.iter().find(|standing| standing.entry.name == engine)?.report.as_ref()?;
        Some(report.checks.iter().find(|outcome| outcome.check == check)?.verdict.is_bad())
    };
    let named = |cause: &Cause| -> Vec<(String, String)> {
        let pairs = cause.engines.iter().flat_map(|engine| cause.checks.iter().map(move |check| (engine.clone(), check.clone())));
        pairs.collect()
    };
    let all: Vec<(String, String)> = causes.iter().flat_map(named).collect();
    let idle = all.iter().filter(|(engine, check)| bad(engine, check) != Some(true));
    let mut lines: Vec<String> = idle.map(|(engine, check)| format!("{engine}: {check} has a stored cause but does not fail")).collect();
    for (engine, outcome) in cells(standings).filter(|(_, outcome)| outcome.verdict.is_bad()) {
        match all.iter().filter(|(name, check)| name == engine && *check == outcome.check).count() {
            0 => lines.push(format!("{engine}: {} is {}, but no cause is stored", outcome.check, outcome.verdict.word())),
            1 => {}
            _ => lines.push(format!("{engine}: {} has more than one stored cause", outcome.check)),
        }
    }
    lines
}

fn cells(standings: &[Standing]) -> impl Iterator<Item = (&str, &crate::CheckOutcome)> {
    standings
        .iter()
        .filter_map(|standing| Some((standing.entry.name.as_str(), standing.report.as_ref()?)))
        .flat_map(|(name, report)| report.checks.iter().map(move |outcome| (name, outcome)))
}
