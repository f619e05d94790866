//! The collection for reading and for programs: a line per problem, one problem in full, the table of docs/problems.md.

use crate::number::significant;
use crate::problems::{Answered, Bound, Known, Record};
use crate::solvers::{ALL, Solvers};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;

/// What `<!-- problems -->` and `<!-- /problems -->` enclose in docs/problems.md.
pub const BEGIN: &str = "<!-- problems -->";
/// The end of the table.
pub const END: &str = "<!-- /problems -->";

/// Solvers that fail at a hard problem.
pub const HARD: usize = 3;

/// One line of the list.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Line {
    /// The problem's name.
    pub name: String,
    /// The family it belongs to.
    pub group: String,
    /// What it is.
    pub about: String,
    /// Number of contacts.
    pub contacts: usize,
    /// Rows per contact.
    pub dimension: usize,
    /// The contact law.
    pub law: String,
    /// The smallest and the largest μ.
    pub friction: [f64; 2],
    /// Whether it is stored; otherwise a script makes it.
    pub stored: bool,
    /// Number of answers with different velocities.
    pub answers: usize,
    /// The largest residual of the first answer, relative to the scale of its contact; absent without an answer.
    pub relative: Option<f64>,
    /// δ: the first answer solves exactly a problem whose free velocity is this near \[m/s\]; absent where it is not proved.
    pub backward: Option<f64>,
    /// The proved distance of the first answer from a solution in u \[m/s\]; absent where it is not proved.
    pub forward: Option<f64>,
    /// What is known of the number of velocities.
    pub uniqueness: Known,
    /// Plain sweeps to 1e-8; absent where they do not get there.
    pub sweeps: Option<usize>,
    /// How many solvers failed at it.
    pub failures: usize,
}

impl Line {
    /// The line of a record.
    pub fn new(record: &Record) -> Self {
        let first = record.answers.first();
        let bound = |of: fn(&Answered) -> &Bound| first.and_then(|answer| of(answer).velocity);
        Line {
            name: record.name.clone(),
            group: record.group.clone(),
            about: record.about.clone(),
            contacts: record.contacts,
            dimension: record.dimension,
            law: record.law.clone(),
            friction: record.friction,
            stored: record.stored,
            answers: record.answers.len(),
            relative: first.map(|answer| answer.relative),
            backward: bound(|answer| &answer.backward),
            forward: bound(|answer| &answer.forward),
            uniqueness: record.uniqueness.velocity,
            sweeps: record.difficulty.sweeps,
            failures: record.failures(),
        }
    }
}

/// A size to two digits, or a dash.
pub(super) fn size(number: Option<f64>) -> String {
    number.map_or("–".into(), |number| if number == 0.0 { "0".into() } else { format!("{number:.1e}") })
}
/// The smallest and the largest μ, or the one that there is.
pub(super) fn friction([least, most]: [f64; 2]) -> String {
    if least == most { significant(least) } else { format!("{}–{}", significant(least), significant(most)) }
}

/// The list for reading.
pub fn list(lines: &[Line]) -> String {
    let width = lines.iter().map(|line| line.name.chars().count()).max().unwrap_or(0).max("problem".len());
    let mut text = format!(
        "{:width$} {:>8} {:20} {:>7} {:11} {:>8} {:>8} {:>8} {:>6}\n",
        "problem", "contacts", "law", "μ", "velocity", "δ [m/s]", "radius", "sweeps", "failed"
    );
    for line in lines {
        let sweeps = line.sweeps.map_or("–".into(), |sweeps| sweeps.to_string());
        let _ = writeln!(
            text,
            "{:width$} {:>8} {:20} {:>7} {:11} {:>8} {:>8} {sweeps:>8} {:>6}",
            line.name,
            line.contacts,
            line.law,
            friction(line.friction),
            line.uniqueness.name(),
            size(line.backward),
            size(line.forward),
            line.failures
        );
    }
    let _ = writeln!(text, "{}", summary(lines));
    text
}

/// How many there are of each kind.
fn summary(lines: &[Line]) -> String {
    let count = |is: &dyn Fn(&Line) -> bool| lines.iter().filter(|line| is(line)).count();
    let known = |known: Known| count(&|line| line.uniqueness == known);
    format!(
        "{} problems of {} to {} contacts; velocity unique for {}, at most one for {}, several for {}, no solution for {}, unknown for {}; \
         three or more solvers fail at {}",
        lines.len(),
        lines.iter().map(|line| line.contacts).min().unwrap_or(0),
        lines.iter().map(|line| line.contacts).max().unwrap_or(0),
        known(Known::Unique),
        known(Known::AtMostOne),
        known(Known::Several),
        known(Known::None),
        known(Known::Unknown),
        count(&|line| line.failures >= HARD)
    )
}

/// The table for docs/problems.md.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = format!("{}.\n\n", summary(lines));
    text +=
        "| problem | contacts | rows | law | μ | velocity | answers | residual | δ [m/s] | radius [m/s] | sweeps | failed | what it is |\n";
    text += "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for line in lines {
        let sweeps = line.sweeps.map_or("–".into(), |sweeps| sweeps.to_string());
        let stored = if line.stored { "" } else { "; not stored" };
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {} | {} | {} | {} | {} | {} | {sweeps} | {} | {}{stored} |",
            line.name,
            line.contacts,
            line.dimension,
            line.law,
            friction(line.friction),
            line.uniqueness.name(),
            line.answers,
            size(line.relative),
            size(line.backward),
            size(line.forward),
            line.failures,
            line.about
        );
    }
    text
}

/// One problem in full.
pub fn show(record: &Record) -> String {
    let mut text = format!("{}: {}\n", record.name, record.about);
    let mut line = |content: String| writeln!(text, "{content}").expect("writing to a String cannot fail");
    line(format!(
        "  contacts: {}, rows per contact: {}, law {}, μ {}",
        record.contacts,
        record.dimension,
        record.law,
        friction(record.friction)
    ));
    line(format!("  made by: {}", record.script));
    line(format!("  velocity {}: {}", record.uniqueness.velocity.name(), record.uniqueness.reason));
    match (record.difficulty.sweeps, &record.difficulty.reason) {
        (Some(sweeps), _) => line(format!("  plain sweeps to 1e-8: {sweeps}")),
        (None, reason) => line(format!("  plain sweeps to 1e-8: none; {}", reason.as_deref().unwrap_or("unknown"))),
    }
    for (number, answer) in record.answers.iter().enumerate() {
        line(format!("answer {}, by {}", number + 1, answer.by));
        line(format!("  largest residual {} of its scale: {}, contact {}", size(Some(answer.relative)), answer.residual, answer.contact));
        line(format!("  δ: {}", bound(&answer.backward)));
        line(format!("  radius in u: {}", bound(&answer.forward)));
        for other in &answer.agreement {
            line(format!("  also by {}, u differs by {} m/s", other.by, size(Some(other.difference))));
        }
    }
    for outcome in &record.solvers {
        let end = match (&outcome.reason, outcome.relative) {
            (Some(reason), _) => reason.clone(),
            (None, relative) => format!("residual {}, iterations {}", size(relative), outcome.iterations.unwrap_or(0)),
        };
        line(format!("{:19} {:9} {end}", outcome.solver, outcome.ended.name()));
    }
    text + &left_out(record.solvers.iter().map(|outcome| outcome.solver.as_str()))
}

/// The solvers that a list of outcomes leaves out, and why.
pub fn left_out<'a>(asked: impl Iterator<Item = &'a str>) -> String {
    let asked: Vec<&str> = asked.collect();
    let own: Vec<&str> = Solvers::own().names().collect();
    let (newer, engines): (Vec<&str>, Vec<&str>) = ALL.names().filter(|name| !asked.contains(name)).partition(|name| own.contains(name));
    let reasons = [(newer, "newer than this record"), (engines, "the engines' own iterations; `moreau solve --solver NAME` asks them")];
    let mut text = String::new();
    for (names, why) in reasons.iter().filter(|(names, _)| !names.is_empty()) {
        let _ = writeln!(text, "not asked: {} ({why})", names.join(", "));
    }
    text
}

fn bound(bound: &Bound) -> String {
    match (bound.velocity, &bound.reason) {
        (Some(velocity), _) => format!("at most {} m/s", size(Some(velocity))),
        (None, reason) => reason.clone().unwrap_or_else(|| "not proved".into()),
    }
}
