//! The datasets of an HDF5 file, by their paths.

use crate::problem::contact_problem::finite;
use hdf5_pure::File;
use moreau_exact::{Error, Result};

fn missing(path: &str, error: impl std::fmt::Display) -> Error {
    Error::invalid(path, format!("cannot be read: {error}"), "give the dataset as FCLIB stores it")
}

/// A dataset of numbers, all of them finite.
pub(super) fn numbers(file: &File, path: &str) -> Result<Vec<f64>> {
    let numbers = file.dataset(path).and_then(|data| data.read_f64()).map_err(|error| missing(path, error))?;
    finite(path, &numbers).map(|()| numbers)
}

/// A dataset of one text; none where it is not there or is no text.
pub(super) fn text(file: &File, path: &str) -> Option<String> {
    file.dataset(path).and_then(|data| data.read_string()).ok()?.into_iter().next()
}

/// A dataset of whole numbers.
pub(super) fn integers(file: &File, path: &str) -> Result<Vec<i32>> {
    file.dataset(path).and_then(|data| data.read_i32()).map_err(|error| missing(path, error))
}

/// Rows of a contact.
pub(super) fn dimension(file: &File, path: &str) -> Result<usize> {
    match integers(file, path)?[..] {
        [dimension @ (2 | 3)] => Ok(dimension as usize),
        ref other => Err(Error::invalid(path, format!("is {other:?}"), "use 2 or 3")),
    }
}
