//! A large `contact-problem/1` that is parsed while it is read, so that its text never stands in the memory beside its numbers.
//!
//! Only what is right is read so. Whatever is wrong, and every other kind of file, is read as a text, which messages quote.

use super::file::{PROBLEM_SCHEMA, ProblemFile};
use crate::memory;
use crate::tolerance::limits::{FILE_PART, STREAMED_BYTES};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

/// A number of a text that is read: in its list, which may be twice as long as it is full, and in its matrix \[bytes\].
pub(super) const NUMBER_BYTES: u128 = 24;
/// What the memory is for.
pub(super) const READING: &str = "reading this problem";

/// How many numbers a text has, but for the last of each list.
pub(super) fn commas(text: &[u8]) -> u128 {
    text.iter().filter(|byte| **byte == b',').count() as u128
}

/// The fields of a plain file of more than [`STREAMED_BYTES`]; nothing where it is smaller, larger than `limit`, or anything is wrong.
pub(super) fn read(file: &Path, limit: u64) -> Option<ProblemFile> {
    let open = File::open(file).ok()?;
    let metadata = open.metadata().ok()?;
    if !metadata.is_file() || !(STREAMED_BYTES..=limit).contains(&metadata.len()) {
        return None;
    }
    parsed(open.take(metadata.len()))
}

/// The fields of a text, if it is right and its numbers have room.
fn parsed(text: impl Read) -> Option<ProblemFile> {
    let reader = BufReader::with_capacity(FILE_PART, Counted { text, commas: 0 });
    let fields: ProblemFile = serde_json::from_reader(reader).ok()?;
    (fields.schema == PROBLEM_SCHEMA).then_some(fields)
}

/// A text whose numbers are counted as it is read, by their commas; it ends where they have no room.
struct Counted<R> {
    text: R,
    commas: u128,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, part: &mut [u8]) -> std::io::Result<usize> {
        let count = self.text.read(part)?;
        self.commas += commas(&part[..count]);
        memory::require(READING, NUMBER_BYTES * self.commas).map_err(std::io::Error::other)?;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ContactProblem, Posed};
    use super::*;

    const HEAD: &str = r#"{"schema":"contact-problem/1","name":"many","dimension":1,"law":"frictionless","#;

    /// Contacts that nothing couples, W by blocks, as long a text as is asked for.
    fn text(contacts: usize) -> String {
        let list = |one: &dyn Fn(usize) -> String| (0..contacts).map(one).collect::<Vec<_>>().join(",");
        let [places, friction, free] = [list(&|k| k.to_string()), list(&|_| "0".into()), list(&|k| format!("-0.1{k}"))];
        let value = list(&|k| format!("1.{k}"));
        let blocks = format!(r#""blocks":{{"row":[{places}],"column":[{places}],"value":[{value}]}}"#);
        format!(r#"{HEAD}"friction":[{friction}],"free_velocity":[{free}],"delassus":{{"shape":[{contacts},{contacts}],{blocks}}}}}"#)
    }

    #[test]
    fn what_is_streamed_is_what_is_read_as_a_text() {
        let text = text(50);
        let streamed = parsed(text.as_bytes()).expect("well formed");
        assert_eq!(ContactProblem::of_file(streamed).expect("valid"), ContactProblem::from_json(&text).expect("valid"));
        for wrong in
            [text.replace("many", "ma\u{fffd}ny\"x"), text.replace("contact-problem/1", "lcp/1"), text.clone() + "}", text[..900].into()]
        {
            assert!(parsed(wrong.as_bytes()).is_none());
        }
    }

    /// A file above the limit has the same problem, and the same message, as its text.
    #[test]
    fn large_files_have_the_messages_of_their_texts() {
        let file = std::env::temp_dir().join(format!("moreau-streamed-{}.json", std::process::id()));
        let text = text(300_000);
        assert!(text.len() as u64 > STREAMED_BYTES);
        std::fs::write(&file, &text).expect("a folder for temporary files");
        assert!(read(&file, u64::MAX).is_some() && read(&file, 1000).is_none());
        assert_eq!(Posed::read(&file).expect("valid"), Posed::from_json(&text).expect("valid"));
        for (right, wrong) in [("-0.1777,", "-0.1777x,"), ("\"law\"", "\"lax\""), ("\"column\":[0,", "\"column\":[0,[")] {
            let wrong = text.replace(right, wrong);
            std::fs::write(&file, &wrong).expect("a folder for temporary files");
            let message = Posed::read(&file).expect_err("wrong").to_string();
            let own = Posed::from_json(&wrong).expect_err("wrong").to_string();
            assert!(message.ends_with(&own) && message.contains("moreau-streamed"), "{message}");
        }
        std::fs::remove_file(&file).expect("it was written");
    }
}
