//! Errors of the crates below as Python exceptions, with the field and the cure as attributes.

use moreau::Error;
use pyo3::prelude::*;

/// The exception of an error. The classes stand in `moreau_contact/_errors.py`.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    raised(py, error).unwrap_or_else(|failure| failure)
}

fn raised(py: Python<'_>, error: &Error) -> PyResult<PyErr> {
    let errors = py.import("moreau_contact._errors")?;
    let message = in_python(&error.to_string());
    let made = match innermost(error) {
        Error::Invalid { field, problem, cure } => {
            let [field, problem, cure] = [keyword(field), in_python(problem), in_python(cure)];
            errors.getattr("InvalidInput")?.call1((message, field, problem, cure))?
        }
        Error::Solver { solver, failure, .. } => errors.getattr("SolverError")?.call1((message, solver, failure.name()))?,
        Error::Read { file, source } | Error::Write { file, source } => {
            let file = file.to_string_lossy().into_owned();
            errors.getattr("FileError")?.call1((message, source.raw_os_error(), file))?
        }
        Error::Json(_) => errors.getattr("InvalidInput")?.call1((message, "", "is not JSON", "give a whole JSON file"))?,
        _ => errors.getattr("Unsupported")?.call1((message,))?,
    };
    Ok(PyErr::from_value(made))
}

/// The error inside of the name of its file.
fn innermost(error: &Error) -> &Error {
    match error {
        Error::InFile { inner, .. } => innermost(inner),
        other => other,
    }
}

/// What the limit of memory is called as a field.
const MEMORY_LIMIT: &str = "memory_limit";

/// A name of the command line as a keyword: `--max-memory` is `max_memory`.
fn keyword(field: &str) -> String {
    if field == "memory::limit" {
        return MEMORY_LIMIT.into();
    }
    field.strip_prefix("--").map_or_else(|| field.to_string(), |option| option.replace('-', "_"))
}

/// A message in which options are keywords.
fn in_python(message: &str) -> String {
    let word = |word: &str| match word.find("--") {
        Some(at) if word[at + 2..].starts_with(|c: char| c.is_ascii_lowercase()) => {
            format!("{}{}", &word[..at], word[at + 2..].replace('-', "_"))
        }
        _ => word.to_string(),
    };
    let message = message.replace("memory::set_limit", "moreau_contact.set_memory_limit").replace("memory::limit", MEMORY_LIMIT);
    message.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// Turns errors of the crates below into exceptions.
pub trait IntoPython<T> {
    /// The value, or the exception.
    ///
    /// # Errors
    /// The exception of the error.
    fn python(self, py: Python<'_>) -> PyResult<T>;
}

impl<T> IntoPython<T> for moreau::Result<T> {
    fn python(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| exception(py, &error))
    }
}

/// An argument that is not allowed.
pub fn invalid(py: Python<'_>, field: &str, problem: impl Into<String>, cure: impl Into<String>) -> PyErr {
    exception(py, &Error::invalid(field, problem, cure))
}

/// A solver's answer that the certificate rejects.
pub fn rejected(py: Python<'_>, verdict: &str, solver: &str, solution: Py<PyAny>) -> PyErr {
    let message = format!("the answer of `{solver}` is rejected: {verdict}");
    let made = py.import("moreau_contact._errors").and_then(|errors| errors.getattr("Rejected")?.call1((message, solver, solution)));
    made.map_or_else(|failure| failure, PyErr::from_value)
}
