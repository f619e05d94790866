//! Files that are written completely or not at all.

use moreau_exact::{Error, Result};
use std::fs::{self, File, OpenOptions};
use std::io::{Error as IoError, Write};
use std::path::{Path, PathBuf};

/// Writes a file through a temporary one in the same directory that is renamed when complete, so that a failure leaves what was there.
/// A link stays a link. A device or a pipe (`/dev/stdout`, `/dev/null`) is written to, never replaced.
///
/// # Errors
/// [`Error::Write`] names the file; the temporary file is removed.
pub fn write_atomically(file: &Path, contents: &[u8]) -> Result<()> {
    write_together(&[(file, contents)])
}

/// Writes several files, all of them or none: every one is complete beside its place before the first is renamed.
///
/// # Errors
/// [`Error::Write`] names the first file that could not be written, or that is given twice; the temporary files are removed.
pub fn write_together(files: &[(&Path, &[u8])]) -> Result<()> {
    let mut staged: Vec<Staged> = Vec::new();
    let written = files
        .iter()
        .try_for_each(|(file, contents)| stage(file, contents, &mut staged).map_err(|source| failed(file, source)))
        .and_then(|()| staged.iter().zip(files).try_for_each(|(place, (file, _))| place.commit().map_err(|source| failed(file, source))));
    if written.is_err() {
        staged.iter().for_each(Staged::discard);
    }
    written
}

/// Whether two paths lead to one file, through links and different spellings; false if a folder does not exist.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((destination(a), destination(b)), (Ok(a), Ok(b)) if a == b)
}

fn failed(file: &Path, source: IoError) -> Error {
    Error::Write { file: file.to_path_buf(), source }
}

/// Contents on their way to a file.
enum Staged<'a> {
    /// The contents are complete in a temporary file, which stands beside the final place.
    Beside { temporary: PathBuf, place: PathBuf },
    /// The contents go to a device or a pipe, which cannot be replaced.
    Stream { place: PathBuf, contents: &'a [u8] },
}

impl Staged<'_> {
    fn commit(&self) -> std::io::Result<()> {
        match self {
            Staged::Beside { temporary, place } => fs::rename(temporary, place),
            Staged::Stream { place, contents } => OpenOptions::new().write(true).open(place)?.write_all(contents),
        }
    }

    fn discard(&self) {
        if let Staged::Beside { temporary, .. } = self {
            // it may never have been created; nothing more can be done about it here
            let _ = fs::remove_file(temporary);
        }
    }
}

/// Writes the contents to a temporary file beside `file` and adds it to `staged`.
fn stage<'a>(file: &Path, contents: &'a [u8], staged: &mut Vec<Staged<'a>>) -> std::io::Result<()> {
    if let Ok(metadata) = fs::metadata(file) {
        if metadata.is_dir() {
            return Err(IoError::other("it is a folder; name a file in it"));
        }
        if !metadata.is_file() {
            staged.push(Staged::Stream { place: file.into(), contents });
            return Ok(());
        }
        if metadata.permissions().readonly() {
            return Err(IoError::other("the file is read-only; make it writable, or name another file"));
        }
    } else if fs::symlink_metadata(file).is_ok_and(|link| link.is_symlink()) {
        return Err(IoError::other("it is a link that leads nowhere; make what it leads to, or name another file"));
    }
    let place = destination(file)?;
    if staged.iter().any(|other| matches!(other, Staged::Beside { place: taken, .. } if *taken == place)) {
        return Err(IoError::other("two results are to go to this file; give each its own"));
    }
    let name = place.file_name().ok_or_else(no_name)?.to_string_lossy();
    let temporary = place.with_file_name(format!(".{name}.{}.part", std::process::id()));
    staged.push(Staged::Beside { temporary: temporary.clone(), place });
    let mut open = File::create(&temporary)?;
    open.write_all(contents)?;
    open.sync_all()
}

/// The place a path leads to: links followed, and the folder resolved where the file does not exist yet.
fn destination(file: &Path) -> std::io::Result<PathBuf> {
    fs::canonicalize(file).or_else(|_| {
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok(fs::canonicalize(folder)?.join(file.file_name().ok_or_else(no_name)?))
    })
}

fn no_name() -> IoError {
    IoError::other("the path has no file name; name a file")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<std::ffi::OsString> {
        let mut names: Vec<_> = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_no_temporary_one() {
        let directory = std::env::temp_dir().join(format!("moreau-atomic-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        let file = directory.join("answer.json");
        write_atomically(&file, b"old").unwrap();
        write_atomically(&file, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert!(write_atomically(&directory.join("missing").join("answer.json"), b"x").is_err());
        // a directory cannot be replaced by a file
        let taken = directory.join("taken");
        fs::create_dir_all(&taken).unwrap();
        assert!(write_atomically(&taken, b"x").is_err());
        assert_eq!(names(&directory), ["answer.json", "taken"]);
        fs::remove_dir_all(&directory).unwrap();
    }

    #[test]
    fn of_several_files_all_are_written_or_none() {
        let directory = std::env::temp_dir().join(format!("moreau-together-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        let (first, second) = (directory.join("first"), directory.join("second"));
        assert!(write_together(&[(&first, b"1"), (&directory.join("missing").join("second"), b"2")]).is_err());
        assert!(names(&directory).is_empty());
        write_together(&[(&first, b"1"), (&second, b"2")]).unwrap();
        assert_eq!((fs::read(&first).unwrap(), fs::read(&second).unwrap()), (b"1".to_vec(), b"2".to_vec()));
        assert_eq!(names(&directory), ["first", "second"]);
        fs::remove_dir_all(&directory).unwrap();
    }

    #[test]
    fn one_file_under_two_names_is_one_file_and_is_not_written_twice() {
        let directory = std::env::temp_dir().join(format!("moreau-twice-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        let (plain, roundabout) = (directory.join("a"), directory.join(".").join("..").join(directory.file_name().unwrap()).join("a"));
        assert!(is_same_file(&plain, &roundabout) && !is_same_file(&plain, &directory.join("b")));
        let message = write_together(&[(&plain, b"1"), (&roundabout, b"2")]).unwrap_err().to_string();
        assert!(message.contains("two results"), "{message}");
        assert!(names(&directory).is_empty());
        fs::remove_dir_all(&directory).unwrap();
    }

    #[test]
    fn a_read_only_file_is_kept() {
        let directory = std::env::temp_dir().join(format!("moreau-read-only-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        let file = directory.join("kept");
        fs::write(&file, b"old").unwrap();
        let writable = fs::metadata(&file).unwrap().permissions();
        let mut locked = writable.clone();
        locked.set_readonly(true);
        fs::set_permissions(&file, locked).unwrap();
        let message = write_atomically(&file, b"new").unwrap_err().to_string();
        assert!(message.contains("read-only"), "{message}");
        assert_eq!((fs::read(&file).unwrap(), names(&directory)), (b"old".to_vec(), vec!["kept".into()]));
        fs::set_permissions(&file, writable).unwrap();
        fs::remove_dir_all(&directory).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_plain_file_is_written_to_and_stays_what_it_is() {
        let directory = std::env::temp_dir().join(format!("moreau-stream-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        // a link to a file stays a link, and the file gets the contents
        let (target, link) = (directory.join("target"), directory.join("link"));
        fs::write(&target, b"old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_atomically(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&target).unwrap(), b"new");
        // one that leads nowhere is not replaced
        let nowhere = directory.join("nowhere");
        std::os::unix::fs::symlink(directory.join("missing"), &nowhere).unwrap();
        assert!(write_atomically(&nowhere, b"x").unwrap_err().to_string().contains("leads nowhere"));
        assert!(fs::symlink_metadata(&nowhere).unwrap().is_symlink());
        fs::remove_file(&nowhere).unwrap();
        // a socket is neither file nor folder: it cannot be opened for writing, and above all it is not replaced
        let socket = directory.join("s");
        let _bound = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        assert!(write_atomically(&socket, b"x").is_err());
        assert!(!fs::metadata(&socket).unwrap().is_file());
        assert_eq!(names(&directory), ["link", "s", "target"]);
        fs::remove_dir_all(&directory).unwrap();
    }
}
