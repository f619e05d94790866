//! JSON Schemas of every message and file format, generated from the types that read and write them.
//!
//! A schema says which fields there are and of what kind; sizes that must agree, unit lengths and the like are checked by the readers.

use super::answers::Answers;
use super::bench::Bench;
use super::certificate::Certificate;
use super::comparison::Comparison;
use super::json::{ClaimEntry, ExplanationEntry, OutcomeEntry};
use super::lcp_proof::Counted;
use super::no_answer::NoAnswer;
use super::peers::PeerReport;
use super::problems::Line;
use super::site::document::ReportDocument;
use super::summary::MotionSummary;
use super::witnesses::WitnessDocument;
use crate::gate::baseline::Baseline;
use crate::gate::conformance::Conformance;
use crate::gate::process::messages::{Points, ReplyForm, Request};
use crate::gate::{Description, Report};
use crate::problem::{LcpFile, ProblemFile, SolutionFile};
use crate::problems::{Measured, Record};
use crate::scenes::Scene;
use crate::systems;
use crate::trajectory::Trajectory;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;

/// A message or file with its schema.
pub struct Format {
    /// Its name, that of the file `schemas/<name>.schema.json`.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    generate: fn() -> schemars::Schema,
}

/// Every message and file format.
pub const FORMATS: [Format; 29] = [
    Format { name: "request", about: "a line from the gate to an engine", generate: written::<Request> },
    Format { name: "reply", about: "the line that answers it", generate: read::<ReplyForm> },
    Format { name: "description", about: "the result of `describe`", generate: read::<Description> },
    Format { name: "scene", about: "scene/1, what is simulated", generate: read::<Scene> },
    Format { name: "trajectory", about: "trajectory/1, the result of `simulate`", generate: read::<Trajectory> },
    Format { name: "contact-problem", about: "contact-problem/1, what is solved", generate: read::<ProblemFile> },
    Format {
        name: "lcp",
        about: "lcp/1, a linear complementarity problem, which is solved as frictionless contacts",
        generate: read::<LcpFile>,
    },
    Format { name: "solution", about: "solution/1, the result of `solve`", generate: read::<SolutionFile> },
    Format {
        name: "certificate",
        about: "what `moreau certify` writes, and `moreau solve` beside its answer: on standard output with --out, else on standard error",
        generate: written::<Certificate>,
    },
    Format { name: "answers", about: "what `moreau solve FOLDER` and `moreau certify FOLDER` write", generate: written::<Answers> },
    Format {
        name: "no-answer",
        about: "what `solve` and `simulate` write where a solver gave no answer, and `certify` where there is none",
        generate: written::<NoAnswer>,
    },
    Format {
        name: "lcp-count",
        about: "what `moreau certify --prove` writes of a linear complementarity problem without an answer",
        generate: written::<Counted>,
    },
    Format { name: "simulation", about: "what `moreau simulate` writes", generate: written::<MotionSummary> },
    Format { name: "measured-problem", about: "what `moreau problems measure` writes", generate: written::<Measured> },
    Format { name: "peers", about: "peers/1, what `scripts/bench_peers.py` writes", generate: read::<PeerReport> },
    Format { name: "bench", about: "what `moreau bench` writes", generate: written::<Bench> },
    Format { name: "problems", about: "what `moreau problems list` writes", generate: written::<Vec<Line>> },
    Format {
        name: "answered-problem",
        about: "answered-problem/1, the record of a problem of the collection, what `moreau problems show` writes",
        generate: read::<Record>,
    },
    Format { name: "points", about: "the result of `project`", generate: read::<Points> },
    Format { name: "gate-report", about: "gate-report/1, what `moreau gate` writes", generate: written::<Report> },
    Format { name: "gate-baseline", about: "gate-baseline/1, in TOML", generate: read::<Baseline> },
    Format { name: "protocol-check", about: "what `moreau protocol-check` writes", generate: written::<Conformance> },
    Format { name: "systems", about: "what `moreau systems` writes", generate: written::<systems::Report> },
    Format { name: "verify", about: "what `moreau verify` writes", generate: written::<Vec<OutcomeEntry>> },
    Format { name: "verify-list", about: "what `moreau verify --list` writes", generate: written::<Vec<ClaimEntry>> },
    Format { name: "verify-explain", about: "what `moreau verify --explain` writes", generate: written::<ExplanationEntry> },
    Format { name: "witnesses", about: "witnesses/1, what `moreau verify --export` writes", generate: written::<WitnessDocument> },
    Format { name: "report", about: "report/1, what `moreau report` writes for programs", generate: written::<ReportDocument> },
    Format { name: "comparison", about: "what `moreau compare` writes", generate: written::<Comparison> },
];

impl Format {
    /// The text of its schema.
    pub fn schema(&self) -> String {
        let schema = (self.generate)();
        let text = serde_json::to_string_pretty(&schema).expect("a schema is JSON") + "\n";
        // the documentation's `\[s\]` is `[s]` to a reader of the schema
        text.replace(r"\\[", "[").replace(r"\\]", "]")
    }

    /// The name of its file.
    pub fn file(&self) -> String {
        format!("{}.schema.json", self.name)
    }
}

/// The schema of what is read: fields with a default may be missing.
fn read<T: JsonSchema>() -> schemars::Schema {
    SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>()
}

/// The schema of what is written: fields that are left out in some cases may be missing.
fn written<T: JsonSchema>() -> schemars::Schema {
    SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<T>()
}
