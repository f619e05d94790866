//! Stored runs of real engines: a folder like `references/`, or what a program embeds. Nothing in this crate knows where they are.

use moreau_exact::{Error, Result};
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
#[derive(Clone, Copy, Debug)]
pub struct Embedded(pub &'static [(&'static str, &'static str)]);

impl StoredRuns for Folder {
    fn text(&self, path: &str) -> Result<Cow<'_, str>> {
        let file = self.0.join(path);
        let missing = |error| missing(path, format!("cannot be read in {}: {error}", self.0.display()), "name the folder that has it");
        std::fs::read_to_string(&file).map(Cow::Owned).map_err(missing)
    }
}

impl StoredRuns for Embedded {
    fn text(&self, path: &str) -> Result<Cow<'_, str>> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        let missing = || missing(path, "is not embedded in this program".into(), "add it to the program's table of stored runs");
        found.map(|(_, text)| Cow::Borrowed(*text)).ok_or_else(missing)
    }
}

fn missing(path: &str, problem: String, cure: &str) -> Error {
    Error::invalid("stored run", format!("`{path}` {problem}"), cure)
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
            let message = runs.text("engine/lost.json").expect_err("not stored").to_string();
            assert!(
                message.contains("`engine/lost.json`") && (message.contains("name the folder") || message.contains("table")),
                "{message}"
            );
        }
    }
}
