//! A problem with its record, as the program embeds it.

use crate::problem::ContactProblem;
use crate::{Error, Result};
use moreau_contact::answered::Record;

/// A problem of the collection, as it is embedded.
#[derive(Clone, Copy, Debug)]
pub struct Stored {
    /// The problem's name.
    pub name: &'static str,
    /// The text of the problem; none where it is too large to be stored.
    pub problem: Option<&'static str>,
    /// The text of the record.
    pub record: &'static str,
}

impl Stored {
    /// The problem itself.
    ///
    /// # Errors
    /// [`Error::Unsupported`] with the command that makes it where it is not stored.
    pub fn problem(&self) -> Result<ContactProblem> {
        match self.problem {
            Some(text) => ContactProblem::from_json(text),
            None => Err(Error::Unsupported(format!(
                "`{}` is too large to be stored; make it in the repository with `{}`",
                self.name,
                self.record()?.script
            ))),
        }
    }

    /// Its record.
    ///
    /// # Errors
    /// [`Error::Json`] if the stored text is none.
    pub fn record(&self) -> Result<Record> {
        Ok(serde_json::from_str(self.record)?)
    }
}
