//! The scoreboard as a table, engine × check: Markdown for docs/scoreboard.md, HTML with every value.

use crate::cause::Cause;
use crate::report::{decisive, highlights, page, sentence};
use crate::scoreboard::Standing;
use crate::{CheckOutcome, Report, Verdict, cause, checks};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use moreau_exact::Result;
use moreau_exact::number::significant;
use std::collections::BTreeMap;

/// Where the table of a Markdown file begins.
pub const BEGIN: &str = "<!-- scoreboard -->";
/// Where it ends.
pub const END: &str = "<!-- /scoreboard -->";

/// The mark of a verdict in a table.
fn mark(verdict: Verdict) -> &'static str {
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
    text + "\n✓ as Coulomb–Signorini demands · ≈ different, as the engine's declared law predicts · ✗ fails · ! errored · – the engine \
        does not do this\n"
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

/// One self-contained page: the whole table, what decided each cell when one points at it, and the causes.
///
/// # Errors
/// If the page cannot be made.
pub fn html(standings: &[Standing], causes: &[Cause]) -> Result<String> {
    let style = format!(
        "{}{}",
        page::STYLE,
        "body{max-width:none}th.r{writing-mode:vertical-rl;transform:rotate(180deg);font-weight:normal}\
            td.c{text-align:center}td:first-child{white-space:nowrap}"
    );
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head { meta charset="utf-8"; title { "moreau scoreboard" } style { (PreEscaped(style)) } }
            body {
                h1 { "moreau scoreboard: simulators through one set of checks" }
                p { "✓ as Coulomb–Signorini demands · ≈ different, as the engine's declared law predicts · ✗ fails · ! errored · – the \
                    engine does not do this. Point at a mark to see the number." }
                (table(standings, causes))
                h2 { "What it shows" }
                (highlights::html(standings))
                h2 { "Why checks are not passed" }
                (reasons(causes))
            }
        }
    };
    Ok(page.into_string())
}

/// The causes, with their evidence.
fn reasons(causes: &[Cause]) -> Markup {
    html! {
        table {
            tr { th { "engines" } th { "checks" } th { "what is at fault" } th { "cause" } th { "evidence" } }
            @for cause in causes {
                tr { td { (cause.engines.join(", ")) } td { (cause.checks.join(", \
                    ")) } td { (cause.error.word()) } td { (cause.cause) } td { (cause.evidence) } }
            }
        }
    }
}

fn table(standings: &[Standing], causes: &[Cause]) -> Markup {
    html! {
        table {
            tr { th { "engine" } @for check in checks::all() { th.r title=(check.question) { (check.name) } } }
            @for standing in standings {
                tr {
                    td { (standing.entry.name) @if let Some(report) = &standing.report { br; small { (report.engine.name) " \
                        " (report.engine.version) } } }
                    @match &standing.report {
                        Some(report) => {
                            @for check in checks::all() {
                                (cell(report, check.name, cause::find(causes, &standing.entry.name, check.name)))
                            }
                        },
                        None => td colspan=(checks::all().count()) { "not run: " (standing.not_run.as_deref().unwrap_or("no reason \
                            stored")) },
                    }
                }
            }
        }
    }
}

fn cell(report: &Report, name: &str, cause: Option<&Cause>) -> Markup {
    let Some(outcome) = report.checks.iter().find(|outcome| outcome.check == name) else { return html! { td.c { "·" } } };
    let words = outcome.reason.clone().or_else(|| decisive(outcome).map(|(step, one)| sentence(step, one))).unwrap_or_default();
    let at = outcome.fails_at.iter().map(|h| significant(*h)).collect::<Vec<_>>().join(", ");
    let title = if at.is_empty() { words } else { format!("{words}; at h = {at} s") };
    let title = cause.map_or(title.clone(), |cause| format!("{title}. {}: {}", cause.error.word(), cause.cause));
    html! { td class={ "c " (outcome.verdict.word()) } title=(title) { (mark(outcome.verdict)) } }
}
