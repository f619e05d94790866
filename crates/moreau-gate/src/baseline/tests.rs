//! Tests of the baselines: both sides of the noise, bounds, lost checks, known issues and their day, other versions and engines.

use super::*;
use crate::description::{Friction, Precision};
use crate::{ContactModel, Description, Expectation, Kind, StepOutcome};

const CHECK: &str = "rest/depth";

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
        shapes: crate::description::ShapeKind::basic(),
        bodies: crate::description::BodyKind::free(),
        sleeping: None,
        options: Default::default(),
    };
    let checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Ok(vec![measurement]))])];
    Report { schema: crate::outcome::SCHEMA.into(), engine, adapter: Vec::new(), sweep: vec![0.5], checks }
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
    assert_eq!(kinds(&value(0.25, 0.0), &value(0.25 + 0.01 * SPREADS, 0.01)), [], "the run's own spread");
    assert_eq!(kinds(&value(0.25, 0.0), &value(0.125, 0.0)), [ChangeKind::Improvement]);
    assert_eq!(kinds(&value(0.25, 0.0), &value(-0.25, 0.0)), [], "as bad as before, on the other side");
}

#[test]
fn a_last_digit_is_no_regression_where_the_allowance_is_rounding_itself() {
    let of = |value: f64| report(Measurement::new("way", "m", value, Expectation::equal(0.0, 64.0 * f64::EPSILON, "")));
    assert_eq!(kinds(&of(0.0), &of(8.0 * f64::EPSILON)), []);
    assert_eq!(kinds(&of(8.0 * f64::EPSILON), &of(0.0)), []);
    assert_eq!(kinds(&of(0.0), &of(9.0 * f64::EPSILON)), [ChangeKind::Regression]);
}

#[test]
fn a_value_in_another_unit_is_not_compared() {
    let of = |unit: &str| report(Measurement::new("error", unit, 0.25, Expectation::equal(0.0, 1.0, "")));
    assert_eq!(kinds(&of("m"), &of("m")), []);
    let changes = Baseline::of(&of("m")).compare(&of("mm"), day("2026-11-21")).expect("comparable");
    assert_eq!((changes[0].kind, changes.len()), (ChangeKind::Regression, 1));
    assert!(changes[0].what.contains("in the unit “mm” instead of “m”: make a new baseline"), "{}", changes[0].what);
}

#[test]
fn a_known_issue_that_covers_nothing_bad_is_told() {
    let issue = |quantity: Option<&str>, time_step, check: &str| KnownIssue {
        check: check.into(),
        quantity: quantity.map(Into::into),
        time_step,
        least: None,
        most: None,
        reason: "issue 7".into(),
        expires: None,
    };
    let told = |issue: KnownIssue, now: &Report| {
        let baseline = Baseline { known_issues: vec![issue], ..Baseline::of(&value(1.5, 0.0)) };
        baseline.notes(now).join("\n")
    };
    let (good, failing) = (value(0.5, 0.0), value(1.5, 0.0));
    // one that covers what got worse within its bounds is used, and of a check or step without an answer nothing is known
    let worse = issue(Some("error"), None, CHECK);
    let baseline = Baseline { known_issues: vec![worse.clone()], ..Baseline::of(&value(0.25, 0.0)) };
    assert_eq!(baseline.compare(&good, day("2026-11-21")).expect("comparable")[0].kind, ChangeKind::Known);
    assert!(baseline.notes(&good).is_empty() && told(worse, &good).contains("covers nothing"));
    let unanswered = |refusal| {
        let step = StepOutcome::new(Some(0.5), Err(refusal));
        Report { checks: vec![CheckOutcome::new(CHECK, vec![step])], ..value(0.0, 0.0) }
    };
    for now in [unanswered(crate::Refusal::unsupported("not today")), unanswered(crate::Refusal::errored("crashed"))] {
        assert_eq!(told(issue(Some("error"), Some(0.5), CHECK), &now), "");
        assert_eq!(told(issue(None, None, CHECK), &now), "");
    }
    for used in [issue(None, None, CHECK), issue(Some("error"), None, CHECK), issue(Some("error"), Some(0.5), CHECK)] {
        assert_eq!(told(used.clone(), &failing), "");
        assert!(told(used, &good).contains("covers nothing that is bad"));
    }
    let other = told(issue(Some("eror"), Some(0.25), CHECK), &failing);
    assert!(other.contains("“issue 7” of rest/depth, “eror” at h = 0.25 s covers nothing"), "{other}");
    assert_eq!(told(issue(None, None, "slide/stop"), &failing), "", "that check is not in this run");
}

#[test]
fn what_an_expired_issue_accepted_is_a_regression_though_the_baseline_has_it() {
    let (failing, mended) = (value(1.5, 0.0), value(0.5, 0.0));
    let issue = |quantity: Option<&str>, expires: &str| KnownIssue {
        check: CHECK.into(),
        quantity: quantity.map(Into::into),
        time_step: None,
        least: None,
        most: None,
        reason: "issue 7".into(),
        expires: Some(day(expires)),
    };
    let kinds = |issues: Vec<KnownIssue>, now: &Report| {
        let baseline = Baseline { known_issues: issues, ..Baseline::of(&failing) };
        let changes = baseline.compare(now, day("2026-11-21")).expect("comparable");
        changes.iter().filter(|change| change.kind == ChangeKind::Regression).count()
    };
    for quantity in [None, Some("error")] {
        assert_eq!(kinds(vec![issue(quantity, "2026-11-22")], &failing), 0);
        assert_eq!(kinds(vec![issue(quantity, "2026-11-21")], &failing), 1);
        assert_eq!(kinds(vec![issue(quantity, "2026-11-21"), issue(quantity, "2026-11-22")], &failing), 0, "another one holds");
        assert_eq!(kinds(vec![issue(quantity, "2026-11-21")], &mended), 0);
    }
    assert_eq!(kinds(vec![issue(Some("depth"), "2026-11-21")], &failing), 0, "of another quantity");
    // what is worse than the baseline, too, is told once
    assert_eq!(kinds(vec![issue(None, "2026-11-21")], &value(3.0, 0.0)), 1);
}

#[test]
fn a_new_failure_is_a_regression_and_an_old_one_is_not() {
    assert!(kinds(&value(0.5, 0.0), &value(1.5, 0.0)).contains(&ChangeKind::Regression));
    assert_eq!(kinds(&value(1.5, 0.0), &value(1.5, 0.0)), []);
    assert!(kinds(&value(1.5, 0.0), &value(0.5, 0.0)).iter().all(|kind| *kind == ChangeKind::Improvement));
}

/// What every answer is asked has a value only where it is wrong, so that a baseline has none of it.
#[test]
fn a_bad_value_that_the_baseline_does_not_have_is_a_regression_unless_it_is_known() {
    let (then, mut now) = (value(1.5, 0.0), value(1.5, 0.0));
    let pulls = |value: f64| Measurement::new("ground that pulls", "N*s", value, Expectation::equal(0.0, 1.0, ""));
    now.checks[0].steps[0].measurements.push(pulls(0.5));
    assert_eq!(kinds(&then, &now), [], "new, and fine");
    now.checks[0].steps[0].measurements.push(pulls(3.0));
    now.checks[0].steps[0].measurements.remove(1);
    assert_eq!(kinds(&then, &now), [ChangeKind::Regression]);
    let mut baseline = Baseline::of(&then);
    let issue = |quantity: &str| KnownIssue {
        check: CHECK.into(),
        quantity: Some(quantity.into()),
        time_step: None,
        least: None,
        most: None,
        reason: "known".into(),
        expires: None,
    };
    for (quantity, kind) in [("error", ChangeKind::Regression), ("ground that pulls", ChangeKind::Known)] {
        baseline.known_issues = vec![issue(quantity)];
        let changes = baseline.compare(&now, day("2026-11-21")).expect("comparable");
        assert_eq!(changes.iter().map(|change| change.kind).collect::<Vec<_>>(), [kind]);
    }
    // where nothing was measured before, what is bad now is as new
    let mut errored = then.clone();
    errored.checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Err(crate::Refusal::errored("crashed")))])];
    assert_eq!(kinds(&errored, &errored), []);
    assert!(kinds(&errored, &then).contains(&ChangeKind::Regression));
}

#[test]
fn what_is_bounded_gets_worse_beyond_its_bound() {
    let depth = |value| report(Measurement::new("depth", "m", value, Expectation::at_most(1.0, 1.0, "")));
    let bounce = |value| report(Measurement::new("height", "m", value, Expectation::at_least(1.0, 1.0, "")));
    assert_eq!(kinds(&depth(1.25), &depth(1.5)), [ChangeKind::Regression]);
    assert_eq!(kinds(&bounce(0.75), &bounce(0.5)), [ChangeKind::Regression]);
    assert_eq!(kinds(&bounce(0.5), &bounce(0.75)), [ChangeKind::Improvement]);
    assert_eq!(kinds(&depth(0.25), &depth(0.5)), [], "neither is on the wrong side");
}

#[test]
fn losing_a_check_is_a_regression() {
    let mut lost = value(0.25, 0.0);
    let refusal = crate::Refusal::unsupported("no longer");
    lost.checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Err(refusal))])];
    assert_eq!(kinds(&value(0.25, 0.0), &lost), [ChangeKind::Regression]);
}

#[test]
fn losing_a_quantity_or_a_time_step_is_a_regression_told_once() {
    let pair = |names: &[&str]| {
        let one = |name: &&str| Measurement::new(*name, "m", 0.25, Expectation::equal(0.0, 1.0, ""));
        StepOutcome::new(Some(0.5), Ok(names.iter().map(one).collect()))
    };
    let of = |steps: Vec<StepOutcome>| Report { checks: vec![CheckOutcome::new(CHECK, steps)], ..value(0.0, 0.0) };
    let both = of(vec![pair(&["depth", "speed"])]);
    let told = |now: &Report| Baseline::of(&both).compare(now, day("2026-11-21")).expect("comparable");
    assert_eq!(told(&both), []);
    let changes = told(&of(vec![pair(&["speed"])]));
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert_eq!((changes[0].kind, changes[0].what.as_str()), (ChangeKind::Regression, "no longer measured at h = 0.5 s: depth"));
    assert_eq!(told(&of(vec![pair(&["depth", "speed", "new"])])), [], "more is measured");
    let refused = StepOutcome::new(Some(0.5), Err(crate::Refusal::unsupported("not at this step")));
    let beside = Measurement::new("depth", "m", 0.25, Expectation::equal(0.0, 1.0, ""));
    let mut failing = beside.clone();
    failing.value = 2.0;
    let other = |one: Measurement| StepOutcome::new(Some(0.25), Ok(vec![one]));
    let changes = told(&of(vec![refused.clone(), other(beside)]));
    assert_eq!(changes.len(), 1, "the verdict says it already: {changes:?}");
    // a failure at another step hides that nothing is measured here from the worst verdict
    let was = of(vec![pair(&["depth", "speed"]), other(failing.clone())]);
    let changes = Baseline::of(&was).compare(&of(vec![refused, other(failing)]), day("2026-11-21")).expect("comparable");
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert_eq!(changes[0].what, "no longer measured at h = 0.5 s: depth, speed: not at this step");
}

#[test]
fn a_check_that_the_gate_no_longer_has_is_a_regression() {
    let mut baseline = Baseline::of(&value(0.0, 0.0));
    baseline.checks[0].name = "rest/forgotten".into();
    let changes = baseline.compare(&value(0.0, 0.0), day("2026-11-21")).expect("comparable");
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert_eq!((changes[0].kind, changes[0].check.as_str()), (ChangeKind::Regression, "rest/forgotten"));
}

#[test]
fn the_audit_of_a_stored_motion_is_met_by_the_same_and_missed_where_it_is_gone() {
    let mut stored = value(0.25, 0.0);
    stored.checks[0].check = "trajectory/a".into();
    let told = |now: &Report| Baseline::of(&stored).compare(now, day("2026-11-21")).expect("comparable");
    assert_eq!(told(&stored), []);
    let changes = told(&value(0.25, 0.0));
    assert_eq!((changes.len(), changes[0].kind, changes[0].check.as_str()), (1, ChangeKind::Regression, "trajectory/a"), "{changes:?}");
    assert!(changes[0].what.contains("no file `a` is judged"), "{changes:?}");
}

#[test]
fn values_without_a_partner_are_told_and_a_check_of_which_none_has_one_is_a_regression() {
    let at = |h: Option<f64>, quantity: &str| {
        StepOutcome::new(h, Ok(vec![Measurement::new(quantity, "m", 0.25, Expectation::equal(0.0, 1.0, ""))]))
    };
    let of = |steps: Vec<StepOutcome>| Report { checks: vec![CheckOutcome::new(CHECK, steps)], ..value(0.0, 0.0) };
    let both = of(vec![at(Some(0.5), "error"), at(Some(0.25), "error")]);
    let compared = |then: &Report, now: &Report| {
        let baseline = Baseline::of(then);
        (baseline.compare(now, day("2026-11-21")).expect("comparable"), baseline.notes(now))
    };
    assert_eq!(compared(&both, &both), (vec![], vec![]));
    let one = of(vec![at(Some(0.5), "error")]);
    let (changes, notes) = compared(&one, &both);
    assert_eq!(
        (changes.len(), notes),
        (0, vec![format!("{CHECK} has 1 value in the run only, compared with nothing: make a new baseline")])
    );
    let (changes, notes) = compared(&both, &one);
    let told = vec![format!("{CHECK} has 1 value in the baseline only, compared with nothing: make a new baseline")];
    assert_eq!((changes.len(), notes), (0, told));
    for apart in [of(vec![at(Some(0.125), "error")]), of(vec![at(None, "error")])] {
        let (changes, notes) = compared(&one, &apart);
        assert_eq!((changes.len(), changes[0].kind, notes.len()), (1, ChangeKind::Regression, 1), "{changes:?}");
        assert!(
            changes[0].what.contains("none of its values has a partner") && notes[0].contains("run only and 1 value in the"),
            "{notes:?}"
        );
    }
}

#[test]
fn a_failure_of_a_check_that_the_baseline_lacks_is_a_regression() {
    let mut baseline = Baseline::of(&value(0.0, 0.0));
    baseline.checks.clear();
    let kinds = |now: &Report| baseline.compare(now, day("2026-11-21")).expect("comparable").len();
    assert_eq!((kinds(&value(0.5, 0.0)), kinds(&value(1.5, 0.0))), (0, 1));
}

/// The whole check is known to be bad.
fn known() -> KnownIssue {
    KnownIssue { check: CHECK.into(), quantity: None, time_step: None, least: None, most: None, reason: "issue 7".into(), expires: None }
}

#[test]
fn a_known_issue_covers_its_quantity_step_and_values_and_nothing_else() {
    let mut baseline = Baseline::of(&value(0.5, 0.0));
    let of_error = |step: f64, least: f64, most: f64| KnownIssue {
        quantity: Some("error".into()),
        time_step: Some(step),
        least: Some(least),
        most: Some(most),
        ..known()
    };
    for (issue, accepted) in [
        (of_error(0.5, 1.0, 2.0), true),
        (of_error(0.5, 1.5, 1.5), true),
        (of_error(0.25, 1.0, 2.0), false),
        (of_error(0.5, 1.6, 2.0), false),
        (of_error(0.5, 1.0, 1.4), false),
        (KnownIssue { quantity: Some("another".into()), ..known() }, false),
        (KnownIssue { check: "another/check".into(), ..known() }, false),
    ] {
        baseline.known_issues = vec![issue.clone()];
        let changes = baseline.compare(&value(1.5, 0.0), day("2026-11-21")).expect("comparable");
        assert_eq!(changes.len(), 2, "the verdict and the value: {changes:?}");
        assert!(changes.iter().all(|change| (change.kind == ChangeKind::Known) == accepted), "{issue:?}: {changes:?}");
    }
    // a crash is not the failure that is known
    baseline.known_issues = vec![of_error(0.5, 1.0, 2.0)];
    let mut crashed = value(0.5, 0.0);
    crashed.checks = vec![CheckOutcome::new(CHECK, vec![StepOutcome::new(Some(0.5), Err(crate::Refusal::errored("crashed")))])];
    let changes = baseline.compare(&crashed, day("2026-11-21")).expect("comparable");
    assert_eq!(changes.iter().map(|change| change.kind).collect::<Vec<_>>(), [ChangeKind::Regression]);
}

#[test]
fn two_values_that_are_told_apart_by_many_digits_only_are_told_with_them() {
    let changes = Baseline::of(&value(1.0, 0.0)).compare(&value(1.001_000_01, 0.0), day("2026-11-21")).expect("comparable");
    assert!(changes.iter().any(|change| change.what.contains("1.001 m instead of 1")), "{changes:?}");
    let tight = |value| report(Measurement::new("error", "m", value, Expectation::equal(0.0, crate::tolerance::PERTURBATION, "")));
    let changes = Baseline::of(&tight(1.0)).compare(&tight(1.000_000_01), day("2026-11-21")).expect("comparable");
    assert!(changes[0].what.contains("1.00000001e0 m instead of 1e0"), "{changes:?}");
}

#[test]
fn a_day_that_is_none_is_named_and_no_new_file_is_advised() {
    let file = std::env::temp_dir().join(format!("moreau-baseline-{}.toml", std::process::id()));
    let mut baseline = Baseline::of(&value(0.5, 0.0));
    baseline.known_issues = vec![KnownIssue { check: "ball/restitution".into(), expires: Some(day("2027-01-31")), ..known() }];
    let text = baseline.to_toml().expect("writable").replace("2027-01-31", "2027-02-31");
    std::fs::write(&file, text).expect("a writable folder");
    let told = Baseline::read(&file).expect_err("no such day").to_string();
    std::fs::remove_file(&file).expect("removable");
    assert!(told.contains("known_issue.expires") && told.contains("2027-01-31") && !told.contains("--save-baseline"), "{told}");
}

#[test]
fn a_known_issue_names_its_step_as_reports_print_it_and_one_that_can_never_hold_is_refused() {
    let at = |time_step: f64| KnownIssue { time_step: Some(time_step), ..known() };
    let one = Measurement::new("error", "m", 1.5, Expectation::equal(0.0, 1.0, ""));
    assert!(at(0.0166667).covers(CHECK, Some(1.0 / 60.0), &one) && !at(0.01667).covers(CHECK, Some(1.0 / 60.0), &one));
    let bounded = |least: f64, most: f64| KnownIssue { least: Some(least), most: Some(most), ..known() };
    for (issue, words) in [(bounded(2.0, 1.0), "least"), (bounded(0.0, f64::NAN), "no number"), (at(-1.0), "time_step")] {
        assert!(issue.contradiction().is_some_and(|problem| problem.contains(words)), "{issue:?}");
    }
    assert!(bounded(1.0, 1.0).contradiction().is_none() && at(0.5).contradiction().is_none() && known().contradiction().is_none());
}

#[test]
fn a_known_issue_is_accepted_until_its_day() {
    let mut baseline = Baseline::of(&value(0.5, 0.0));
    let known = |expires| KnownIssue { expires, ..known() };
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
fn a_value_that_is_none_is_told_by_its_key_and_line_in_plain_words() {
    let file = std::env::temp_dir().join(format!("moreau-baseline-words-{}.toml", std::process::id()));
    let text = Baseline::of(&value(0.5, 0.0)).to_toml().expect("writable");
    let cases = [
        ("value = 0.5", "value = \"x\"", "`value`", "is the text \"x\"; give a number"),
        ("engine = \"toy\"", "engine = 5", "`engine`", "is 5; give a text"),
    ];
    for (right, wrong, field, words) in cases {
        assert!(text.contains(right), "{right}: {text}");
        std::fs::write(&file, text.replacen(right, wrong, 1)).expect("a folder for temporary files");
        let told = Baseline::read(&file).expect_err("no such value").to_string();
        assert!(told.contains(field) && told.contains("line ") && told.contains(words) && told.contains("--save-baseline"), "{told}");
    }
    std::fs::remove_file(&file).expect("it was written");
}

#[test]
fn a_baseline_survives_its_file() {
    let mut baseline = Baseline::of(&value(0.1 + 0.2, 1.0 / 3.0));
    let expires = Some(day("2027-01-31"));
    let bounded = KnownIssue { quantity: Some("v".into()), time_step: Some(0.1), least: Some(0.0), most: Some(1.0), ..known() };
    baseline.known_issues = vec![KnownIssue { check: "ball/restitution".into(), reason: "“quoted”".into(), expires, ..bounded }];
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

#[test]
fn a_part_of_the_time_steps_is_compared_with_that_part() {
    let at =
        |h: f64, error: f64| StepOutcome::new(Some(h), Ok(vec![Measurement::new("error", "m", error, Expectation::equal(0.0, 1.0, ""))]));
    let of = |steps: Vec<StepOutcome>| Report {
        sweep: steps.iter().filter_map(|step| step.time_step).collect(),
        checks: vec![CheckOutcome::new(CHECK, steps)],
        ..value(0.0, 0.0)
    };
    let baseline = Baseline::of(&of(vec![at(0.5, 0.25), at(0.25, 0.125)]));
    let changes = |now: &Report| baseline.at(&now.sweep).compare(now, day("2026-11-21"));
    assert_eq!(changes(&of(vec![at(0.25, 0.125)])).expect("comparable"), []);
    let worse = changes(&of(vec![at(0.25, 0.25)])).expect("comparable");
    assert!(worse.len() == 1 && worse[0].kind == ChangeKind::Regression, "as bad as another step was is worse here: {worse:?}");
    assert!(changes(&of(vec![at(0.125, 0.0)])).is_err(), "a time step that the baseline does not have");
    assert!(baseline.compare(&of(vec![at(0.25, 0.125)]), day("2026-11-21")).is_err(), "the whole baseline wants the whole run");
}

#[test]
fn a_file_that_is_cut_anywhere_is_told_by_its_name_with_a_cure() {
    let file = std::env::temp_dir().join(format!("moreau-baseline-cut-{}.toml", std::process::id()));
    let name = file.display().to_string();
    let whole = Baseline::of(&value(0.25, 0.125)).to_toml().expect("a text");
    let mut cut = 0;
    for end in 0..whole.len() - 1 {
        std::fs::write(&file, &whole[..end]).expect("writable");
        // between two entries it is whole, with fewer of them
        let Err(error) = Baseline::read(&file) else { continue };
        let message = error.to_string();
        let told = message.contains(&name) && message.contains("take a whole copy of the file, or make a new one");
        assert!(told && message.contains(if whole[..end].trim().is_empty() { "is empty" } else { "is the last one" }), "{end}: {message}");
        cut += 1;
    }
    assert!(cut > whole.len() / 2, "{cut} of {}", whole.len());
    // what is wrong before the end is no cut
    std::fs::write(&file, whole.replace("verdict = \"pass\"", "verdict = \"splendid\"")).expect("writable");
    let message = Baseline::read(&file).expect_err("no verdict").to_string();
    std::fs::remove_file(&file).expect("removable");
    assert!(!message.contains("is the last one") && message.contains(&name), "{message}");
}
