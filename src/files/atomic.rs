//! Files that are written completely or not at all.

use crate::{Error, Result};
use std::fs::{self, File};
use std::io::{Error as IoError, Write};
use std::path::{Path, PathBuf};

/// Writes a file through a temporary one in the same directory that is renamed when complete, so that a failure leaves what was there.
///
/// # Errors
/// [`Error::Write`] names the file; the temporary file is removed.
pub fn write_atomically(file: &Path, contents: &[u8]) -> Result<()> {
    write_together(&[(file, contents)])
}

/// Writes several files, all of them or none: every one is complete beside its place before the first is renamed.
///
/// # Errors
/// [`Error::Write`] names the first file that could not be written; the temporary files are removed.
pub fn write_together(files: &[(&Path, &[u8])]) -> Result<()> {
    let mut staged: Vec<PathBuf> = Vec::new();
    let written = files
        .iter()
        .try_for_each(|(file, contents)| stage(file, contents, &mut staged).map_err(|source| failed(file, source)))
        .and_then(|()| {
            let mut pairs = staged.iter().zip(files);
            pairs.try_for_each(|(temporary, (file, _))| fs::rename(temporary, file).map_err(|source| failed(file, source)))
        });
    if written.is_err() {
        // a temporary file may never have been created; nothing more can be done about it here
        staged.iter().for_each(|temporary| drop(fs::remove_file(temporary)));
    }
    written
}

fn failed(file: &Path, source: IoError) -> Error {
    Error::Write { file: file.to_path_buf(), source }
}

/// Writes the contents beside the file they are meant for and adds the path to `staged`.
fn stage(file: &Path, contents: &[u8], staged: &mut Vec<PathBuf>) -> std::io::Result<()> {
    let name = file.file_name().ok_or_else(|| IoError::other("the path has no file name"))?;
    if file.is_dir() {
        return Err(IoError::other("it is a directory"));
    }
    let temporary = file.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    staged.push(temporary.clone());
    let mut open = File::create(&temporary)?;
    open.write_all(contents)?;
    open.sync_all()
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
}
