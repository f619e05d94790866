//! What a file is, so that a message can say what was mistaken for what.

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
            Some(b'{') => schema(file).map_or(Kind::Unknown, Kind::Json),
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
            Kind::Hdf5 | Kind::Unknown => false,
        }
    }

    /// In words.
    pub fn words(&self) -> String {
        match self {
            Kind::Hdf5 => "an HDF5 file".into(),
            Kind::Numbers => "a problem in the .dat of Siconos".into(),
            Kind::Json(schema) => format!("a {schema}"),
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
            Kind::Hdf5 | Kind::Unknown => false,
        },
        _ => false,
    }
}

fn schema(file: &Path) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        schema: String,
    }
    let text = std::fs::read_to_string(file).ok()?;
    serde_json::from_str::<Head>(&text).ok().map(|head| head.schema)
}

/// What a file poses; where it is an answer, the error says so.
///
/// # Errors
/// Those of [`Posed::read`], and [`Error::Invalid`] where the file holds an answer.
pub fn read_problem(file: &Path, usage: &str) -> Result<Posed> {
    if file.is_dir() {
        let (problem, folder) = (format!("is {}, a folder", file.display()), file.display());
        return Err(Error::invalid("PROBLEM", problem, format!("give a file in it; `moreau bench {folder}` takes all of them")));
    }
    Posed::read(file).map_err(|error| match Kind::of(file) {
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
