//! The likely causes of each failure, written into a page.

use crate::Result;
use crate::board;
use crate::cli::{Answer, section};
use crate::files::write_together;
use crate::report::failures::{self, BEGIN, END};
use std::path::Path;

/// Replaces the section of this file; a file without the markers is refused.
pub fn write(file: &Path) -> Result<Answer> {
    let (standings, causes) = board::stored()?;
    let text = section::replaced_by("--failures", file, [BEGIN, END], &failures::section(&standings, &causes))?;
    write_together(&[(file, text.as_bytes())])?;
    Ok(Answer::Yes)
}
