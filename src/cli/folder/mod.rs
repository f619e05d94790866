//! The folder of a report: refused if it holds anything else, and written whole or not at all.
//!
//! ```text
//!     .NAME.new-N/  ──► NAME        what stood there goes to .NAME.old-N/ first, and away at the end
//! ```
//! N is the number of the process, or the next one that is free. A run that is stopped between the two leaves nothing at NAME and its
//! report aside: the next run puts that back first, if it is whole, and tells what else lies there.

use crate::report::site::document::{FILE, SCHEMA};
use crate::{Error, Result};
use moreau_site::pages::File;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A folder that may be written.
pub struct Target {
    folder: PathBuf,
    /// N.
    number: u32,
}

/// What is read of the report that stands there.
#[derive(Deserialize)]
struct Before {
    schema: String,
    files: BTreeSet<String>,
}

/// What a stopped run left, by its name.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Left {
    /// What stood at NAME.
    Old,
    /// What was being written.
    New,
}

impl Left {
    fn word(self) -> &'static str {
        match self {
            Left::Old => "old",
            Left::New => "new",
        }
    }
}

impl Target {
    /// A folder that is not there, is empty, or holds a report and nothing else; `tell` is told in sentences what earlier runs left
    /// beside it.
    ///
    /// # Errors
    /// If it is none of these, or the folder around it is not there.
    pub fn new(folder: &Path, tell: impl FnMut(&str)) -> Result<Self> {
        Target::checked(folder, tell, |from, to| fs::rename(from, to))
    }

    fn checked(folder: &Path, tell: impl FnMut(&str), rename: impl Fn(&Path, &Path) -> io::Result<()>) -> Result<Self> {
        let refused = |problem: String, cure: &str| Err(Error::invalid("--out", problem, cure));
        let Some(name) = folder.file_name() else {
            return refused(format!("is {}, which is no name of a folder", folder.display()), "name a new folder");
        };
        let around = match folder.parent() {
            Some(around) if around != Path::new("") => around,
            _ => Path::new("."),
        };
        if !around.is_dir() {
            return refused(format!("is in {}, which is no folder", around.display()), "make that folder first");
        }
        let mut target = Target { folder: around.join(name), number: std::process::id() };
        target.take_up(around, tell)?;
        while [Left::Old, Left::New].iter().any(|what| fs::symlink_metadata(target.beside(*what)).is_ok()) {
            target.number = target.number.wrapping_add(1);
        }
        let problem = match fs::symlink_metadata(&target.folder) {
            Err(_) => None,
            Ok(what) if !what.is_dir() => Some("which is no folder".to_string()),
            Ok(_) => stranger(&target.folder)?.map(|file| format!("which holds {file}, and that is not of a report")),
        };
        if let Some(problem) = problem {
            return refused(format!("is {}, {problem}", folder.display()), &target.cure());
        }
        // what cannot be written is known before anything is computed
        let new = target.beside(Left::New);
        fs::create_dir(&new).and_then(|()| fs::remove_dir(&new)).map_err(|source| Error::Write { file: new, source })?;
        if let Err(error) = target.try_to_move(rename) {
            let mount = ", as a mount point cannot";
            let why = if matches!(error.kind(), io::ErrorKind::ResourceBusy | io::ErrorKind::CrossesDevices) { mount } else { "" };
            let problem = format!("is {}, which cannot be put aside ({error}){why}", folder.display());
            return refused(problem, "name a folder inside of it, or take it away");
        }
        Ok(target)
    }

    /// Whether what stands there can be replaced: it goes aside and back.
    fn try_to_move(&self, rename: impl Fn(&Path, &Path) -> io::Result<()>) -> io::Result<()> {
        if !self.folder.exists() {
            return Ok(());
        }
        let old = self.beside(Left::Old);
        rename(&self.folder, &old)?;
        rename(&old, &self.folder).map_err(|error| aside(&old, &error))
    }

    /// What to do about a folder with something else in it.
    fn cure(&self) -> String {
        match stranger(&self.folder) {
            Ok(Some(file)) if !of_report(&self.folder).is_empty() => {
                let path = self.folder.join(&file);
                format!(
                    "take {} away, which some program put into the report, and the report is replaced; or name another folder",
                    path.display()
                )
            }
            _ => "name a new or an empty folder, or one with a report; or take that away".into(),
        }
    }

    /// Puts back what a run that was stopped had set aside, where nothing stands in its place; tells of everything else that such runs
    /// left.
    fn take_up(&self, around: &Path, mut tell: impl FnMut(&str)) -> Result<()> {
        for (what, path) in self.left_by_others(around)? {
            let shown = path.display();
            if let Some(file) = stranger(&path)? {
                tell(&format!("{shown} is of another run and holds {file}, which is not of a report: look at it before you take it away"));
            } else if what == Left::Old && is_whole(&path) && fs::symlink_metadata(&self.folder).is_err() {
                fs::rename(&path, &self.folder).map_err(|source| Error::Write { file: self.folder.clone(), source })?;
                tell(&format!("put the report back that a run which was stopped had set aside as {shown}"));
            } else {
                tell(&format!("{shown} is of another run: if that was stopped, take it away"));
            }
        }
        Ok(())
    }

    /// What runs left beside the folder, the old before the new.
    fn left_by_others(&self, around: &Path) -> Result<Vec<(Left, PathBuf)>> {
        let wrong = |source: io::Error| Error::Read { file: around.into(), source };
        let name = self.folder.file_name().unwrap_or_default().to_string_lossy();
        let mut found = Vec::new();
        for entry in fs::read_dir(around).map_err(wrong)? {
            let entry = entry.map_err(wrong)?;
            let file = entry.file_name().to_string_lossy().into_owned();
            let of_run = |what: &Left| {
                let number = file.strip_prefix(&format!(".{name}.{}-", what.word()));
                number.is_some_and(|number| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()))
            };
            if let Some(what) = [Left::Old, Left::New].into_iter().find(of_run).filter(|_| entry.path().is_dir()) {
                found.push((what, entry.path()));
            }
        }
        found.sort();
        Ok(found)
    }

    /// Writes the files in place of what stood there; `tell` is told where that cannot be taken away afterwards.
    ///
    /// # Errors
    /// If a file cannot be written; then what stood there still stands, or the error says where it is.
    pub fn write(&self, files: &[File], tell: impl FnMut(&str)) -> Result<()> {
        let (new, old) = (self.beside(Left::New), self.beside(Left::Old));
        let wrong = |source: io::Error| Error::Write { file: self.folder.clone(), source };
        // a folder that another one made is not ours to take away
        fs::create_dir(&new).map_err(|source| Error::Write { file: new.clone(), source })?;
        let written = fill(&new, files).and_then(|()| self.replace(&new, &old, tell));
        if written.is_err() {
            let _ = fs::remove_dir_all(&new); // of what was not written nothing stays
        }
        written.map_err(wrong)
    }

    fn replace(&self, new: &Path, old: &Path, mut tell: impl FnMut(&str)) -> io::Result<()> {
        if !self.folder.exists() {
            return fs::rename(new, &self.folder);
        }
        // once more, before and after: somebody may have put something there while the report was computed
        nothing_strange(&self.folder)?;
        fs::rename(&self.folder, old)?;
        if let Err(error) = nothing_strange(old).and_then(|()| fs::rename(new, &self.folder)) {
            fs::rename(old, &self.folder).map_err(|error| aside(old, &error))?;
            return Err(error);
        }
        if let Err(error) = fs::remove_dir_all(old) {
            tell(&format!("what stood there before cannot be taken away whole ({error}): it is {}", old.display()));
        }
        Ok(())
    }

    /// A folder beside this one, of this run.
    fn beside(&self, what: Left) -> PathBuf {
        let name = self.folder.file_name().unwrap_or_default().to_string_lossy();
        self.folder.with_file_name(format!(".{name}.{}-{}", what.word(), self.number))
    }
}

/// What to say where something was put aside and does not go back.
fn aside(old: &Path, error: &io::Error) -> io::Error {
    io::Error::other(format!("what stood there is {} and does not go back: {error}", old.display()))
}

/// An error where a folder holds what no report has written.
fn nothing_strange(folder: &Path) -> io::Result<()> {
    match stranger(folder) {
        Ok(None) => Ok(()),
        Ok(Some(file)) => Err(io::Error::other(format!("{file} was put there meanwhile, and that is not of a report"))),
        Err(error) => Err(io::Error::other(error.to_string())),
    }
}

/// Whether a folder is marked as a report and has all of its files.
fn is_whole(folder: &Path) -> bool {
    let files = of_report(folder);
    !files.is_empty() && files.iter().all(|file| folder.join(file).is_file())
}

/// The files of the report in a folder; none if it is marked as none.
fn of_report(folder: &Path) -> BTreeSet<String> {
    let before = fs::read_to_string(folder.join(FILE)).ok().and_then(|text| serde_json::from_str::<Before>(&text).ok());
    before.filter(|before| before.schema == SCHEMA).map(|before| before.files).unwrap_or_default()
}

/// A file or an empty folder in a folder that no report has written there; none if it is empty or a report.
fn stranger(folder: &Path) -> Result<Option<String>> {
    let present = files(folder, "")?;
    let ours = of_report(folder);
    let is_marked = !ours.is_empty();
    Ok(present.into_iter().find(|file| !(ours.contains(file) || is_marked && file == FILE)))
}

fn fill(folder: &Path, files: &[File]) -> io::Result<()> {
    for file in files {
        let path = folder.join(&file.path);
        if let Some(around) = path.parent() {
            fs::create_dir_all(around)?;
        }
        fs::write(path, &file.text)?;
    }
    Ok(())
}

/// Every file and every empty folder below a folder, by its path from there, with `/`.
fn files(folder: &Path, prefix: &str) -> Result<Vec<String>> {
    let wrong = |source: io::Error| Error::Read { file: folder.into(), source };
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let entry = entry.map_err(wrong)?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type().map_err(wrong)?.is_dir() {
            let below = files(&entry.path(), &format!("{name}/"))?;
            let is_empty = below.is_empty();
            found.extend(if is_empty { vec![format!("{name}/")] } else { below });
        } else {
            found.push(name);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests;
