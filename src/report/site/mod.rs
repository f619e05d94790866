//! What `moreau report` shows, from what was found: judged claims, measured systems, planted mistakes, stored results.

mod claim;
pub mod document;
mod measured;

use crate::claims::errata::chinese_section;
use crate::claims::{Figures, JudgedClaim, PLACES, SECTIONS, Section as Group, Status};
use crate::gate::cause::Cause;
use crate::gate::planted;
use crate::gate::scoreboard::Standing;
use crate::matrix::{REPEATS, Row};
use crate::problems::{Record, work};
use crate::report::problems::{Line, friction, size};
use crate::systems;
use moreau_site::Words;
use moreau_site::pages::data::{DefectEntry, FigureCounts, ProblemEntry, Report, Section};

/// Everything that a report is made of.
pub struct Gathered {
    /// The day on which it is written, `2026-01-31`.
    pub day: String,
    /// The judged claims, in the chapter's order.
    pub outcomes: Vec<JudgedClaim>,
    /// The systems, measured.
    pub systems: systems::Report,
    /// The stored results of the scoreboard.
    pub standings: Vec<Standing>,
    /// Why checks are not passed.
    pub causes: Vec<Cause>,
    /// The planted mistakes.
    pub defects: Vec<DefectEntry>,
    /// The records of the collection of contact problems.
    pub problems: Vec<Record>,
    /// How much work iterations need at them.
    pub work: Vec<work::Table>,
}

impl Gathered {
    /// Whether every verdict is supported, every agreement within its tolerance, and every planted mistake caught.
    pub fn holds(&self) -> bool {
        self.contradicted().is_empty()
            && self.systems.holds()
            && self.defects.iter().all(|defect| !defect.caught.is_empty() || !defect.named.is_empty())
    }

    /// The claims whose verdict is not supported by what was found.
    pub fn contradicted(&self) -> Vec<&'static str> {
        self.outcomes.iter().filter(|outcome| outcome.status != Status::Supported).map(|outcome| outcome.claim.id).collect()
    }

    /// What the pages show.
    pub fn report(&self) -> Report<'_> {
        Report {
            version: env!("CARGO_PKG_VERSION").into(),
            day: self.day.clone(),
            chapter: PLACES.headings.first().map(|heading| heading.title.clone()).unwrap_or_default(),
            sections: SECTIONS.iter().map(section).collect(),
            claims: self.outcomes.iter().map(claim::entry).collect(),
            figures: figures(&self.outcomes),
            systems: &self.systems,
            standings: &self.standings,
            causes: &self.causes,
            defects: &self.defects,
            problems: self.problems.iter().map(problem).collect(),
            given: measured::given(&self.standings, &self.work),
        }
    }
}

fn section(section: &'static Group) -> Section {
    let zh = chinese_section(section.group).unwrap_or(section.title);
    Section { group: section.group.into(), title: Words { en: section.title, zh } }
}

fn figures(outcomes: &[JudgedClaim]) -> FigureCounts {
    let sum = Figures::sum(outcomes);
    let controls = outcomes.iter().map(|outcome| outcome.claim.controls.len()).sum();
    FigureCounts { deciding: sum.deciding, moved: sum.moved, controls }
}

/// The planted mistakes: those that were put to their checks, and the engines with the checks that they name.
pub fn defects(rows: Vec<Row>) -> Vec<DefectEntry> {
    let mut defects: Vec<DefectEntry> = rows
        .into_iter()
        .map(|row| DefectEntry {
            name: row.name.into(),
            mistake: row.mistake.into(),
            kind: row.kind,
            repeats: row.repeats.map(String::from),
            caught: row.caught_by,
            named: Vec::new(),
        })
        .collect();
    for engine in planted::all() {
        let named = engine.subject.caught_by.iter().map(ToString::to_string);
        match defects.iter_mut().find(|defect| defect.name == engine.name) {
            Some(defect) => defect.named.extend(named),
            None => defects.push(DefectEntry {
                name: engine.name.into(),
                mistake: engine.mistake.into(),
                kind: engine.kind,
                repeats: REPEATS.iter().find(|(name, _)| *name == engine.name).map(|(_, original)| (*original).into()),
                caught: Vec::new(),
                named: named.collect(),
            }),
        }
    }
    defects
}

fn problem(record: &Record) -> ProblemEntry {
    let line = Line::new(record);
    ProblemEntry {
        backward: size(line.backward),
        forward: size(line.forward),
        friction: friction(line.friction),
        name: line.name,
        group: line.group,
        about: line.about,
        contacts: line.contacts,
        dimension: line.dimension,
        law: line.law,
        uniqueness: line.uniqueness,
        answers: line.answers,
        failures: line.failures,
        script: record.script.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_section_has_a_chinese_title() {
        for group in &SECTIONS {
            let Words { en, zh } = section(group).title;
            assert!(en == group.title && zh != en, "{}: {zh}", group.group);
        }
    }

    #[test]
    fn a_planted_engine_is_one_entry_with_the_mistake_of_its_name() {
        let rows = crate::matrix::rows(&[], &|| ()).expect("no check");
        let defects = defects(rows);
        let names: BTreeSet<&str> = defects.iter().map(|defect| defect.name.as_str()).collect();
        assert_eq!(names.len(), defects.len());
        assert!(defects.iter().all(|defect| defect.caught.is_empty() && !defect.named.is_empty()));
    }
}
