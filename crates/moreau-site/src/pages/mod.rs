//! The pages: plain data in, a folder of files out. No page decides a verdict.

pub mod axes;
mod claim;
mod correction;
mod creep;
pub mod data;
mod defects;
mod errata;
mod explorer;
mod file;
mod frame;
mod front;
mod list;
mod obtained;
mod pictures;
mod problems;
mod prose;
mod related;
mod scoreboard;
mod section;
mod severity;
mod summary;
mod systems;
mod systems_words;
#[cfg(test)]
mod tests;
mod view;

pub use file::File;

use crate::words::Language;
use data::Report;
use moreau_exact::Result;
use view::{View, path, section_file};

/// Every file of the report, English pages first; `done` is told of every picture and every run of the explorer.
///
/// # Errors
/// If a picture cannot be drawn, or a scene of the explorer is not valid.
pub fn site(report: &Report, done: &(dyn Fn() + Sync)) -> Result<Vec<File>> {
    let mut files = without_runs(report, done)?;
    files.extend(explorer::files(done)?);
    Ok(files)
}

/// The same without the files of the explorer.
fn without_runs(report: &Report, done: &(dyn Fn() + Sync)) -> Result<Vec<File>> {
    let mut files = pictures::files(&report.given, done)?;
    let shared = [("style.css", include_str!("style.css")), ("claims.js", include_str!("claims.js"))];
    files.extend(shared.map(|(path, text)| File { path: path.into(), text: text.into() }));
    for language in Language::ALL {
        files.extend(pages(report, language));
    }
    Ok(files)
}

/// How many pictures and runs are computed for a report.
pub fn parts() -> usize {
    crate::pictures::PICTURES.len() + crate::explorer::SCENES.iter().map(|scene| scene.choices().len()).sum::<usize>()
}

/// A page from its view.
type Page = fn(&View) -> String;

/// The pages of one language.
fn pages(report: &Report, language: Language) -> Vec<File> {
    let fixed: [(&str, Page); 11] = [
        ("index.html", front::page),
        ("claims.html", list::page),
        ("errata.html", errata::page),
        ("pictures.html", pictures::page),
        ("explorer.html", explorer::page),
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
