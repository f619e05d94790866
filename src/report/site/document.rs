//! `report.json`, what stands beside the pages of `moreau report` for programs; it marks the folder as a report.

use super::Gathered;
use crate::claims::{CHAPTER, Status};
use crate::report::json::OutcomeEntry;
use crate::report::problems::Line;
use crate::systems;
use schemars::JsonSchema;
use serde::Serialize;

/// The name of the file.
pub const FILE: &str = "report.json";

/// What its `schema` says.
pub const SCHEMA: &str = "report/1";

/// What `moreau report` writes for programs.
#[derive(Serialize, JsonSchema)]
pub struct ReportDocument<'a> {
    /// Always `report/1`.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// The version of the program that wrote it.
    program: &'static str,
    /// The day on which it was written, `2026-01-31`.
    day: &'a str,
    /// The text that the claims are of.
    chapter: &'static str,
    /// Whether every verdict is supported by what was found.
    supported: bool,
    /// The claims with what was found.
    claims: Vec<OutcomeEntry<'a>>,
    /// The simulators on their four axes, with their agreements as measured.
    systems: &'a systems::Report,
    /// The planted mistakes.
    planted: Vec<PlantedEntry<'a>>,
    /// The collection of contact problems.
    problems: Vec<Line>,
    /// The files of the report beside this one, by their paths from its folder.
    files: &'a [String],
}

/// A planted mistake.
#[derive(Serialize, JsonSchema)]
struct PlantedEntry<'a> {
    /// `family/mistake`.
    name: &'a str,
    /// The mistake in one sentence.
    mistake: &'a str,
    /// Checks that caught it in this run.
    caught_by: &'a [String],
    /// Checks of the gate that `cargo test` and `moreau defects` see catching it.
    named: &'a [String],
}

impl<'a> ReportDocument<'a> {
    /// The document of what was gathered, beside these files.
    pub fn new(gathered: &'a Gathered, files: &'a [String]) -> Self {
        let planted = gathered.defects.iter().map(|defect| PlantedEntry {
            name: &defect.name,
            mistake: &defect.mistake,
            caught_by: &defect.caught,
            named: &defect.named,
        });
        ReportDocument {
            schema: SCHEMA,
            program: env!("CARGO_PKG_VERSION"),
            day: &gathered.day,
            chapter: CHAPTER,
            supported: gathered.outcomes.iter().all(|outcome| outcome.status == Status::Supported),
            claims: gathered.outcomes.iter().map(OutcomeEntry::from).collect(),
            systems: &gathered.systems,
            planted: planted.collect(),
            problems: gathered.problems.iter().map(Line::new).collect(),
            files,
        }
    }
}
