//! The answer that is certified: a file of its own, or what the file of the problem holds.

use super::super::kind::{Kind, read_solution};
use super::super::posed;
use super::arguments::USAGE;
use crate::problem::{Posed, Solution, StoredAnswers};
use crate::{Error, Result};
use std::path::Path;

/// The answer, and the file that it is in.
pub fn read_answer<'a>(file: &'a Path, answer: Option<&'a Path>, problem: &Posed) -> Result<(&'a Path, Solution)> {
    let Some(file) = answer else { return stored_answer(file, problem) };
    let solution = read_solution(file, problem, USAGE)?;
    Ok((file, solution))
}

/// Whether an answer stands beside the problem in its own file, which counts where no answers are named.
pub fn holds_answer(file: &Path) -> bool {
    // what cannot be read has its own message
    Kind::of(file) == Kind::Hdf5 && StoredAnswers::read(file).map_or(true, |stored| stored.solution.is_some())
}

/// The answer that an HDF5 file of FCLIB holds beside its problem; other problems hold none.
fn stored_answer<'a>(file: &'a Path, problem: &Posed) -> Result<(&'a Path, Solution)> {
    match Kind::of(file) {
        Kind::Hdf5 => Ok((file, posed::read_answer(problem, file)?)),
        kind => {
            let found = format!("is missing: {} is {}, which holds no answer", file.display(), kind.words());
            let cure = format!("give one: {USAGE}; `moreau solve {} --out answer.json` makes one", file.display());
            Err(Error::invalid("SOLUTION", found, cure))
        }
    }
}
