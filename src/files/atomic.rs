//! Files that are written completely or not at all.

use crate::{Error, Result};
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

/// Writes a file through a temporary one in the same directory that is renamed when complete, so that a failure leaves what was there.
///
/// # Errors
/// [`Error::Write`] names the file; the temporary file is removed.
pub fn write_atomically(file: &Path, contents: &[u8]) -> Result<()> {
    let failed = |source| Error::Write { file: file.to_path_buf(), source };
    let name = file.file_name().ok_or_else(|| failed(std::io::Error::other("the path has no file name")))?;
    let temporary = file.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = File::create(&temporary).and_then(|mut open| {
        open.write_all(contents)?;
        open.sync_all()?;
        fs::rename(&temporary, file)
    });
    written.map_err(|source| {
        // the temporary file may never have been created; nothing more can be done about it here
        let _ = fs::remove_file(&temporary);
        failed(source)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let mut names: Vec<_> = fs::read_dir(&directory).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["answer.json", "taken"]);
        fs::remove_dir_all(&directory).unwrap();
    }
}
