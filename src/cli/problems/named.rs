//! A problem of the collection by its name.

use crate::cli::near::suggestion;
use crate::problems::{ALL, Stored};
use crate::{Error, Result};

/// The problem of this name, or the names near it.
pub(super) fn named(name: &str) -> Result<&'static Stored> {
    ALL.iter().find(|stored| stored.name == name).ok_or_else(|| {
        let cure = suggestion(name, ALL.iter().map(|stored| stored.name), "`moreau problems list` lists them");
        Error::Unsupported(format!("no problem `{name}`; {cure}"))
    })
}
