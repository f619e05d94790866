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
    #[error("solver `{solver}` ({failure}): {reason}")]
    Solver {
        /// The solver's name.
        solver: String,
        /// Which of the two, and how it ended.
        failure: Failure,
        /// Why it refuses, or how it ended, in words.
        reason: String,
    },
    /// A request the crate cannot serve (unknown scheme, scene outside the mechanisms it has…).
    #[error("{0}")]
    Unsupported(String),
}

/// How a solver ended without a solution; its word stands in messages and, as `"status"`, in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Failure {
    /// The problem is outside the algorithm's scope; nothing was computed.
    Refused,
    /// The arithmetic broke down: a matrix was singular or indefinite, or a number overflowed.
    Breakdown,
    /// A pivoting method ended on a ray, which shows no solution.
    Ray,
    /// The iteration reached its limit without an answer.
    Limit,
}

impl Failure {
    /// The word for messages and files.
    pub fn name(self) -> &'static str {
        match self {
            Failure::Refused => "refused",
            Failure::Breakdown => "breakdown",
            Failure::Ray => "ray",
            Failure::Limit => "limit",
        }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl Error {
    /// A field that holds a value that cannot be meant.
    pub fn invalid(field: impl Into<String>, problem: impl Into<String>, cure: impl Into<String>) -> Self {
        Error::Invalid { field: field.into(), problem: problem.into(), cure: cure.into() }
    }

    /// A solver that ended without a solution, by name.
    pub fn solver(solver: impl Into<String>, failure: Failure, reason: impl Into<String>) -> Self {
        Error::Solver { solver: solver.into(), failure, reason: reason.into() }
    }

    /// A solver that refuses a problem outside its scope.
    pub fn refused(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Refused, reason)
    }

    /// A solver whose arithmetic broke down.
    pub fn breakdown(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Breakdown, reason)
    }

    /// A solver that ended on a ray.
    pub fn ray(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Ray, reason)
    }

    /// A solver that reached its limit.
    pub fn limit(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Limit, reason)
    }

    /// The same error, naming the file it came from.
    pub fn in_file(self, file: &Path) -> Self {
        Error::InFile { file: file.to_path_buf(), inner: Box::new(self) }
    }
}
