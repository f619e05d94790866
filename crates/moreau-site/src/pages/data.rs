//! What the pages are given: plain data, judged elsewhere.

use super::axes::{Evidence, Kind, Role, Severity, Verdict};
use crate::words::Words;
use moreau_gate::cause::Cause;
use moreau_gate::scoreboard::Standing;
use moreau_replicas::systems;

/// Everything that a report shows.
pub struct Report<'a> {
    /// The version of the program.
    pub version: String,
    /// The day on which it was written, as `2026-01-31`.
    pub day: String,
    /// The chapter's own title.
    pub chapter: String,
    /// Its sections, in order.
    pub sections: Vec<Section>,
    /// The claims, in the chapter's order.
    pub claims: Vec<ClaimEntry>,
    /// How hard the evidence is.
    pub figures: FigureCounts,
    /// The simulators on their four axes, measured.
    pub systems: &'a systems::Report,
    /// The stored results of the scoreboard.
    pub standings: &'a [Standing],
    /// Why checks are not passed.
    pub causes: &'a [Cause],
    /// The planted mistakes.
    pub defects: &'a [DefectEntry],
    /// The collection of contact problems.
    pub problems: Vec<ProblemEntry>,
    /// What some pictures show.
    pub given: Given,
}

/// A section of the chapter.
pub struct Section {
    /// What the ids of its claims start with.
    pub group: String,
    /// Its title; in Chinese the chapter's own heading.
    pub title: Words,
}

/// Numbers about the findings of all claims.
#[derive(Clone, Copy, Default)]
pub struct FigureCounts {
    /// Findings that decide.
    pub deciding: usize,
    /// Those of them that a control finds otherwise.
    pub moved: usize,
    /// Planted subjects that the claims must tell from the right ones.
    pub controls: usize,
}

/// A claim with what was found.
#[derive(Clone)]
pub struct ClaimEntry {
    /// Identifier, `S4.copos-plus`; its anchor.
    pub id: String,
    /// The group of its section.
    pub group: String,
    /// What it is about, in a few words.
    pub title: String,
    /// What the chapter says, with its hedges.
    pub statement: String,
    /// Statement and correction with their formulas in Unicode, for lists and the search.
    pub plain: [String; 2],
    /// The verdict.
    pub verdict: Verdict,
    /// What kind of sentence it is.
    pub kind: Kind,
    /// How much is wrong.
    pub severity: Option<Severity>,
    /// The grade of the evidence.
    pub evidence: Evidence,
    /// The claim that it repeats.
    pub repeats: Option<String>,
    /// What keeps the evidence from supporting the verdict; none where it does.
    pub alarm: Option<String>,
    /// The finding that the verdict turns on.
    pub deciding: Option<FindingEntry>,
    /// Every finding.
    pub findings: Vec<FindingEntry>,
    /// Proof or counterexample.
    pub argument: String,
    /// The statement as it should read.
    pub correct: String,
    /// The controls.
    pub controls: Vec<ControlEntry>,
    /// Where the chapter says it.
    pub places: Vec<PlaceEntry>,
    /// Why the chapter does not say it; none where it does.
    pub absent: Option<String>,
    /// Where the statement and what it is held against are from.
    pub sources: Vec<String>,
    /// Path of the function that checks it.
    pub check: String,
    /// What is wrong and how it should read, in Chinese.
    pub erratum: Option<Erratum>,
}

/// A correction in Chinese, in the words of an errata sheet.
#[derive(Clone)]
pub struct Erratum {
    /// What the chapter says.
    pub says: String,
    /// What is wrong.
    pub wrong: String,
    /// How it should read.
    pub reads: String,
}

/// What a check found, in words and rounded.
#[derive(Clone)]
pub struct FindingEntry {
    /// What it has to do with the sentence.
    pub role: Role,
    /// What was looked at.
    pub name: String,
    /// The number with its unit.
    pub found: String,
    /// What is expected of it.
    pub expected: String,
    /// What the sentence says of it, where that is something else.
    pub stated: Option<String>,
    /// Who says so, where it is not the sentence.
    pub voice: Option<Voice>,
    /// The condition that the sentence omits and that is not met here.
    pub violated: Option<String>,
    /// How much of its bound it uses.
    pub used: Option<String>,
}

/// Who says what is stated.
#[derive(Clone)]
pub enum Voice {
    /// A passage of the chapter.
    Passage(String),
    /// A reading of the sentence.
    Reading(String),
    /// An opinion, of which only this point can be decided.
    Opinion(String),
}

/// A control: another subject, put to the same check.
#[derive(Clone)]
pub struct ControlEntry {
    /// What it changes.
    pub subject: String,
    /// The verdict that follows with it; none where no verdict follows.
    pub verdict: Option<Verdict>,
    /// The findings that come out otherwise.
    pub findings: Vec<FindingEntry>,
}

/// A sentence of the chapter.
#[derive(Clone)]
pub struct PlaceEntry {
    /// `§0` to `§12`, or empty.
    pub section: String,
    /// The nearest heading above.
    pub heading: String,
    /// Which paragraph below it, from 1.
    pub paragraph: usize,
    /// Line of the text, from 1.
    pub line: usize,
    /// How much of the text stands before \[%\].
    pub percent: usize,
    /// A few words of the sentence.
    pub words: String,
}

/// A planted mistake.
pub struct DefectEntry {
    /// `family/mistake`.
    pub name: String,
    /// The mistake in one sentence.
    pub mistake: String,
    /// What it is a mistake of.
    pub kind: moreau_checks::planted::Kind,
    /// The mistake with the same line of reasoning.
    pub repeats: Option<String>,
    /// Checks that caught it in this run.
    pub caught: Vec<String>,
    /// Checks of the gate that `cargo test` and `moreau defects` see catching it.
    pub named: Vec<String>,
}

/// A problem of the collection.
pub struct ProblemEntry {
    /// Its name.
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
    pub friction: String,
    /// What is known of the number of velocities.
    pub uniqueness: Uniqueness,
    /// Number of answers with different velocities.
    pub answers: usize,
    /// δ \[m/s\], rounded.
    pub backward: String,
    /// The proved radius in u \[m/s\], rounded.
    pub forward: String,
    /// Solvers that failed at it.
    pub failures: usize,
    /// The command that makes it.
    pub script: String,
}

pub use crate::picture::{Creep, CreepStep, CreepTrend, Given, Work};
pub use moreau_contact::answered::Known as Uniqueness;

impl Report<'_> {
    /// Claims that are not supported by what was found.
    pub fn contradicted(&self) -> impl Iterator<Item = &ClaimEntry> {
        self.claims.iter().filter(|claim| claim.alarm.is_some())
    }

    /// How many claims meet a condition.
    pub fn count(&self, is: impl Fn(&ClaimEntry) -> bool) -> usize {
        self.claims.iter().filter(|claim| is(claim)).count()
    }

    /// The claim with this id.
    pub fn claim(&self, id: &str) -> Option<&ClaimEntry> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    /// Claims that repeat this one.
    pub fn repetitions(&self, id: &str) -> impl Iterator<Item = &ClaimEntry> {
        self.claims.iter().filter(move |claim| claim.repeats.as_deref() == Some(id))
    }

    /// The claims of a section.
    pub fn of(&self, group: &str) -> impl Iterator<Item = &ClaimEntry> {
        self.claims.iter().filter(move |claim| claim.group == group)
    }
}
