//! The built command, seen from outside: exit codes, messages, shapes of output, and that an error writes nothing.

mod advice;
mod bench;
mod certify;
mod compare;
mod convert;
mod counted;
mod explorer;
mod folders;
mod gate;
mod help;
mod joints;
mod keys;
mod limits;
mod new;
mod numbers;
mod paths;
mod problems;
mod report;
mod schema;
mod scoreboard;
mod shell;
mod simulate;
mod simulate_page;
mod solve;
mod steps;
mod systems;
mod terminal;
mod told;
mod verify;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What one run of the command left behind.
struct Run {
    code: i32,
    output: String,
    message: String,
}

impl Run {
    /// Exit code 2, nothing on standard output, and one message that holds all the words.
    #[track_caller]
    fn is_refused(&self, words: &[&str]) {
        assert_eq!((self.code, self.output.as_str()), (2, ""), "{}", self.message);
        assert!(self.message.starts_with("error: ") && self.message.trim_end().lines().count() == 1, "one message: {}", self.message);
        for word in words {
            assert!(self.message.contains(word), "{word:?} is missing in {}", self.message);
        }
    }

    #[track_caller]
    fn json(&self) -> Value {
        assert!(!self.output.contains("NaN") && !self.output.contains("Infinity"));
        serde_json::from_str(&self.output).unwrap_or_else(|error| panic!("{error}: {}{}", self.output, self.message))
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_moreau"));
    command.args(arguments).stdin(Stdio::null());
    command
}

fn moreau(arguments: &[&str]) -> Run {
    let output = command(arguments).output().expect("the built command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    Run { code: output.status.code().expect("not killed"), output: text(output.stdout), message: text(output.stderr) }
}

/// A directory of its own for one test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cli-{test}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("the target directory is writable");
        Folder(path)
    }

    /// The path of a file in it, as an argument.
    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("UTF-8").into()
    }

    /// Writes a file and gives its path.
    fn file(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.join(name), text).expect("a writable folder");
        self.path(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("a readable folder");
        let mut names: Vec<_> = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A block of 1 kg that arrives at 1 m/s and slides at 2 m/s with μ = 1/2: r = (1, −1/2), u = (0, 3/2).
const PROBLEM: &str = r#"{"schema": "contact-problem/1", "name": "block", "dimension": 2, "law": "coulomb",
  "friction": [0.5], "free_velocity": [-1, 2], "delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}}"#;

#[test]
fn help_teaches_by_examples_and_no_argument_is_a_usage_error() {
    for command in ["verify", "solve", "certify", "simulate"] {
        let run = moreau(&[command, "--help"]);
        assert_eq!(run.code, 0);
        assert!(run.output.contains(&format!("moreau {command}")) && run.output.contains("Examples:"), "{}", run.output);
    }
    assert_eq!(moreau(&["--help"]).code, 0);
    for usage in [&[][..], &["prove"], &["verify", "--format", "xml"], &["solve"], &["simulate"]] {
        let run = moreau(usage);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{usage:?}");
        assert!(!run.message.is_empty(), "{usage:?}");
    }
}
