//! What a file is, so that a message can say what was mistaken for what.

use super::progress;
use crate::problem::{Law, Posed, Solution};
use crate::{Error, Result};
use serde::Deserialize;
use std::io::Read;
use std::path::Path;

/// The first bytes of every HDF5 file.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// What is known of a file from its beginning and its `schema`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// HDF5, as FCLIB writes it.
    Hdf5,
    /// Numbers, as Siconos writes them.
    Numbers,
    /// JSON with this schema.
    Json(String),
    /// TOML with this schema.
    Toml(String),
    /// Anything else, or a file that cannot be read twice.
    Unknown,
}

impl Kind {
    /// The kind of a plain file; a pipe is not touched.
    pub fn of(file: &Path) -> Self {
        if !file.is_file() {
            return Kind::Unknown;
        }
        let mut first = Vec::new();
        let opened = std::fs::File::open(file).and_then(|open| open.take(HDF5.len() as u64).read_to_end(&mut first));
        match first.iter().find(|byte| !byte.is_ascii_whitespace()) {
            _ if opened.is_err() => Kind::Unknown,
            _ if first == HDF5 => Kind::Hdf5,
            Some(b'0'..=b'9') => Kind::Numbers,
            Some(b'{') => schema(file, |text| serde_json::from_str(text).ok()).map_or(Kind::Unknown, Kind::Json),
            Some(letter) if letter.is_ascii_alphabetic() || b"#[".contains(letter) => {
                schema(file, |text| toml::from_str(text).ok()).map_or(Kind::Unknown, Kind::Toml)
            }
            _ => Kind::Unknown,
        }
    }

    /// Whether it is an answer and no problem.
    pub fn is_answer(&self) -> bool {
        *self == Kind::Json("solution/1".into())
    }

    /// Whether it is a problem and no answer.
    pub fn is_problem(&self) -> bool {
        match self {
            Kind::Numbers => true,
            Kind::Json(schema) => ["contact-problem/1", "lcp/1"].contains(&schema.as_str()),
            Kind::Hdf5 | Kind::Toml(_) | Kind::Unknown => false,
        }
    }

    /// In words.
    pub fn words(&self) -> String {
        match self {
            Kind::Hdf5 => "an HDF5 file".into(),
            Kind::Numbers => "a problem in the .dat of Siconos".into(),
            Kind::Json(schema) | Kind::Toml(schema) => format!("a {schema}"),
            Kind::Unknown => "of no known kind".into(),
        }
    }
}

/// Whether a file holds a linear complementarity problem, whose numbers have no units.
pub fn is_lcp(file: &Path, posed: &Posed) -> bool {
    match posed {
        Posed::Contacts(problem) if problem.rows_per_contact() == 1 && problem.law() == Law::Frictionless => match Kind::of(file) {
            Kind::Json(schema) => schema == "lcp/1",
            Kind::Numbers => true,
            Kind::Hdf5 | Kind::Toml(_) | Kind::Unknown => false,
        },
        _ => false,
    }
}

/// What every file with a schema begins with.
#[derive(Deserialize)]
struct Head {
    schema: String,
}

fn schema(file: &Path, read: impl FnOnce(&str) -> Option<Head>) -> Option<String> {
    read(&std::fs::read_to_string(file).ok()?).map(|head| head.schema)
}

/// What is done with a file of every schema there is; FILE stands for it.
pub const DONE: [(&str, &str); 11] = [
    ("contact-problem/1", "`moreau solve FILE` takes it"),
    ("lcp/1", "`moreau solve FILE` takes it"),
    ("solution/1", "`moreau certify PROBLEM FILE` takes it"),
    ("scene/1", "`moreau simulate --scene FILE` takes it"),
    ("trajectory/1", "`moreau gate --trajectory FILE` takes it"),
    ("gate-baseline/1", "`moreau gate --baseline FILE -- COMMAND` takes it"),
    ("gate-report/1", "`moreau gate --out` writes it for programs, and no command takes it"),
    ("answered-problem/1", "`moreau problems show` writes it for programs, and no command takes it"),
    ("witnesses/1", "`moreau verify --export` writes it for programs, and no command takes it"),
    ("report/1", "`moreau report` writes it for programs, and no command takes it"),
    ("peers/1", "`scripts/bench_peers.py` writes it for programs, and no command takes it"),
];

/// Which command takes the file that an error is about, where it is of another kind than the one that was read.
pub fn advice(error: &Error) -> Option<String> {
    let (file, kind) = match error {
        Error::InFile { file, inner } if matches!(&**inner, Error::Invalid { field, .. } if MISTAKEN.contains(&field.as_str())) => {
            (file, Kind::of(file))
        }
        // what is no text
        Error::Read { file, .. } if Kind::of(file) == Kind::Hdf5 => (file, Kind::Hdf5),
        _ => return None,
    };
    let done = match &kind {
        // it was read as one: what is wrong is in it
        Kind::Toml(schema) if is_of_baseline(error) && schema == crate::gate::baseline::SCHEMA => return None,
        Kind::Json(schema) | Kind::Toml(schema) => DONE.iter().find(|(known, _)| known == schema)?.1,
        Kind::Hdf5 | Kind::Numbers => DONE[0].1,
        Kind::Unknown => return None,
    };
    Some(format!("it is {}: {}", kind.words(), done.replace("FILE", &file.display().to_string())))
}

/// Whether it is of what reads a baseline.
fn is_of_baseline(error: &Error) -> bool {
    matches!(error, Error::InFile { inner, .. } if matches!(&**inner, Error::Invalid { field, .. } if field == MISTAKEN[1]))
}

/// Fields that are named where a file is of another kind: the schema itself, and what reads TOML has no field for.
const MISTAKEN: [&str; 2] = ["schema", "baseline"];

/// What a file poses; where it is an answer, the error says so.
///
/// # Errors
/// Those of [`Posed::read`], and [`Error::Invalid`] where the file holds an answer.
pub fn read_problem(file: &Path, usage: &str) -> Result<Posed> {
    if file.is_dir() {
        let (problem, folder) = (format!("is {}, a folder", file.display()), file.display());
        return Err(Error::invalid("PROBLEM", problem, format!("give a file in it; `moreau bench {folder}` takes all of them")));
    }
    progress::shown(&progress::word("reading"), || Posed::read(file)).map_err(|error| match Kind::of(file) {
        kind if kind.is_answer() => {
            let problem = format!("is {}, which is {}, an answer and no problem", file.display(), kind.words());
            Error::invalid("PROBLEM", problem, format!("give the problem that it answers: {usage}"))
        }
        _ => error,
    })
}

/// The answer to a problem that a file holds; where it is a problem, the error says so.
///
/// # Errors
/// Those of [`Solution::read_posed`], and [`Error::Invalid`] where the file holds a problem.
pub fn read_solution(file: &Path, posed: &Posed, usage: &str) -> Result<Solution> {
    Solution::read_posed(file, posed).map_err(|error| match Kind::of(file) {
        kind if kind.is_problem() => {
            let found = format!("is {}, which is {}, a problem and no answer", file.display(), kind.words());
            Error::invalid("SOLUTION", found, format!("give a solution/1: {usage}"))
        }
        _ => error,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::schemas::FORMATS;

    #[test]
    fn every_schema_of_a_file_has_its_command() {
        let of_files = FORMATS.iter().filter_map(|format| format.about.split([',', ' ']).next().filter(|name| name.ends_with("/1")));
        let named: Vec<&str> = of_files.collect();
        assert!(named.len() >= 10, "{named:?}");
        for schema in &named {
            assert!(DONE.iter().any(|(known, _)| known == schema), "{schema}");
        }
        assert_eq!(named.len(), DONE.len(), "{named:?}");
    }
}
