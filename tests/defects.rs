//! Every planted mistake is caught by the checks that exist to catch it, every check catches one, and every reference passes.
//!
//! The engines are put to the checks they name here; `moreau defects` puts every engine to every check.

use moreau::checks::Finding;
use moreau::checks::planted::{KINDS, Trial};
use moreau::defects;
use moreau::gate::planted::{self, Faulty, Planted};
use moreau::gate::{CheckOutcome, Verdict, checks};
use moreau::matrix::{REPEATS, Row, rows, sources};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::LazyLock;

/// Everything but the engines, by name of the mistake.
static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| rows(&sources(&[])[1..], &|| ()).expect("every check can be computed"));

#[test]
fn every_mistake_that_stands_beside_a_reference_is_caught_and_the_reference_passes() {
    for planted in defects::beside() {
        let reference = (planted.subject.reference)().unwrap_or_else(|error| panic!("{}: reference: {error}", planted.name));
        assert!(!reference.is_empty(), "{}: the check found nothing", planted.name);
        for finding in &reference {
            assert!(finding.holds(), "{}: the reference fails: {finding}", planted.name);
        }
        let defective = (planted.subject.defective)().unwrap_or_else(|error| panic!("{}: {error}", planted.name));
        assert!(!defective.iter().all(Finding::holds), "{} is not caught: {}", planted.name, planted.mistake);
    }
}

#[test]
fn every_row_is_caught_and_every_column_catches_one() {
    // what a family misses, an engine with the same mistake shows
    let behind_the_door: BTreeSet<&str> = planted::all().map(|planted| planted.name).collect();
    for row in ROWS.iter().filter(|row| !behind_the_door.contains(row.name)) {
        assert!(!row.caught_by.is_empty(), "{} is caught by no check: {}", row.name, row.mistake);
    }
    let catching: BTreeSet<&String> = ROWS.iter().flat_map(|row| &row.caught_by).collect();
    let sources = sources(&[]);
    let idle: Vec<&String> = sources[1..].iter().flat_map(|source| &source.checks).filter(|check| !catching.contains(check)).collect();
    assert!(idle.is_empty(), "these checks catch no planted mistake: {idle:?}");
}

/// Every mistake that is planted anywhere, with its sentence and its kind.
fn trials() -> Vec<(&'static str, String)> {
    let told = |trial: &Trial| (trial.name, format!("{:?}: {}", trial.kind, trial.mistake));
    sources(&[]).iter().flat_map(|source| source.trials.iter().map(told).collect::<Vec<_>>()).collect()
}

#[test]
fn one_name_is_one_mistake_and_what_repeats_another_is_not_counted() {
    let mut told: HashMap<&str, String> = HashMap::new();
    for (name, mistake) in trials() {
        assert_eq!(told.entry(name).or_insert_with(|| mistake.clone()), &mistake, "{name}");
    }
    for (repetition, original) in REPEATS {
        assert!(told.contains_key(repetition) && told.contains_key(original), "{repetition} repeats {original}");
        assert!(REPEATS.iter().all(|(other, _)| other != original), "{original} is a repetition itself");
        assert_eq!(REPEATS.iter().filter(|(other, _)| other == repetition).count(), 1, "{repetition}");
    }
    let distinct = told.len() - REPEATS.len();
    assert!(distinct >= 150, "{distinct} lines of reasoning");
}

#[test]
fn every_kind_of_subject_has_at_least_five_lines_of_reasoning() {
    let mut kinds: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for (name, mistake) in trials().into_iter().filter(|(name, _)| REPEATS.iter().all(|(repetition, _)| repetition != name)) {
        kinds.entry(mistake.split(':').next().expect("a kind").into()).or_default().insert(name);
    }
    assert_eq!(kinds.len(), KINDS.len());
    for (kind, names) in kinds {
        assert!(names.len() >= 5, "{kind}: {names:?}");
    }
}

/// The checks that a planted engine names but that do not catch it, each with the reason.
fn missed(mistake: &Planted<Faulty>) -> Vec<String> {
    let find = |name: &&str| checks::find(name).unwrap_or_else(|| panic!("{}: no check `{name}`", mistake.name));
    let checks: Vec<_> = mistake.subject.caught_by.iter().map(find).collect();
    if checks.is_empty() {
        return vec![format!("{} names no check: {}", mistake.name, mistake.mistake)];
    }
    let report = planted::judge(mistake, &checks).unwrap_or_else(|error| panic!("{}: {error}", mistake.name));
    let missing = report.checks.iter().filter(|outcome| outcome.verdict != Verdict::Fail);
    let why = |outcome: &CheckOutcome| outcome.reason.clone().unwrap_or_default();
    missing.map(|outcome| format!("{} does not catch {}: {}", outcome.check, mistake.name, why(outcome))).collect()
}

#[test]
fn every_planted_engine_is_caught_and_every_check_of_the_gate_catches_one() {
    let planted: Vec<&Planted<Faulty>> = planted::all().collect();
    let missed: Vec<String> = planted.par_iter().flat_map_iter(|mistake| missed(mistake)).collect();
    assert_eq!(missed, Vec::<String>::new());
    let catching: BTreeSet<&str> = planted.iter().flat_map(|mistake| mistake.subject.caught_by).copied().collect();
    let idle: Vec<&str> = checks::all().map(|check| check.name).filter(|name| !catching.contains(name)).collect();
    assert!(idle.is_empty(), "these checks catch no planted mistake: {}", idle.join(", "));
}
