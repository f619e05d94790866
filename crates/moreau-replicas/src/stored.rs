//! Stored runs of real engines: a folder like `references/`, or what a program embeds, and the one way to read them. Nothing in this crate
//! knows where they are.

use moreau_contact::problem::{ContactProblem, Solution};
use moreau_exact::{Error, Result};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::path::PathBuf;

/// Where the text of a stored run comes from.
pub trait StoredRuns: Sync {
    /// The text of the run at a path relative to `references/`, such as `bullet/ball_sunk__multi__h0.01.json`.
    ///
    /// # Errors
    /// If there is no such run.
    fn text(&self, path: &str) -> Result<Cow<'_, str>>;
}

/// Stored runs in a folder with the layout of `references/`.
#[derive(Clone, Debug)]
pub struct Folder(pub PathBuf);

/// Stored runs that a program embeds, each a path and its text.
///
/// ```
/// use moreau_replicas::stored::{Embedded, read};
///
/// static RUNS: Embedded = Embedded(&[("balls/drop.json", "[1.0, 0.5]")]);
/// assert_eq!(read::<[f64; 2]>(&RUNS, "balls/drop.json")?, [1.0, 0.5]);
/// assert!(read::<[f64; 2]>(&RUNS, "balls/other.json").is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Embedded(pub &'static [(&'static str, &'static str)]);

impl StoredRuns for Folder {
    fn text(&self, path: &str) -> Result<Cow<'_, str>> {
        let file = self.0.join(path);
        let missing = |error| unusable(path, format!("cannot be read in {}: {error}", self.0.display()), "name the folder that has it");
        std::fs::read_to_string(&file).map(Cow::Owned).map_err(missing)
    }
}

impl StoredRuns for Embedded {
    fn text(&self, path: &str) -> Result<Cow<'_, str>> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        let missing = || unusable(path, "is not embedded in this program".into(), "add it to the program's table of stored runs");
        found.map(|(_, text)| Cow::Borrowed(*text)).ok_or_else(missing)
    }
}

fn unusable(path: &str, problem: String, cure: &str) -> Error {
    Error::invalid("stored run", format!("`{path}` {problem}"), cure)
}

/// What is stored at a path.
///
/// # Errors
/// If nothing is, or not what is asked for; the message names the path and what cures it.
pub fn read<T: DeserializeOwned>(runs: &dyn StoredRuns, path: &str) -> Result<T> {
    read_by(runs, path, |text| Ok(serde_json::from_str(text)?))
}

/// What is stored at a path, by the reader of its format, which sees more than the shape.
///
/// # Errors
/// As [`read`].
pub fn read_by<T>(runs: &dyn StoredRuns, path: &str, reader: impl FnOnce(&str) -> Result<T>) -> Result<T> {
    let spoilt = |error| unusable(path, format!("is not what it should be: {error}"), "make it again, as references/README.md says");
    reader(&runs.text(path)?).map_err(spoilt)
}

/// The contact problem and the engine's answer that are stored at a path: of a solver, or of one step.
///
/// # Errors
/// As [`read`].
pub fn problem_and_answer(runs: &dyn StoredRuns, path: &str) -> Result<(ContactProblem, Solution)> {
    #[derive(Deserialize)]
    struct Answered {
        problem: Box<RawValue>,
        answer: Box<RawValue>,
    }
    read_by(runs, path, |text| {
        let Answered { problem, answer } = serde_json::from_str(text)?;
        Ok((ContactProblem::from_json(problem.get())?, Solution::from_json(answer.get())?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder that is removed when the test ends.
    struct Temporary(PathBuf);

    impl Drop for Temporary {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_run_is_found_by_its_path_in_a_folder_and_in_a_table() {
        let folder = Temporary(std::env::temp_dir().join(format!("moreau-stored-{}", std::process::id())));
        std::fs::create_dir_all(folder.0.join("engine")).expect("a temporary folder");
        std::fs::write(folder.0.join("engine/run.json"), "{}").expect("a file in it");
        let sources: [&dyn StoredRuns; 2] = [&Folder(folder.0.clone()), &Embedded(&[("other.json", "[]"), ("engine/run.json", "{}")])];
        for runs in sources {
            assert_eq!(runs.text("engine/run.json").expect("stored"), "{}");
            assert!(read::<serde_json::Value>(runs, "engine/run.json").expect("an object").is_object());
            for spoilt in [read::<Vec<f64>>(runs, "engine/run.json").map(drop), problem_and_answer(runs, "engine/run.json").map(drop)] {
                let message = spoilt.expect_err("neither numbers nor an answer").to_string();
                assert!(message.contains("`engine/run.json`") && message.contains("make it again"), "{message}");
            }
            let message = runs.text("engine/lost.json").expect_err("not stored").to_string();
            assert!(
                message.contains("`engine/lost.json`") && (message.contains("name the folder") || message.contains("table")),
                "{message}"
            );
        }
    }
}
