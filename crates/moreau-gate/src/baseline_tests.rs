//! Tests of the baselines: both sides of the noise, bounds, lost checks, known issues and their day, other versions and engines.

use super::*;
use crate::description::{Friction, Precision};
use crate::{ContactModel, Description, Expectation, Kind, StepOutcome};

const CHECK: &str = "made-up/check";

fn day(text: &str) -> Date {
    text.parse().expect("a day")
}

fn report(measurement: Measurement) -> Report {
    let engine = Description {
        name: "toy".into(),
        version: "1".into(),
        precision: Precision::Double,
        contact_model: ContactModel { kind: Kind::Rigid, law: None, parameters: Default::default() },
        restitution: true,
        friction: Friction::Cone,
        reports_contacts: false,
        levels: vec![],
        laws: vec![],
        options: Default::default(),
    };
    let checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Ok(vec![measurement]))])];
    Report { schema: crate::outcome::SCHEMA.into(), engine, sweep: vec![0.5], checks }
}

/// A value that should be 0 within 1.
fn value(value: f64, spread: f64) -> Report {
    report(Measurement { spread, ..Measurement::new("error", "m", value, Expectation::equal(0.0, 1.0, "")) })
}

fn kinds(then: &Report, now: &Report) -> Vec<ChangeKind> {
    let changes = Baseline::of(then).compare(now, day("2026-11-21")).expect("comparable");
    changes.iter().map(|change| change.kind).collect()
}

#[test]
fn a_worse_value_is_a_regression_on_the_far_side_of_the_noise_only() {
    assert_eq!(kinds(&value(0.25, 0.0), &value(0.25 + 0.9 * NEWS, 0.0)), []);
    assert_eq!(kinds(&value(0.25, 0.0), &value(0.25 + 1.1 * NEWS, 0.0)), [ChangeKind::Regression]);
    assert_eq!(kinds(&value(0.25, 0.01), &value(0.25 + 0.01 * SPREADS, 0.0)), []);
    assert_eq!(kinds(&value(0.25, 0.0), &value(0.125, 0.0)), [ChangeKind::Improvement]);
    assert_eq!(kinds(&value(0.25, 0.0), &value(-0.25, 0.0)), [], "as bad as before, on the other side");
}

#[test]
fn a_new_failure_is_a_regression_and_an_old_one_is_not() {
    assert!(kinds(&value(0.5, 0.0), &value(1.5, 0.0)).contains(&ChangeKind::Regression));
    assert_eq!(kinds(&value(1.5, 0.0), &value(1.5, 0.0)), []);
    assert!(kinds(&value(1.5, 0.0), &value(0.5, 0.0)).iter().all(|kind| *kind == ChangeKind::Improvement));
}

#[test]
fn bounds_get_worse_towards_the_bound() {
    let depth = |value| report(Measurement::new("depth", "m", value, Expectation::at_most(1.0, 0.0, "")));
    let bounce = |value| report(Measurement::new("height", "m", value, Expectation::at_least(1.0, 0.0, "")));
    assert_eq!(kinds(&depth(0.25), &depth(0.5)), [ChangeKind::Regression]);
    assert_eq!(kinds(&bounce(3.0), &bounce(2.0)), [ChangeKind::Regression]);
    assert_eq!(kinds(&bounce(2.0), &bounce(3.0)), [ChangeKind::Improvement]);
}

#[test]
fn losing_a_check_is_a_regression() {
    let mut lost = value(0.25, 0.0);
    let refusal = crate::Refusal::unsupported("no longer");
    lost.checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Err(refusal))])];
    assert_eq!(kinds(&value(0.25, 0.0), &lost), [ChangeKind::Regression]);
}

#[test]
fn a_failure_of_a_check_that_the_baseline_lacks_is_a_regression() {
    let mut baseline = Baseline::of(&value(0.0, 0.0));
    baseline.checks.clear();
    let kinds = |now: &Report| baseline.compare(now, day("2026-11-21")).expect("comparable").len();
    assert_eq!((kinds(&value(0.5, 0.0)), kinds(&value(1.5, 0.0))), (0, 1));
}

#[test]
fn a_known_issue_is_accepted_until_its_day() {
    let mut baseline = Baseline::of(&value(0.5, 0.0));
    let known = |expires| KnownIssue { check: CHECK.into(), reason: "issue 7".into(), expires };
    let bad = value(1.5, 0.0);
    for (issue, today, accepted) in [
        (known(None), "2026-11-21", true),
        (known(Some(day("2026-11-22"))), "2026-11-21", true),
        (known(Some(day("2026-11-22"))), "2026-11-22", false),
    ] {
        baseline.known_issues = vec![issue];
        let changes = baseline.compare(&bad, day(today)).expect("comparable");
        assert_eq!(changes.iter().all(|change| change.kind == ChangeKind::Known), accepted, "{changes:?}");
        assert!(changes[0].what.contains("issue 7"));
    }
}

#[test]
fn another_engine_or_sweep_cannot_be_compared() {
    let baseline = Baseline::of(&value(0.0, 0.0));
    let mut other = value(0.0, 0.0);
    other.engine.name = "another".into();
    assert!(baseline.compare(&other, day("2026-11-21")).expect_err("another engine").to_string().contains("another"));
    let mut other = value(0.0, 0.0);
    other.sweep = vec![0.25];
    assert!(baseline.compare(&other, day("2026-11-21")).expect_err("another sweep").to_string().contains("--steps"));
}

#[test]
fn a_baseline_survives_its_file() {
    let mut baseline = Baseline::of(&value(0.1 + 0.2, 1.0 / 3.0));
    let expires = Some(day("2027-01-31"));
    baseline.known_issues = vec![KnownIssue { check: "ball/restitution".into(), reason: "“quoted”".into(), expires }];
    let text = baseline.to_toml().expect("writable");
    assert_eq!(toml::from_str::<Baseline>(&text).expect("readable"), baseline, "{text}");
}

#[test]
fn another_version_and_other_options_are_told_and_compared_all_the_same() {
    let (then, mut now) = (value(0.25, 0.0), value(0.25, 0.0));
    assert!(Baseline::of(&then).notes(&now).is_empty());
    now.engine.version = "2".into();
    now.engine.options.insert("iterations".into(), 50.into());
    let notes = Baseline::of(&then).notes(&now);
    assert_eq!(notes, ["the baseline is of toy 1, but the run is of 2", "the option iterations was absent in the baseline and is 50 now"]);
    assert_eq!(kinds(&then, &now), []);
}
