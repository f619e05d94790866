//! The page of the explorer among the others, and its files.

use super::file::File;
use super::frame::document;
use super::view::View;
use crate::explorer;
use moreau_exact::Result;

/// The folder of the explorer's files, which both languages share.
const FOLDER: &str = "explorer/";

/// The page.
pub fn page(view: &View) -> String {
    document(view, view.say(explorer::TITLE), &explorer::content(view.language, &view.shared(FOLDER)))
}

/// The runs, computed now, and the program; `done` is told of every run.
///
/// # Errors
/// If a scene of the explorer is not valid.
pub fn files(done: &(dyn Fn() + Sync)) -> Result<Vec<File>> {
    let files = explorer::files(&|_, _| done())?;
    Ok(files.into_iter().map(|(name, text)| File { path: format!("{FOLDER}{name}"), text }).collect())
}
