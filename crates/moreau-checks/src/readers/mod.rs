//! Checks of readers: every number of a text stands where the format says, and a text that breaks the format is refused.
//!
//! The texts and what they mean are written here by hand; no writer of the workspace takes part.

pub mod problem;
pub mod scene;

use crate::finding::Finding;
use moreau_exact::Result;

/// Whether each of these texts is refused: one finding per text.
fn refused<T>(reader: &fn(&str) -> Result<T>, texts: impl IntoIterator<Item = (&'static str, String)>) -> Vec<Finding> {
    texts.into_iter().map(|(what, text)| Finding::decision(format!("{what} is refused"), reader(&text).is_err(), true)).collect()
}

/// A text with one passage changed.
///
/// # Panics
/// If the passage does not occur: the case would break nothing.
fn with(text: &str, passage: &str, other: &str) -> String {
    assert!(text.contains(passage), "`{passage}` is not in the text");
    text.replacen(passage, other, 1)
}

/// One finding on whether what was read is what is written; an error is none of it.
fn same<T, V: PartialEq>(what: &str, read: &Result<T>, value: impl Fn(&T) -> V, written: V) -> Finding {
    Finding::decision(what, read.as_ref().is_ok_and(|read| value(read) == written), true)
}
