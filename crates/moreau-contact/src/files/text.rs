//! Reading text up to a limit of size. A file that is too large is refused before it is read. A stream is refused as soon as it passes the
//! limit.

use crate::memory::size;
use crate::tolerance::limits::{FILE_BYTES, FILE_PART};
use moreau_exact::{Error, Result};
use std::fs::File;
use std::io::{Error as IoError, ErrorKind, Read};
use std::path::Path;

/// Refuses a name that a terminal would obey.
///
/// # Errors
/// [`Error::Invalid`] names the field.
/// ```
/// use moreau_contact::files::printable;
///
/// assert!(printable("name", "Kiste Ä").is_ok() && printable("name", "\u{1b}[2J").is_err());
/// ```
pub fn printable(field: &str, text: &str) -> Result<()> {
    if text.chars().any(char::is_control) {
        return Err(Error::invalid(field, format!("is {text:?}"), "use a text without control characters, which terminals obey"));
    }
    Ok(())
}

/// The text of a file, of at most [`FILE_BYTES`].
///
/// # Errors
/// [`Error::Read`] if it cannot be read or is not text; [`Error::InFile`] around the size if it is too large.
pub fn read_text(file: &Path) -> Result<String> {
    read_text_within(file, FILE_BYTES, "split it")
}

/// The text of a file of at most `limit` bytes; `cure` tells what to do about a larger one.
///
/// A plain file is measured before it is read. A device or a pipe has no size: it is read up to the limit, and no further than its first
/// byte 0, which no text holds.
///
/// # Errors
/// Those of [`read_text`].
fn read_text_within(file: &Path, limit: u64, cure: &str) -> Result<String> {
    read_while(file, limit, cure, |_| true)
}

/// The text of a file of at most [`FILE_BYTES`] that is to hold a JSON object: where it begins with something else, only its beginning.
///
/// # Errors
/// Those of [`read_text`].
pub fn read_json(file: &Path) -> Result<String> {
    read_beginning(file, FILE_BYTES, "split it", |byte| byte == b'{')
}

/// The text of a file of at most `limit` bytes that is to hold a JSON object or a list of numbers: where it begins with something else,
/// only its beginning.
///
/// # Errors
/// Those of [`read_text`].
pub fn read_problem(file: &Path, limit: u64, cure: &str) -> Result<String> {
    read_beginning(file, limit, cure, |byte| byte == b'{' || byte.is_ascii_digit())
}

fn read_beginning(file: &Path, limit: u64, cure: &str, sensible: impl Fn(u8) -> bool) -> Result<String> {
    let blank = |byte: &u8| byte.is_ascii_whitespace();
    read_while(file, limit, cure, |start| start.iter().find(|byte| !blank(byte)).is_none_or(|byte| sensible(*byte)))
}

fn read_while(file: &Path, limit: u64, cure: &str, sensible: impl Fn(&[u8]) -> bool) -> Result<String> {
    let failed = |source| Error::Read { file: file.to_path_buf(), source };
    let too_large =
        |bytes: String| Error::invalid("size", format!("is {bytes}"), format!("at most {} are read; {cure}", size(limit.into())));
    if file.is_dir() {
        return Err(failed(IoError::new(ErrorKind::IsADirectory, "it is a folder; give a file in it")));
    }
    let open = File::open(file).map_err(failed)?;
    let metadata = open.metadata().map_err(failed)?;
    if metadata.is_file() && metadata.len() > limit {
        return Err(too_large(size(metadata.len().into())).in_file(file));
    }
    let bytes = read_up_to(open, limit, sensible).map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(format!("more than {}", size(limit.into()))).in_file(file));
    }
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        failed(IoError::new(ErrorKind::InvalidData, format!("the file is not text in UTF-8 at byte {place}; save it as UTF-8")))
    })
}

/// All bytes of the source, but at most one more than the limit. Reading stops early if the first part is not `sensible`.
fn read_up_to(source: impl Read, limit: u64, sensible: impl Fn(&[u8]) -> bool) -> std::io::Result<Vec<u8>> {
    let mut source = source.take(limit.saturating_add(1));
    let (mut bytes, mut part) = (Vec::new(), vec![0; FILE_PART]);
    loop {
        let count = match source.read(&mut part) {
            Ok(0) => return Ok(bytes),
            Ok(count) => count,
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        if part[..count].contains(&0) {
            return Err(IoError::new(
                ErrorKind::InvalidData,
                "the file is not text, because it holds a byte 0; give a text file, in UTF-8",
            ));
        }
        let is_first = bytes.is_empty();
        bytes.extend_from_slice(&part[..count]);
        if is_first && !sensible(&bytes) {
            return Ok(bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_file(contents: &[u8], check: impl Fn(&Path)) {
        let file = std::env::temp_dir().join(format!("moreau-text-{}-{}", std::process::id(), contents.len()));
        std::fs::write(&file, contents).unwrap();
        check(&file);
        std::fs::remove_file(&file).unwrap();
    }

    #[test]
    fn a_file_of_the_largest_size_is_read_and_one_byte_more_is_not() {
        with_file(b"12345678", |file| {
            assert_eq!(read_text_within(file, 8, "").expect("as large as it may be"), "12345678");
            let message = read_text_within(file, 7, "cut it").expect_err("too large").to_string();
            assert!(message.contains("is 8 B") && message.contains("at most 7 B are read; cut it"), "{message}");
        });
    }

    #[test]
    fn what_is_not_text_is_refused() {
        with_file(b"a\0b", |file| assert!(read_text(file).expect_err("a byte 0").to_string().contains("not text")));
        with_file(&[b'a', 0xff], |file| assert!(read_text(file).expect_err("no UTF-8").to_string().contains("cannot read")));
    }

    #[test]
    fn a_folder_is_told_by_that_word() {
        let message = read_text(&std::env::temp_dir()).expect_err("a folder").to_string();
        assert!(message.contains("it is a folder; give a file in it"), "{message}");
    }

    #[test]
    fn a_source_without_an_end_is_left_at_the_limit() {
        let endless = std::io::repeat(b'x');
        assert_eq!(read_up_to(endless, 200_000, |_| true).expect("readable").len(), 200_001);
        assert!(read_up_to(std::io::repeat(b'x'), u64::MAX, |start| start[0] == b'{').expect("readable").len() <= 1 << 16);
        // zeros end at once, whatever the limit
        assert!(read_up_to(std::io::repeat(0), u64::MAX, |_| true).is_err());
    }

    /// A file of this length that occupies nothing on the disk.
    #[test]
    fn a_file_beyond_the_limit_is_refused_without_reading_it() {
        let file = std::env::temp_dir().join(format!("moreau-hollow-{}", std::process::id()));
        let hollow = std::fs::File::create(&file).unwrap();
        hollow.set_len(FILE_BYTES + 1).unwrap();
        let message = read_text(&file).expect_err("too large").to_string();
        assert!(message.contains("256.0 MB are read"), "{message}");
        hollow.set_len(FILE_BYTES).unwrap();
        assert!(read_text(&file).expect_err("zeros").to_string().contains("not text"), "of the right size, it is looked at");
        std::fs::remove_file(&file).unwrap();
    }
}
