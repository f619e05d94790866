//! The pages: plain data in, a folder of files out. No page decides a verdict.

pub mod axes;
mod claim;
pub mod data;
mod defects;
mod errata;
mod frame;
mod front;
mod list;
mod obtained;
mod pictures;
mod problems;
mod prose;
mod scoreboard;
mod section;
mod summary;
mod systems;
#[cfg(test)]
mod tests;
mod view;

use crate::Language;
use data::Report;
use moreau_exact::Result;
use view::{View, path, section_file};

/// A file of the report.
pub struct File {
    /// Its path from the folder of the report, with `/`.
    pub path: String,
    /// What it holds.
    pub text: String,
}

/// Every file of the report, English pages first.
///
/// # Errors
/// If a picture cannot be drawn.
pub fn site(report: &Report, drawn: &(dyn Fn() + Sync)) -> Result<Vec<File>> {
    let mut files = pictures::files(drawn)?;
    let shared = [("style.css", include_str!("style.css")), ("claims.js", include_str!("claims.js"))];
    files.extend(shared.map(|(path, text)| File { path: path.into(), text: text.into() }));
    for language in Language::ALL {
        files.extend(pages(report, language));
    }
    Ok(files)
}

/// A page from its view.
type Page = fn(&View) -> String;

/// The pages of one language; the explorer writes its own.
fn pages(report: &Report, language: Language) -> Vec<File> {
    let fixed: [(&str, Page); 10] = [
        ("index.html", front::page),
        ("claims.html", list::page),
        ("errata.html", errata::page),
        ("pictures.html", pictures::page),
        ("systems.html", systems::page),
        ("scoreboard.html", scoreboard::page),
        ("problems.html", problems::page),
        ("defects.html", defects::page),
        ("obtained.html", obtained::page),
        ("summary.html", summary::page),
    ];
    let write =
        |file: &str, page: &dyn Fn(&View) -> String| File { path: path(file, language), text: page(&View { report, language, file }) };
    let mut files: Vec<File> = fixed.iter().map(|(file, page)| write(file, page)).collect();
    let of = |section| move |view: &View| section::page(view, section);
    files.extend(report.sections.iter().map(|section| write(&section_file(&section.group), &of(section))));
    files
}
