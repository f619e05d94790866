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

/// A line that names the problems whose record alone is stored; nothing where there is none.
pub fn not_stored<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    if names.is_empty() {
        return String::new();
    }
    let count = if names.len() == 1 { "1 of them is".into() } else { format!("{} of them are", names.len()) };
    let names = names.join(", ");
    format!("{count} listed and not exported, too large to be stored: {names}; `moreau problems show NAME` says what makes each\n")
}
