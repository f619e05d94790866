//! The folder of a report: refused if it holds anything else, and written whole or not at all.
//!
//! ```text
//!     .NAME.new-PID/  ──► NAME        what stood there goes to .NAME.old-PID/ first, and away at the end
//! ```
//! A run that is stopped between the two leaves NAME empty and its report aside: the next run puts that back first.

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
    /// What an earlier run left beside it, as a sentence each.
    left: Vec<String>,
}

/// What is read of the report that stands there.
#[derive(Deserialize)]
struct Before {
    schema: String,
    files: BTreeSet<String>,
}

impl Target {
    /// A folder that is not there, is empty, or holds a report and nothing else.
    ///
    /// # Errors
    /// If it is none of these, or the folder around it is not there.
    pub fn new(folder: &Path) -> Result<Self> {
        Target::checked(folder, |from, to| fs::rename(from, to))
    }

    fn checked(folder: &Path, rename: impl Fn(&Path, &Path) -> io::Result<()>) -> Result<Self> {
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
        let mut target = Target { folder: around.join(name), left: Vec::new() };
        target.left = target.take_up(around)?;
        let problem = match fs::symlink_metadata(&target.folder) {
            Err(_) => None,
            Ok(what) if !what.is_dir() => Some("which is no folder".to_string()),
            Ok(_) => stranger(&target.folder)?.map(|file| format!("which holds {file}, and that is not of a report")),
        };
        if let Some(problem) = problem {
            return refused(format!("is {}, {problem}", folder.display()), &target.cure());
        }
        // what cannot be written is known before anything is computed
        let new = target.beside("new");
        fs::create_dir(&new).and_then(|()| fs::remove_dir(&new)).map_err(|source| Error::Write { file: new, source })?;
        if let Err(error) = target.try_to_move(rename) {
            let problem = format!("is {}, which cannot be put aside ({error}), as a mount point cannot", folder.display());
            return refused(problem, "name a folder inside of it, or take it away");
        }
        Ok(target)
    }

    /// What an earlier run left beside the folder, as a sentence each, for the user.
    pub fn left(&self) -> &[String] {
        &self.left
    }

    /// Whether what stands there can be replaced: it goes aside and back.
    fn try_to_move(&self, rename: impl Fn(&Path, &Path) -> io::Result<()>) -> io::Result<()> {
        if !self.folder.exists() {
            return Ok(());
        }
        let old = self.beside("old");
        rename(&self.folder, &old)?;
        rename(&old, &self.folder)
    }

    /// What to do about a folder with something else in it.
    fn cure(&self) -> String {
        match stranger(&self.folder) {
            Ok(Some(file)) if is_report(&self.folder) => {
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
    fn take_up(&self, around: &Path) -> Result<Vec<String>> {
        let wrong = |source: io::Error| Error::Read { file: around.into(), source };
        let name = self.folder.file_name().unwrap_or_default().to_string_lossy();
        let mut told = Vec::new();
        let mut found: Vec<PathBuf> = Vec::new();
        for entry in fs::read_dir(around).map_err(wrong)? {
            let entry = entry.map_err(wrong)?;
            let file = entry.file_name().to_string_lossy().into_owned();
            let of_run = ["new", "old"].iter().any(|what| {
                let process = file.strip_prefix(&format!(".{name}.{what}-"));
                process.is_some_and(|process| !process.is_empty() && process.bytes().all(|digit| digit.is_ascii_digit()))
            });
            if of_run {
                found.push(entry.path());
            }
        }
        found.sort();
        for path in found {
            if is_report(&path) && stranger(&path)?.is_none() && fs::symlink_metadata(&self.folder).is_err() {
                fs::rename(&path, &self.folder).map_err(|source| Error::Write { file: self.folder.clone(), source })?;
                told.push(format!("put the report back that a run which was stopped had set aside as {}", path.display()));
            } else {
                told.push(format!("{} is of another run: if that was stopped, take it away", path.display()));
            }
        }
        Ok(told)
    }

    /// Writes the files in place of what stood there.
    ///
    /// # Errors
    /// If a file cannot be written; then what stood there still stands.
    pub fn write(&self, files: &[File]) -> Result<()> {
        let (new, old) = (self.beside("new"), self.beside("old"));
        let wrong = |source: io::Error| Error::Write { file: self.folder.clone(), source };
        let written = fill(&new, files).and_then(|()| self.replace(&new, &old));
        if written.is_err() {
            let _ = fs::remove_dir_all(&new); // of what was not written nothing stays
        }
        written.map_err(wrong)
    }

    fn replace(&self, new: &Path, old: &Path) -> io::Result<()> {
        if !self.folder.exists() {
            return fs::rename(new, &self.folder);
        }
        fs::rename(&self.folder, old)?;
        // once more: somebody may have put something there while the report was computed
        let put = match stranger(old) {
            Ok(None) => fs::rename(new, &self.folder),
            Ok(Some(file)) => Err(io::Error::other(format!("{file} was put there meanwhile, and that is not of a report"))),
            Err(error) => Err(io::Error::other(error.to_string())),
        };
        if let Err(error) = put {
            fs::rename(old, &self.folder)?;
            return Err(error);
        }
        fs::remove_dir_all(old)
    }

    /// A folder beside this one, of this process.
    fn beside(&self, what: &str) -> PathBuf {
        let name = self.folder.file_name().unwrap_or_default().to_string_lossy();
        self.folder.with_file_name(format!(".{name}.{what}-{}", std::process::id()))
    }
}

/// Whether a folder is marked as a report.
fn is_report(folder: &Path) -> bool {
    !of_report(folder).is_empty()
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
    fs::create_dir(folder)?;
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
mod tests {
    use super::*;

    /// An empty folder of this test, which goes away with it.
    struct Empty(PathBuf);

    impl Empty {
        fn new(name: &str) -> Self {
            let folder = std::env::temp_dir().join(format!("moreau-report-{name}-{}", std::process::id()));
            fs::create_dir(&folder).expect("a new folder");
            Empty(folder)
        }

        fn names(&self) -> Vec<String> {
            files(&self.0, "").expect("readable")
        }
    }

    impl Drop for Empty {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn report(names: &[&str]) -> Vec<File> {
        let marker = serde_json::json!({"schema": SCHEMA, "files": names}).to_string();
        let mut files: Vec<File> = names.iter().map(|name| File { path: (*name).into(), text: "text".into() }).collect();
        files.push(File { path: FILE.into(), text: marker });
        files
    }

    fn refusal(folder: &Path) -> String {
        Target::new(folder).map(|_| ()).expect_err("refused").to_string()
    }

    #[test]
    fn a_report_is_written_and_replaced_whole() {
        let room = Empty::new("whole");
        let folder = room.0.join("report");
        for names in [&["index.html", "zh/index.html"][..], &["index.html"]] {
            Target::new(&folder).expect("new or a report").write(&report(names)).expect("writable");
            let expected: Vec<String> = names.iter().copied().chain([FILE]).map(|name| format!("report/{name}")).collect();
            let mut found = room.names();
            found.sort_by_key(|name| expected.iter().position(|one| one == name));
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn an_empty_folder_is_taken_and_one_with_something_else_is_not() {
        let room = Empty::new("other");
        assert!(Target::new(&room.0).is_ok());
        fs::write(room.0.join("thesis.tex"), "text").expect("writable");
        let message = refusal(&room.0);
        assert!(message.contains("thesis.tex") && message.contains("name a new or an empty folder"), "{message}");
    }

    #[test]
    fn what_stands_in_a_report_and_is_not_of_it_is_kept() {
        let room = Empty::new("kept");
        let folder = room.0.join("report");
        Target::new(&folder).expect("new").write(&report(&["index.html"])).expect("writable");
        fs::write(folder.join("notes.txt"), "mine").expect("writable");
        assert!(refusal(&folder).contains("notes.txt"));
        fs::write(folder.join(FILE), r#"{"schema": "other/1", "files": ["index.html", "notes.txt"]}"#).expect("writable");
        assert!(Target::new(&folder).is_err(), "another program's report.json marks no report of ours");
    }

    #[test]
    fn a_file_that_some_program_put_into_a_report_is_named_with_the_cure() {
        let room = Empty::new("cure");
        let folder = room.0.join("report");
        Target::new(&folder).expect("new").write(&report(&["index.html"])).expect("writable");
        let dropped = folder.join(".DS_Store");
        fs::write(&dropped, "icons").expect("writable");
        let message = refusal(&folder);
        assert!(message.contains(&format!("take {} away", dropped.display())) && message.contains("is replaced"), "{message}");
        fs::remove_file(&dropped).expect("writable");
        assert!(Target::new(&folder).is_ok(), "the cure cures");
    }

    #[test]
    fn a_report_that_a_stopped_run_set_aside_is_put_back_and_what_else_it_left_is_told() {
        let room = Empty::new("stopped");
        let folder = room.0.join("report");
        Target::new(&folder).expect("new").write(&report(&["index.html"])).expect("writable");
        // stopped between the two renames
        fs::rename(&folder, room.0.join(".report.old-7")).expect("writable");
        fs::create_dir(room.0.join(".report.new-7")).expect("writable");
        fs::create_dir(room.0.join(".report.new-mine")).expect("writable");
        let target = Target::new(&folder).expect("taken up");
        assert!(folder.join("index.html").is_file());
        let told = target.left();
        assert!(told.len() == 2 && told[0].contains(".report.new-7") && told[0].contains("take it away"), "{told:?}");
        assert!(told[1].contains("put the report back") && told[1].contains(".report.old-7"), "{told:?}");
        assert!(room.0.join(".report.new-mine").is_dir(), "a name of somebody else's is not looked at");
    }

    #[test]
    fn what_was_set_aside_is_not_put_over_what_stands_there() {
        let room = Empty::new("both");
        let folder = room.0.join("report");
        Target::new(&folder).expect("new").write(&report(&["index.html"])).expect("writable");
        fs::rename(&folder, room.0.join(".report.old-7")).expect("writable");
        Target::new(&room.0.join("other")).expect("another name").write(&report(&["index.html"])).expect("writable");
        fs::rename(room.0.join("other"), &folder).expect("writable");
        let target = Target::new(&folder).expect("a report");
        assert!(target.left()[0].contains(".report.old-7") && room.0.join(".report.old-7/index.html").is_file());
    }

    #[test]
    fn what_can_be_put_aside_still_stands_where_it_was() {
        let room = Empty::new("aside");
        let folder = room.0.join("report");
        fs::create_dir(&folder).expect("writable");
        assert!(Target::new(&folder).is_ok());
        assert_eq!(room.names(), ["report/"]);
    }

    #[test]
    fn what_cannot_be_put_aside_is_refused_before_anything_is_computed() {
        let room = Empty::new("mount");
        let busy = |_: &Path, _: &Path| Err(io::Error::from(io::ErrorKind::ResourceBusy)); // as a mount point answers
        let message = Target::checked(&room.0, busy).map(|_| ()).expect_err("refused").to_string();
        assert!(message.contains("mount point") && message.contains("name a folder inside of it"), "{message}");
        assert!(Target::checked(&room.0.join("new"), busy).is_ok(), "nothing is put aside where nothing stands");
    }

    #[test]
    fn what_is_put_there_while_the_report_is_computed_is_kept() {
        let room = Empty::new("meanwhile");
        let folder = room.0.join("report");
        let target = Target::new(&folder).expect("new");
        fs::create_dir(&folder).expect("writable");
        fs::write(folder.join("thesis.tex"), "mine").expect("writable");
        let message = target.write(&report(&["index.html"])).expect_err("refused").to_string();
        assert!(message.contains("thesis.tex"), "{message}");
        assert_eq!(room.names(), ["report/thesis.tex"]);
        fs::remove_file(folder.join("thesis.tex")).expect("writable");
        fs::create_dir(folder.join("mine")).expect("writable");
        assert!(target.write(&report(&["index.html"])).is_err(), "an empty folder is somebody's as well");
    }

    #[test]
    fn a_file_and_a_folder_in_no_folder_are_refused() {
        let room = Empty::new("file");
        let file = room.0.join("file");
        fs::write(&file, "text").expect("writable");
        assert!(refusal(&file).contains("no folder"));
        assert!(refusal(&room.0.join("none").join("report")).contains("make that folder first"));
        assert!(refusal(Path::new("..")).contains("no name of a folder"));
    }

    #[test]
    fn what_cannot_be_written_leaves_what_stood_there() {
        let room = Empty::new("broken");
        let folder = room.0.join("report");
        let target = Target::new(&folder).expect("new");
        target.write(&report(&["index.html"])).expect("writable");
        let before = room.names();
        let twice = ["index.html", "index.html/page.html"]; // a file and a folder of one name
        assert!(target.write(&report(&twice)).is_err());
        assert_eq!(room.names(), before);
    }
}
