//! What the records say, looked at again.

use super::{is_campaign, stored};
use moreau::certificate::residuals;
use moreau::problems::{ALL, Known, Record, solution};
use moreau::report::problems::{BEGIN, END, HARD, Line, markdown};
use moreau::tolerance::certificate::CERTIFY;
use std::collections::BTreeSet;
use std::path::Path;

/// Contacts of the problems whose answers are certified again by default.
const CERTIFIED: usize = 60;
/// The problems whose only velocity one family of algorithms found.
const ALONE: [&str; 3] = ["pile-30-associated", "capsules-249-associated", "heap-252-associated"];
/// The problem with at most one velocity to which no solver has an answer that the certificate accepts: its light boxes carry 10⁷ times
/// their load.
const UNANSWERED: &str = "tower-alternating-12-1e6-drift-associated";
/// Bytes of one file.
const LARGEST_FILE: usize = 2_000_000;

fn records() -> Vec<Record> {
    ALL.iter().map(|stored| stored.record().unwrap_or_else(|error| panic!("{}: {error}", stored.name))).collect()
}

#[test]
fn names_groups_and_sizes_are_those_of_the_problems() {
    let records = records();
    assert_eq!(ALL.iter().map(|stored| stored.name).collect::<BTreeSet<_>>().len(), ALL.len(), "a name stands twice");
    for (stored, record) in ALL.iter().zip(&records) {
        assert_eq!(stored.name, record.name);
        assert!(stored.record.len() <= LARGEST_FILE && stored.problem.is_none_or(|text| text.len() <= LARGEST_FILE), "{}", record.name);
        assert!(record.stored == stored.problem.is_some() && record.sha256.len() == 64 && record.script.contains(&record.name));
        assert_eq!(record.uniqueness.velocity == Known::AtMostOne, UNANSWERED == record.name, "{}", record.name);
        let unanswered = matches!(record.uniqueness.velocity, Known::None | Known::AtMostOne);
        assert_eq!(record.answers.is_empty(), unanswered, "{}: answers", record.name);
        assert!(record.uniqueness.count.is_none_or(|count| record.answers.len() <= count), "{}: more answers than velocities", record.name);
    }
    for (_, problem, record) in stored(CERTIFIED) {
        let sizes = (problem.name(), problem.contacts(), problem.rows_per_contact(), problem.law().name());
        assert_eq!(sizes, (record.name.as_str(), record.contacts, record.dimension, record.law.as_str()));
    }
}

#[test]
fn there_are_as_many_problems_as_promised_and_half_of_the_velocities_are_decided() {
    let records = records();
    let count = |is: fn(&Record) -> bool| records.iter().filter(|record| is(record)).count();
    assert!(records.len() >= 100, "{} problems", records.len());
    assert!(2 * count(|record| record.uniqueness.velocity == Known::Unknown) <= records.len());
    for known in [Known::Unique, Known::Several, Known::None] {
        assert!(records.iter().any(|record| record.uniqueness.velocity == known), "none is {}", known.name());
    }
    println!("{} of {} problems are failed at by {HARD} solvers", count(|record| record.failures() >= HARD), records.len());
}

#[test]
fn every_answer_is_certified_again_and_a_spoilt_one_is_not() {
    let most = if is_campaign() { usize::MAX } else { CERTIFIED };
    for (_, problem, record) in stored(most) {
        for answer in &record.answers {
            let solution = solution(&problem, &record, answer);
            let judged = residuals(&problem, &solution).expect("an answer that fits");
            assert!(judged.is_solution(CERTIFY), "{}: {judged:?}", record.name);
            let mut spoilt = solution.clone();
            spoilt.impulse[0] += 0.01 * (1.0 + solution.impulse.amax());
            spoilt.velocity = problem.velocity(&spoilt.impulse);
            (spoilt.beta, spoilt.sigma) = (None, None);
            // a redundant support may be pressed harder; what does not may not be taken for an answer of another problem
            let other = residuals(&problem, &spoilt);
            let moved = (&spoilt.velocity - &solution.velocity).amax() > 1e-3 * (1.0 + solution.velocity.amax());
            let single = problem.contacts() == 1 && moved;
            assert!(!single || other.is_err() || !other.is_ok_and(|judged| judged.is_solution(CERTIFY)), "{}: spoilt", record.name);
        }
    }
}

#[test]
fn no_answer_stands_on_one_algorithm_alone_without_being_named_so() {
    let mut alone = Vec::new();
    for record in records() {
        let Some(first) = record.answers.first() else { continue };
        if first.agreement.is_empty() && record.uniqueness.velocity == Known::Unique {
            alone.push(record.name);
        }
    }
    assert_eq!(alone, ALONE, "a velocity that is the only one is found by two families of algorithms, or by hand");
}

#[test]
fn what_is_too_large_to_be_stored_is_named_with_the_command_that_makes_it() {
    let absent: Vec<Record> = records().into_iter().filter(|record| !record.stored).collect();
    for record in &absent {
        println!("not here: {}, {} contacts, SHA-256 {}; {}", record.name, record.contacts, record.sha256, record.script);
        let error = moreau::problems::named(&record.name).and_then(|stored| stored.problem()).expect_err("it is not stored").to_string();
        assert!(error.contains(&record.script), "{error}");
    }
}

#[test]
fn the_page_shows_the_table_of_these_records() {
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/problems.md")).expect("the page");
    let table = page.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).map(|(table, _)| table.trim());
    let lines: Vec<Line> = records().iter().map(Line::new).collect();
    assert!(table == Some(markdown(&lines).trim()), "run `cargo run -- problems list --readme docs/problems.md`");
}
