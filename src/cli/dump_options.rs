//! `--dump-step` and `--dump-rejected`: the contact problem and the answer of a step as files.

use super::outputs::{self, JSON};
use super::several::{make_folder, refuse_file};
use crate::certificate::residuals;
use crate::files::write_together;
use crate::problem::{ContactKey, ContactProblem, Solution};
use crate::schemes::Step;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Which steps are written.
#[derive(clap::Args)]
pub struct DumpOptions {
    /// Write the contact problem of step N (from 1) to FILE, and its answer beside it to FILE with `-solution` before the ending.
    #[arg(long, num_args = 2, value_names = ["N", "FILE"], allow_negative_numbers = true)]
    dump_step: Vec<String>,
    /// Write problem and answer of every step that the certificate rejects into this folder, which holds no steps of an earlier run, and is
    /// made with the first such step if it is not there.
    #[arg(long, value_name = "FOLDER")]
    dump_rejected: Option<PathBuf>,
}

/// What is to be written, while the motion runs.
pub struct Dumps<'a> {
    step: Option<(usize, &'a Path)>,
    rejected: Option<&'a Path>,
    seen: usize,
}

impl DumpOptions {
    /// The files of the step that is asked for: its problem, and its answer.
    pub fn files(&self) -> Vec<PathBuf> {
        self.dump_step.get(1).map_or_else(Vec::new, |file| vec![PathBuf::from(file), beside(Path::new(file))])
    }

    /// Checks the step and the folder, which is made when there is something to write.
    pub fn start(&self, steps: usize) -> Result<Dumps<'_>> {
        let step = match &self.dump_step[..] {
            [number, file] => {
                let wanted = number.parse().ok().filter(|wanted| (1..=steps).contains(wanted));
                let wrong =
                    || Error::invalid("--dump-step", format!("asks for step `{number}`"), format!("use a number from 1 to {steps}"));
                outputs::require("--dump-step", Some(Path::new(file)), JSON)?;
                Some((wanted.ok_or_else(wrong)?, Path::new(file)))
            }
            _ => None,
        };
        if let Some(folder) = &self.dump_rejected {
            refuse_file(REJECTED, folder)?;
            refuse_earlier_steps(folder)?;
        }
        Ok(Dumps { step, rejected: self.dump_rejected.as_deref(), seen: 0 })
    }
}

/// The option that names the folder.
const REJECTED: &str = "--dump-rejected";

/// Files of an earlier run would pass for rejected steps of this one.
fn refuse_earlier_steps(folder: &Path) -> Result<()> {
    if !folder.exists() {
        return Ok(());
    }
    let unreadable = |source| Error::Read { file: folder.into(), source };
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let name = entry.map_err(unreadable)?.file_name();
        let name = name.to_string_lossy();
        if name.starts_with("step-") && name.ends_with(".json") {
            let problem = format!("names `{}`, which holds `{name}` of an earlier run", folder.display());
            return Err(Error::invalid(REJECTED, problem, "name an empty folder, or one that is not there"));
        }
    }
    Ok(())
}

impl Dumps<'_> {
    /// Writes the step if it is asked for.
    pub fn see(&mut self, step: &Step) -> Result<()> {
        self.seen += 1;
        if let Some((wanted, file)) = self.step.filter(|(wanted, _)| *wanted == self.seen) {
            let missing = || {
                let cure = "ask for a step with a contact, of a scheme that poses one problem a step";
                Error::invalid("--dump-step", format!("asks for step {wanted}, which has no contact problem"), cure)
            };
            let posed = step.assembled.problem.as_ref().zip(step.solution.as_ref());
            let (problem, solution) = posed.or(step.rejected.as_ref().map(|one| (&one.problem, &one.solution))).ok_or_else(missing)?;
            write(step, problem, solution, file)?;
        }
        match (self.rejected, &step.rejected) {
            (Some(folder), Some(one)) => {
                make_folder(REJECTED, folder)?;
                write(step, &one.problem, &one.solution, &folder.join(format!("step-{:06}.json", self.seen)))
            }
            _ => Ok(()),
        }
    }

    /// The step that was asked for and did not come, for the motion was ended before.
    pub fn missing(&self) -> Option<usize> {
        self.step.map(|(wanted, _)| wanted).filter(|wanted| *wanted > self.seen)
    }
}

/// Writes `name.json` and `name-solution.json`, with keys where bodies and features tell the contacts apart.
fn write(step: &Step, problem: &ContactProblem, solution: &Solution, file: &Path) -> Result<()> {
    let (keyed, mut answer);
    let (problem, solution) = match keys(step, problem) {
        Some(keys) => {
            keyed = problem.clone().into_builder().keys(Some(keys.clone())).build()?;
            answer = solution.clone();
            answer.keys = Some(keys);
            (&keyed, &answer)
        }
        None => (problem, solution),
    };
    let beside = beside(file);
    let found = serde_json::to_value(residuals(problem, solution)?)?;
    let (problem, solution) = (problem.to_json(), solution.to_json(Some(problem.name()), Some(found)));
    write_together(&[(file, problem.as_bytes()), (&beside, solution.as_bytes())])
}

/// `name-solution.json` beside `name.json`.
fn beside(file: &Path) -> PathBuf {
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let ending = file.extension().map(|ending| format!(".{}", ending.to_string_lossy())).unwrap_or_default();
    file.with_file_name(format!("{stem}-solution{ending}"))
}

/// Which contact each of a problem is, if it is the one that the step holds: a scheme may pose others on the way.
fn keys(step: &Step, problem: &ContactProblem) -> Option<Vec<ContactKey>> {
    let is_held = step.assembled.problem.as_ref() == Some(problem);
    is_held.then(|| ContactKey::of_places(&step.assembled.places)).flatten()
}
