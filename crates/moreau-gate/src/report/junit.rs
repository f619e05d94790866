//! The gate's report as JUnit XML, one test case per check, failures first.

use crate::baseline::{Change, ChangeKind};
use crate::report::words;
use crate::{CheckOutcome, Report, Verdict};
use moreau_exact::{Error, Result};
use quick_junit::{NonSuccessKind, Report as Junit, TestCase, TestCaseStatus, TestSuite};
use std::collections::BTreeMap;
use std::time::Duration;

/// The report as JUnit XML; with a baseline, a regression is a failure and a known failure is a skipped test. `times` is how long
/// the measurements of a check took, by name.
///
/// # Errors
/// [`Error::Unsupported`] if the writer fails.
pub fn xml(report: &Report, changes: Option<&[Change]>, times: &BTreeMap<String, Duration>) -> Result<String> {
    let mut suite = TestSuite::new(format!("{} {}", report.engine.name, report.engine.version));
    let mut cases: Vec<TestCase> = report.checks.iter().map(|check| case(check, changes, times)).collect();
    cases.sort_by_key(|case| !matches!(case.status, TestCaseStatus::NonSuccess { .. }));
    suite.set_time(times.values().sum());
    suite.add_test_cases(cases);
    let mut junit = Junit::new("moreau gate");
    junit.add_test_suite(suite);
    junit.to_string().map_err(|error| Error::Unsupported(format!("cannot write JUnit: {error}")))
}

fn case(check: &CheckOutcome, changes: Option<&[Change]>, times: &BTreeMap<String, Duration>) -> TestCase {
    let words = words(check);
    let mut case = TestCase::new(check.check.clone(), status(check, changes, &words));
    case.set_classname(check.check.split('/').next().unwrap_or(&check.check).to_string());
    case.set_system_out(words);
    if let Some(time) = times.get(&check.check) {
        case.set_time(*time);
    }
    case
}

fn status(check: &CheckOutcome, changes: Option<&[Change]>, words: &str) -> TestCaseStatus {
    let failure = |kind, message: &str| {
        let mut status = TestCaseStatus::non_success(kind);
        status.set_message(message.to_string()).set_type(check.verdict.word());
        status
    };
    let skipped = |message: &str| {
        let mut status = TestCaseStatus::skipped();
        status.set_message(message.to_string());
        status
    };
    let of = |kind| changes.unwrap_or(&[]).iter().find(|change| change.check == check.check && change.kind == kind);
    match (of(ChangeKind::Regression), check.verdict) {
        (Some(change), Verdict::Errored) => failure(NonSuccessKind::Error, &change.what),
        (Some(change), _) => failure(NonSuccessKind::Failure, &change.what),
        (None, verdict) if verdict.is_bad() && changes.is_some() => match of(ChangeKind::Known) {
            Some(change) => skipped(&change.what),
            None => skipped(&format!("as the baseline: {words}")),
        },
        (None, Verdict::Fail) => failure(NonSuccessKind::Failure, words),
        (None, Verdict::Errored) => failure(NonSuccessKind::Error, words),
        (None, Verdict::Unsupported) => skipped(words),
        (None, Verdict::Pass | Verdict::Difference) => TestCaseStatus::success(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, StepOutcome, own};

    fn outcome(verdict: Verdict) -> CheckOutcome {
        CheckOutcome::new("made-up/check", vec![StepOutcome::planted(0.5, verdict)])
    }

    /// `success`, `skipped`, `failure` or `error`, and the message.
    fn told(verdict: Verdict, changes: Option<ChangeKind>) -> (&'static str, String) {
        let change = |kind| Change { check: "made-up/check".into(), kind, what: "got worse".into() };
        let other = Change { check: "made-up/other".into(), kind: ChangeKind::Regression, what: "another".into() };
        let changes = changes.map(|kind| vec![other, change(kind)]);
        let outcome = outcome(verdict);
        assert_eq!(outcome.verdict, verdict);
        match status(&outcome, changes.as_deref(), "words") {
            TestCaseStatus::Success { .. } => ("success", String::new()),
            TestCaseStatus::Skipped { message, .. } => ("skipped", message.map(String::from).unwrap_or_default()),
            TestCaseStatus::NonSuccess { kind, message, .. } => {
                let kind = if kind == NonSuccessKind::Failure { "failure" } else { "error" };
                (kind, message.map(String::from).unwrap_or_default())
            }
        }
    }

    #[test]
    fn failures_and_errors_come_first() {
        let engine = own::by_name("moreau-jean").expect("listed").describe(&Options::new()).expect("describes itself");
        let cases = [
            ("a/passes", Verdict::Pass),
            ("a/fails", Verdict::Fail),
            ("a/is-not-asked", Verdict::Unsupported),
            ("a/errs", Verdict::Errored),
        ];
        let checks = cases.map(|(name, verdict)| CheckOutcome { check: name.into(), ..outcome(verdict) }).to_vec();
        let report = Report { schema: crate::outcome::SCHEMA.into(), engine, adapter: Vec::new(), sweep: vec![0.5], checks };
        let text = xml(&report, None, &BTreeMap::new()).expect("writes");
        let place = |name: &str| text.find(&format!("name=\"{name}\"")).expect("every check is a case");
        for bad in ["a/fails", "a/errs"] {
            assert!(place(bad) < place("a/passes").min(place("a/is-not-asked")), "{text}");
        }
    }

    #[test]
    fn without_a_baseline_a_verdict_has_its_own_status() {
        let statuses = [Verdict::Pass, Verdict::Difference, Verdict::Unsupported, Verdict::Errored, Verdict::Fail];
        assert_eq!(statuses.map(|verdict| told(verdict, None).0), ["success", "success", "skipped", "error", "failure"]);
    }

    #[test]
    fn a_regression_is_a_failure_unless_there_was_no_answer_and_what_was_bad_before_is_skipped() {
        let worse = Some(ChangeKind::Regression);
        for verdict in [Verdict::Pass, Verdict::Difference, Verdict::Unsupported, Verdict::Fail] {
            assert_eq!(told(verdict, worse), ("failure", "got worse".into()), "{verdict:?}");
        }
        assert_eq!(told(Verdict::Errored, worse), ("error", "got worse".into()));
        for verdict in [Verdict::Fail, Verdict::Errored] {
            assert_eq!(told(verdict, Some(ChangeKind::Known)), ("skipped", "got worse".into()), "what is known of it");
            assert_eq!(told(verdict, Some(ChangeKind::Improvement)), ("skipped", "as the baseline: words".into()));
        }
        assert_eq!(told(Verdict::Pass, Some(ChangeKind::Improvement)).0, "success");
    }
}
