//! What is said of a name that nothing has.

use crate::files::did_you_mean;

/// `did you mean …?`, or the fallback where nothing is near.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>, fallback: &str) -> String {
    did_you_mean(name, candidates).unwrap_or_else(|| fallback.into())
}
