//! Errors: every message names the file or object, the field, what is wrong and what would cure it.

use std::path::{Path, PathBuf};

/// Result of every fallible operation of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// What can go wrong, in words a user can act on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// A file could not be written; nothing was left half-written.
    #[error("cannot write {}: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// A text is not JSON of the expected shape.
    #[cfg(feature = "json")]
    #[error("not valid JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A field holds a value that cannot be meant.
    #[error("field `{field}`: {problem}; {cure}")]
    Invalid {
        /// The field, as spelt in the input.
        field: String,
        /// What is wrong with it.
        problem: String,
        /// What would be accepted.
        cure: String,
    },
    /// The error, with the file it came from.
    #[error("{}: {inner}", file.display())]
    InFile {
        /// The file.
        file: PathBuf,
        /// The error in it.
        inner: Box<Error>,
    },
    /// A solver refuses a problem outside its scope, or ended without a solution.
    #[error("solver `{solver}`: {reason}")]
    Solver {
        /// The solver's name.
        solver: String,
        /// Why it refuses, or how it ended.
        reason: String,
    },
    /// A request the crate cannot serve (unknown scheme, scene outside the mechanisms it has…).
    #[error("{0}")]
    Unsupported(String),
}

impl Error {
    /// A field that holds a value that cannot be meant.
    pub fn invalid(field: impl Into<String>, problem: impl Into<String>, cure: impl Into<String>) -> Self {
        Error::Invalid { field: field.into(), problem: problem.into(), cure: cure.into() }
    }

    /// A solver that refuses or fails, by name.
    pub fn solver(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::Solver { solver: solver.into(), reason: reason.into() }
    }

    /// The same error, naming the file it came from.
    pub fn in_file(self, file: &Path) -> Self {
        Error::InFile { file: file.to_path_buf(), inner: Box::new(self) }
    }
}
