//! The folder of a report: refused if it holds anything else, and written whole or not at all.
//!
//! ```text
//!     .NAME.new-PID/  ──► NAME        what stood there goes to .NAME.old-PID/ first, and away at the end
//! ```

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
        let target = Target { folder: around.join(name) };
        let problem = match fs::symlink_metadata(&target.folder) {
            Err(_) => None,
            Ok(what) if !what.is_dir() => Some("which is no folder".to_string()),
            Ok(_) => stranger(&target.folder)?.map(|file| format!("which holds {file}, and that is not of a report")),
        };
        if let Some(problem) = problem {
            return refused(
                format!("is {}, {problem}", folder.display()),
                "name a new or an empty folder, or one with a report; or take that away",
            );
        }
        // what cannot be written is known before anything is computed
        let new = target.beside("new");
        fs::create_dir(&new).and_then(|()| fs::remove_dir(&new)).map_err(|source| Error::Write { file: new, source })?;
        Ok(target)
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

/// A file or an empty folder in a folder that no report has written there; none if it is empty or a report.
fn stranger(folder: &Path) -> Result<Option<String>> {
    let present = files(folder, "")?;
    let before = fs::read_to_string(folder.join(FILE)).ok().and_then(|text| serde_json::from_str::<Before>(&text).ok());
    let ours = before.filter(|before| before.schema == SCHEMA).map(|before| before.files).unwrap_or_default();
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
