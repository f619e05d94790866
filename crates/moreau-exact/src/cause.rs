//! Why a file cannot be read or written, with what to do about it.

use std::io::{Error, ErrorKind};
use std::path::Path;

/// Of a file that is to be read.
pub(crate) fn of_reading(file: &Path, error: &Error) -> String {
    let known = match error.kind() {
        ErrorKind::NotFound if file == Path::new("-") => "there is no such file; for standard input name /dev/stdin",
        ErrorKind::NotFound => "there is no such file; look at its name, and at the folder in which it is looked for",
        ErrorKind::PermissionDenied => "it may not be read; change its permissions, or give a copy that may",
        ErrorKind::IsADirectory => "it is a folder; give a file in it",
        _ => return of_both(error),
    };
    told(error, known)
}

/// Of a file that is to be written.
pub(crate) fn of_writing(file: &Path, error: &Error) -> String {
    let known = match error.kind() {
        ErrorKind::NotFound if file.parent().is_some_and(|folder| folder.as_os_str().is_empty() || folder.is_dir()) => {
            "its folder takes no new files; name another folder"
        }
        ErrorKind::NotFound => "its folder is not there; make the folder, or name another one",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "it may not be written there; name another folder",
        ErrorKind::IsADirectory => "it is a folder; name a file in it",
        ErrorKind::AlreadyExists => "a file is there, and a folder is meant; name another folder, or take the file away",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "there is no room left; make room, or name a place that has some",
        _ => return of_both(error),
    };
    told(error, known)
}

fn of_both(error: &Error) -> String {
    let known = match error.kind() {
        ErrorKind::NotADirectory => "a part of its path is a file and no folder; look at the path",
        ErrorKind::InvalidFilename => "no file can have this name; give a shorter one, or one with other letters",
        _ => {
            // the system's own words, without its number
            let said = error.to_string();
            let said = said.split(" (os error").next().unwrap_or_default();
            return if error.get_ref().is_some() { said.into() } else { format!("{said}; look at the file, or name another one") };
        }
    };
    told(error, known)
}

/// What this project says of the file itself, or else what is known of the kind.
fn told(error: &Error, known: &str) -> String {
    if error.get_ref().is_some() { error.to_string() } else { known.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cause_has_a_cure_and_none_the_number_of_the_system() {
        // no such file, no permission, a file as a folder, a folder as a file, there already, no room, too many links, a long name
        let file = Path::new("nowhere/at.json");
        for number in [2, 13, 20, 21, 17, 28, 40, 36, 5] {
            let error = Error::from_raw_os_error(number);
            for text in [of_reading(file, &error), of_writing(file, &error)] {
                assert!(text.contains("; ") && !text.contains("os error"), "{number}: {text}");
            }
        }
        let bare = Error::from(ErrorKind::NotFound);
        assert!(of_reading(file, &bare).contains("no such file") && of_writing(file, &bare).contains("make the folder"));
        assert!(of_reading(Path::new("-"), &bare).contains("/dev/stdin") && !of_reading(file, &bare).contains("/dev/stdin"));
        // here is a folder in which something is not found all the same
        assert!(of_writing(Path::new("here.json"), &bare).contains("takes no new files"));
    }

    #[test]
    fn what_is_said_of_the_file_itself_stays() {
        let own = Error::new(ErrorKind::IsADirectory, "it is a folder of answers; give one");
        assert_eq!([of_reading(Path::new("-"), &own), of_writing(Path::new("-"), &own)], ["it is a folder of answers; give one"; 2]);
        assert_eq!(of_reading(Path::new("-"), &Error::new(ErrorKind::InvalidData, "no text; save it again")), "no text; save it again");
    }
}
