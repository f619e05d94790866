//! Errors: every message names the file or object, the field, what is wrong and what would cure it.

use crate::cause;
use std::path::{Path, PathBuf};

/// Result of every fallible operation of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// What can go wrong, in words a user can act on.
///
/// ```
/// use moreau_exact::Error;
///
/// let error = Error::invalid("friction[2]", "is -0.5", "use a number ≥ 0").in_file("scene.json".as_ref());
/// assert_eq!(error.to_string(), "scene.json: field `friction[2]`: is -0.5; use a number ≥ 0");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {}", file.display(), cause::of_reading(file, source))]
    Read {
        /// The file.
        file: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// A file could not be written; nothing was left half-written.
    #[error("cannot write {}: {}", file.display(), cause::of_writing(file, source))]
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
    /// A field of the input holds a value that is not allowed.
    #[error("field `{field}`: {problem}; {cure}")]
    Invalid {
        /// The field, as spelt in the input.
        field: String,
        /// What is wrong with it.
        problem: String,
        /// What would be accepted.
        cure: String,
    },
    /// An error in the content of a file, with the name of the file.
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
        /// Whether the solver refused the problem, and otherwise how it ended.
        failure: Failure,
        /// Why it refuses, or how it ended, in words.
        reason: String,
    },
    /// The crate cannot do what was asked, as with an unknown scheme or a scene that no mechanism covers.
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
    /// The problem has no solution, which was proved.
    Infeasible,
}

impl Failure {
    /// The word for messages and files.
    pub fn name(self) -> &'static str {
        match self {
            Failure::Refused => "refused",
            Failure::Breakdown => "breakdown",
            Failure::Ray => "ray",
            Failure::Limit => "limit",
            Failure::Infeasible => "infeasible",
        }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl Error {
    /// The error of a field that holds an invalid value.
    pub fn invalid(field: impl Into<String>, problem: impl Into<String>, cure: impl Into<String>) -> Self {
        Error::Invalid { field: field.into(), problem: problem.into(), cure: cure.into() }
    }

    /// The error of a solver that ended without a solution; `solver` is its name.
    pub fn solver(solver: impl Into<String>, failure: Failure, reason: impl Into<String>) -> Self {
        Error::Solver { solver: solver.into(), failure, reason: reason.into() }
    }

    /// The error of a solver that refuses a problem outside its scope.
    pub fn refused(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Refused, reason)
    }

    /// The error of a solver whose arithmetic broke down.
    pub fn breakdown(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Breakdown, reason)
    }

    /// The error of a pivoting solver that ended on a ray.
    pub fn ray(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Ray, reason)
    }

    /// The error of a solver that reached its limit of iterations.
    pub fn limit(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Limit, reason)
    }

    /// The error of a solver that proved that the problem has no solution.
    pub fn infeasible(solver: impl Into<String>, reason: impl Into<String>) -> Self {
        Error::solver(solver, Failure::Infeasible, reason)
    }

    /// Why a file could not be read or written, and what to do about it, where the file is named beside it; nothing of other errors.
    pub fn cause(&self) -> Option<String> {
        match self {
            Error::Read { file, source } => Some(cause::of_reading(file, source)),
            Error::Write { file, source } => Some(cause::of_writing(file, source)),
            _ => None,
        }
    }

    /// The same error, naming the file it came from.
    pub fn in_file(self, file: &Path) -> Self {
        Error::InFile { file: file.to_path_buf(), inner: Box::new(self) }
    }
}
