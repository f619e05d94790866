//! The scoreboard as a table, engine × family of checks, in Markdown for docs/scoreboard.md.

use crate::cause::Cause;
use crate::report::highlights;
use crate::scoreboard::Standing;
use crate::{CheckOutcome, Report, Verdict, cause, checks};
use std::collections::BTreeMap;

/// Where the table of a Markdown file begins.
pub const BEGIN: &str = "<!-- scoreboard -->";
/// Where it ends.
pub const END: &str = "<!-- /scoreboard -->";

/// What the marks mean.
pub(super) const MARKS: &str = "✓ as Coulomb–Signorini demands · ≈ different, as the engine's declared law predicts · ✗ fails · \
    ! errored · – the engine does not do this";

/// The mark of a verdict in a table.
pub(super) fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓",
        Verdict::Difference => "≈",
        Verdict::Fail => "✗",
        Verdict::Errored => "!",
        Verdict::Unsupported => "–",
    }
}

/// The families of the registry, in its order.
pub(super) fn families() -> Vec<&'static str> {
    let mut families: Vec<&str> = Vec::new();
    for family in checks::all().map(|check| check.family()) {
        if !families.contains(&family) {
            families.push(family);
        }
    }
    families
}

/// What stands between [`BEGIN`] and [`END`]: the table and the highlights.
pub fn section(standings: &[Standing], causes: &[Cause]) -> String {
    format!("{}\n{}", markdown(standings, causes), highlights::markdown(standings))
}

/// The table of docs/scoreboard.md: one row per engine, one column per family, in each cell the marks of its checks in the registry's
/// order; at last how many of them do not pass for which cause.
fn markdown(standings: &[Standing], causes: &[Cause]) -> String {
    let families = families();
    let row = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let heading: Vec<String> =
        ["engine".to_string()].into_iter().chain(families.iter().map(ToString::to_string)).chain(["causes of ✗ and !".into()]).collect();
    let mut text = row(&heading) + &row(&vec!["---".into(); heading.len()]);
    for standing in standings {
        let Some(report) = &standing.report else {
            text += &row(&[standing.entry.name.clone(), format!("not run: {}", standing.not_run.as_deref().unwrap_or("no reason stored"))]);
            continue;
        };
        let name = format!("{} ({} {})", standing.entry.name, report.engine.name, report.engine.version);
        let cells = families.iter().map(|family| marks(report, family));
        text += &row(&[name].into_iter().chain(cells).chain([counted(&standing.entry.name, report, causes)]).collect::<Vec<_>>());
    }
    text + &format!("\n{MARKS}\n")
}

/// `solver 3, collision 1`.
pub(super) fn counted(engine: &str, report: &Report, causes: &[Cause]) -> String {
    let bad = report.checks.iter().filter(|outcome| outcome.verdict.is_bad());
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for outcome in bad {
        let word = cause::find(causes, engine, &outcome.check).map_or("unexplained", |cause| cause.error.word());
        *counts.entry(word).or_default() += 1;
    }
    counts.iter().map(|(word, count)| format!("{word} {count}")).collect::<Vec<_>>().join(", ")
}

/// The marks of a family's checks.
pub(super) fn marks(report: &Report, family: &str) -> String {
    let of_family = |outcome: &&CheckOutcome| outcome.check.split('/').next() == Some(family);
    report.checks.iter().filter(of_family).map(|outcome| mark(outcome.verdict)).collect()
}
