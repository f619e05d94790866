//! The gate's report as JUnit XML, one test case per check.

use crate::baseline::{Change, ChangeKind};
use crate::report::{decisive, sentence};
use crate::{CheckOutcome, Report, Verdict};
use moreau_exact::{Error, Result};
use quick_junit::{NonSuccessKind, Report as Junit, TestCase, TestCaseStatus, TestSuite};

/// The report as JUnit XML; with a baseline, a regression is a failure and a known failure is a skipped test.
///
/// # Errors
/// [`Error::Unsupported`] if the writer fails.
pub fn xml(report: &Report, changes: Option<&[Change]>) -> Result<String> {
    let mut suite = TestSuite::new(format!("{} {}", report.engine.name, report.engine.version));
    suite.add_test_cases(report.checks.iter().map(|check| case(check, changes)));
    let mut junit = Junit::new("moreau gate");
    junit.add_test_suite(suite);
    junit.to_string().map_err(|error| Error::Unsupported(format!("cannot write JUnit: {error}")))
}

fn case(check: &CheckOutcome, changes: Option<&[Change]>) -> TestCase {
    let words = check.reason.clone().or_else(|| decisive(check).map(|(step, one)| sentence(step, one))).unwrap_or_default();
    let mut case = TestCase::new(check.check.clone(), status(check, changes, &words));
    case.set_classname(check.check.split('/').next().unwrap_or(&check.check).to_string());
    case.set_system_out(words);
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
    let regression = changes.unwrap_or(&[]).iter().find(|change| change.check == check.check && change.kind == ChangeKind::Regression);
    match (regression, check.verdict) {
        (Some(change), Verdict::Errored) => failure(NonSuccessKind::Error, &change.what),
        (Some(change), _) => failure(NonSuccessKind::Failure, &change.what),
        (None, verdict) if verdict.is_bad() && changes.is_some() => skipped(&format!("as the baseline: {words}")),
        (None, Verdict::Fail) => failure(NonSuccessKind::Failure, words),
        (None, Verdict::Errored) => failure(NonSuccessKind::Error, words),
        (None, Verdict::Unsupported) => skipped(words),
        (None, Verdict::Pass | Verdict::Difference) => TestCaseStatus::success(),
    }
}
