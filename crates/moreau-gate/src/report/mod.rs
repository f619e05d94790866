//! The gate's report for people, for build servers and as a page.

pub mod conformance;
pub mod frame;
pub mod highlights;
pub mod junit;
pub mod page;
mod plot;
pub mod scoreboard;
pub mod scoreboard_page;
pub mod terminal;
pub mod text;

use crate::{CheckOutcome, Measurement, Report, StepOutcome, Verdict};
use moreau_checks::Relation;

/// The verdicts in the order of a summary.
const ORDER: [Verdict; 5] = [Verdict::Pass, Verdict::Difference, Verdict::Unsupported, Verdict::Errored, Verdict::Fail];

/// How many checks have each verdict, in words.
fn counts(report: &Report) -> String {
    ORDER.iter().map(|verdict| format!("{} {}", report.count(*verdict), verdict.word())).collect::<Vec<_>>().join(", ")
}

/// The measurement that decides a check: the first of the worst verdict at the largest step, or the first of all.
pub fn decisive(check: &CheckOutcome) -> Option<(&StepOutcome, &Measurement)> {
    let of = |step: &StepOutcome, verdict: Verdict| step.measurements.iter().position(|one| one.verdict() == verdict);
    let worst = check.steps.iter().find_map(|step| of(step, check.verdict).map(|index| (step, &step.measurements[index])));
    worst.or_else(|| check.steps.iter().find_map(|step| step.measurements.first().map(|one| (step, one))))
}

/// Why a check came out as it did: its reason, or the measurement that decides it.
fn words(check: &CheckOutcome) -> String {
    check.reason.clone().or_else(|| decisive(check).map(|(step, one)| sentence(step, one))).unwrap_or_default()
}

/// One line about a measurement: value, what was expected, of whom.
pub fn sentence(step: &StepOutcome, one: &Measurement) -> String {
    use moreau_exact::number::{significant, with_unit};
    let expectation = match (&one.model, one.verdict()) {
        (Some(model), Verdict::Fail | Verdict::Difference) => model,
        _ => &one.ideal,
    };
    let at = step.time_step.map_or(String::new(), |h| format!(" at h = {} s", significant(h)));
    let value = with_unit(&significant(one.value), &one.unit);
    let expected = match expectation.relation {
        Relation::Equal => format!("{} ± {:.1e}", significant(expectation.value), expectation.tolerance),
        Relation::AtMost => format!("at most {}", significant(expectation.value + expectation.tolerance)),
        Relation::AtLeast => format!("at least {}", significant(expectation.value - expectation.tolerance)),
    };
    format!("{}{at}: {value} (expected {expected}: {})", one.quantity, expectation.why)
}
