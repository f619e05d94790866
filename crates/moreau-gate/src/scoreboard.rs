//! The scoreboard: every engine that is installed here, through the same checks, stored with its version.

use crate::process::{Limits, ProcessEngine};
use crate::runner::Plan;
use crate::{Check, Options, Report, runner};
use moreau_contact::files::{read_object, read_text, write_atomically};
use moreau_exact::{Error, Result};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The list of engines, `scripts/engines/engines.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Engines {
    /// In the order of the table.
    pub engines: Vec<Entry>,
}

/// One engine in one configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// A stable name, also of its file.
    pub name: String,
    /// How it is started, relative to the folder of the project.
    pub command: Vec<String>,
    /// Its options.
    #[serde(default)]
    pub options: Options,
    /// How it is installed.
    pub install: String,
}

/// What the scoreboard knows of one engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// Which engine.
    pub entry: Entry,
    /// What the gate found; absent if it was not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub report: Option<Report>,
    /// Why it was not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_run: Option<String>,
}

impl Engines {
    /// Reads the list.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Invalid`] with the field; two entries have no one name, and no command is empty.
    pub fn read(file: &Path) -> Result<Self> {
        Engines::from_json(&read_text(file)?).map_err(|error| error.in_file(file))
    }

    /// The list in a text.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the field; two entries have no one name, and no command is empty.
    pub fn from_json(text: &str) -> Result<Self> {
        let engines: Engines = read_object(text, "engines.json")?;
        for (k, entry) in engines.engines.iter().enumerate() {
            if entry.command.is_empty() || engines.engines[..k].iter().any(|other| other.name == entry.name) {
                let problem = format!("`{}` has no command or a name that is taken", entry.name);
                return Err(Error::invalid(format!("engines[{k}]"), problem, "give every configuration its own name and a command"));
            }
        }
        Ok(engines)
    }
}

impl Entry {
    /// Why the engine cannot be started here, if it cannot: its program is not there.
    fn missing(&self) -> Option<String> {
        let program = Path::new(&self.command[0]);
        let is_path = program.components().count() > 1;
        let missing = self
            .command
            .iter()
            .map(Path::new)
            .find(|part| (part.components().count() > 1 || (is_path && *part == program)) && !part.exists());
        missing.map(|part| format!("{} is not there; install with `{}`", part.display(), self.install))
    }

    /// Runs the gate on the engine, unless it is not installed or cannot be run: then the standing says why, and is never a pass.
    pub fn judge(&self, checks: &[&'static Check], sweep: &[f64], jobs: usize, progress: &(dyn Fn() + Sync)) -> Standing {
        let not_run = |reason: String| Standing { entry: self.clone(), report: None, not_run: Some(reason) };
        if let Some(reason) = self.missing() {
            return not_run(reason);
        }
        let plan = Plan { checks: checks.to_vec(), sweep: sweep.to_vec(), options: self.options.clone(), jobs, repeats: 1, progress };
        let make = || -> Box<dyn crate::Engine> { Box::new(ProcessEngine::new(self.command.clone(), Limits::default())) };
        match runner::run(&make, &plan) {
            Ok(report) => Standing { entry: self.clone(), report: Some(report), not_run: None },
            Err(refusal) => not_run(format!("{refusal}; install with `{}`", self.install)),
        }
    }
}

impl Standing {
    /// The file of an engine in a folder.
    pub fn file(folder: &Path, name: &str) -> PathBuf {
        folder.join(format!("{name}.json"))
    }

    /// The standing with what another one found by checks that this one did not run, if the engine is the same; in the order of the
    /// registry.
    pub fn beside(mut self, other: Option<Standing>) -> Standing {
        let Some(report) = &mut self.report else { return self };
        let same = |one: &Report| one.engine.version == report.engine.version && one.sweep == report.sweep;
        if let Some(other) = other.and_then(|other| other.report).filter(same) {
            let ran: Vec<String> = report.checks.iter().map(|outcome| outcome.check.clone()).collect();
            report.checks.extend(other.checks.into_iter().filter(|outcome| !ran.contains(&outcome.check)));
            let place = |outcome: &crate::CheckOutcome| crate::checks::all().position(|check| check.name == outcome.check);
            report.checks.sort_by_key(|outcome| place(outcome).unwrap_or(usize::MAX));
        }
        self
    }

    /// Stores the standing in a folder, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn store(&self, folder: &Path) -> Result<()> {
        let text = serde_json::to_string(self)? + "\n";
        write_atomically(&Standing::file(folder, &self.entry.name), text.as_bytes())
    }

    /// Reads a stored standing.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Invalid`] with the field and the file's name.
    pub fn read(file: &Path) -> Result<Self> {
        Standing::from_json(&read_text(file)?).map_err(|error| error.in_file(file))
    }

    /// The standing in a text.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the field.
    pub fn from_json(text: &str) -> Result<Self> {
        read_object(text, "scoreboard")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CheckOutcome, Engine, StepOutcome, Verdict, own};

    fn standing(version: &str, sweep: &[f64], checks: &[(&str, Verdict)]) -> Standing {
        let mut engine = own::by_name("moreau-jean").expect("listed").describe(&Options::new()).expect("describes itself");
        engine.version = version.into();
        let outcome = |(name, verdict): &(&str, Verdict)| CheckOutcome::new(name, vec![StepOutcome::planted(sweep[0], *verdict)]);
        let checks = checks.iter().map(outcome).collect();
        let report = Report { schema: crate::outcome::SCHEMA.into(), engine, adapter: Vec::new(), sweep: sweep.to_vec(), checks };
        let entry = Entry { name: "mine".into(), command: vec!["mine".into()], options: Options::new(), install: String::new() };
        Standing { entry, report: Some(report), not_run: None }
    }

    #[test]
    fn what_another_run_found_is_taken_over_if_engine_and_steps_are_the_same_and_never_instead_of_what_was_run() {
        let now = || standing("2", &[0.5, 0.25], &[("stack/ten", Verdict::Fail)]);
        let older = [("stack/ten", Verdict::Pass), ("flight/projectile", Verdict::Pass)];
        let found = |other: Option<Standing>| -> Vec<(String, Verdict)> {
            let report = now().beside(other).report.expect("it was run");
            report.checks.into_iter().map(|outcome| (outcome.check, outcome.verdict)).collect()
        };
        let alone = vec![("stack/ten".to_string(), Verdict::Fail)];
        let both = [vec![("flight/projectile".to_string(), Verdict::Pass)], alone.clone()].concat();
        assert_eq!(found(Some(standing("2", &[0.5, 0.25], &older))), both, "in the order of the registry");
        assert_eq!(found(Some(standing("1", &[0.5, 0.25], &older))), alone, "another version");
        assert_eq!(found(Some(standing("2", &[0.5, 0.125], &older))), alone, "other steps");
        assert_eq!(found(None), alone);
    }
}
