//! A section of a Markdown file that a command writes, between two markers.

use crate::files::read_text;
use crate::{Error, Result};
use std::path::Path;

/// The text of a file with what stands between two markers replaced.
///
/// # Errors
/// If the file cannot be read or lacks a marker; the message names both.
pub fn replaced(file: &Path, markers: [&str; 2], section: &str) -> Result<String> {
    replaced_by("--readme", file, markers, section)
}

/// The same for an option of another name.
///
/// # Errors
/// Those of [`replaced`].
pub fn replaced_by(option: &str, file: &Path, [begin, end]: [&str; 2], section: &str) -> Result<String> {
    let text = read_text(file)?;
    let name = begin.trim_start_matches("<!-- ").trim_end_matches(" -->");
    let missing = || {
        let cure = format!("put `{begin}` and `{end}` where the table belongs");
        Error::invalid(option, format!("has no {name} section"), cure).in_file(file)
    };
    let (before, rest) = text.split_once(begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}\n{section}{end}{after}"))
}
