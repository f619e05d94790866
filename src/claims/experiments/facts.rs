//! Facts about an engine, format `facts/1`: what the pinned release says of itself, or what the files of its package do.

use crate::Result;
use crate::stored::{RUNS, read};
use serde::Deserialize;
use serde_json::Value;

/// The part of a document that claims read; `S` is what is stated of this engine.
#[derive(Clone, Debug, Deserialize)]
pub struct Document<S> {
    /// Version of the package that was asked.
    pub version: String,
    /// Names, settings, sentences, files, lines of source.
    pub stated: S,
}

/// What the files of a package state.
#[derive(Clone, Debug, Deserialize)]
pub struct Package {
    /// Paths of the files that were looked for.
    pub files: Vec<String>,
    /// The lines of source that were looked for.
    pub lines: Vec<Line>,
    /// Default settings by name.
    pub settings: Value,
}

/// A line of source.
#[derive(Clone, Debug, Deserialize)]
pub struct Line {
    /// Path of its file.
    pub file: String,
    /// The line without its comment.
    pub text: String,
}

impl Package {
    /// Whether there is a file whose path ends like this.
    pub fn has(&self, end: &str) -> bool {
        self.files.iter().any(|path| path.ends_with(end))
    }

    /// Whether there is a line like this in a file whose path ends so.
    pub fn says(&self, end: &str, text: &str) -> bool {
        self.lines.iter().any(|line| line.file.ends_with(end) && line.text == text)
    }
}

/// The stored facts about Bullet, from the source distribution of PyBullet 3.2.7.
///
/// # Errors
/// If the stored file is not what the script writes.
pub fn bullet() -> Result<Document<Package>> {
    read(&RUNS, "bullet/package.json")
}

/// The stored facts about Pinocchio, from the wheel libpinocchio 4.1.0.
///
/// # Errors
/// If the stored file is not what the script writes.
pub fn pinocchio() -> Result<Document<Package>> {
    read(&RUNS, "pinocchio/package.json")
}
