//! The scoreboard as one self-contained HTML page: counts first, then the marks, and behind every mark the number that decided it.
//!
//! What a link leads to stands inside of what is to be opened: a browser opens the parts around it.

use crate::cause::{self, Cause};
use crate::report::frame::{VERSION, document, scrolled, with_code};
use crate::report::scoreboard::{MARKS, counted, families, mark};
use crate::report::{ORDER, highlights, words};
use crate::scoreboard::Standing;
use crate::{CheckOutcome, Report, Verdict, checks};
use jiff::civil::Date;
use maud::{Markup, html};
use moreau_exact::number::significant;

/// What the common style does not have.
const STYLE: &str = include_str!("scoreboard.css");

/// The page of a day.
pub fn html(standings: &[Standing], causes: &[Cause], day: Date) -> String {
    let body = html! {
        h1 { "moreau scoreboard: simulators through one set of checks" }
        p.meta { "Written by moreau " (VERSION) " on " (day) ". The version of each engine stands beside its name." }
        p { (MARKS) "." }
        h2 { "The engines" }
        (scrolled("How many checks of each engine have which verdict", &counts(standings, causes)))
        h2 { "What it shows" }
        (highlights::html(standings))
        h2 { "Every check of every engine" }
        p { "A mark leads to the number that decided it, the name of a check to its question." }
        (scrolled("Engines down, checks across", &matrix(standings)))
        h2 { "Every number" }
        @for standing in standings { (numbers(standing, causes)) }
        h2 { "Why checks are not passed" }
        @for (k, cause) in causes.iter().enumerate() { (reason(k, cause)) }
        h2 { "The checks" }
        @for family in families() { (questions(family)) }
    };
    document("moreau scoreboard", STYLE, &body)
}

/// One row per engine, the bad verdicts first.
fn counts(standings: &[Standing], causes: &[Cause]) -> Markup {
    let verdicts = || ORDER.iter().rev().copied();
    html! {
        table.engines {
            thead { tr {
                th { "engine" }
                @for verdict in verdicts() { th { (mark(verdict)) " " (verdict.word()) } }
                th { "causes of ✗ and !" }
            } }
            tbody {
                @for standing in standings {
                    tr {
                        td { (name(standing)) }
                        @match &standing.report {
                            Some(report) => {
                                @for verdict in verdicts() { (count(verdict, report.count(verdict))) }
                                td { (counted(&standing.entry.name, report, causes)) }
                            },
                            None => { td colspan="6" { (not_run(standing)) } },
                        }
                    }
                }
            }
        }
    }
}

/// How often there is a verdict, coloured where it is bad.
fn count(verdict: Verdict, count: usize) -> Markup {
    html! { td class={ "n " (if verdict.is_bad() && count > 0 { verdict.word() } else { "" }) } { (count) } }
}

/// The name of an engine, which leads to its numbers, and its version.
fn name(standing: &Standing) -> Markup {
    html! {
        a href={ "#engine:" (standing.entry.name) } { (standing.entry.name) }
        @if let Some(report) = &standing.report { small { (report.engine.name) " " (report.engine.version) } }
    }
}

fn not_run(standing: &Standing) -> Markup {
    html! { "not run: " (with_code(standing.not_run.as_deref().unwrap_or("no reason stored"))) }
}

fn matrix(standings: &[Standing]) -> Markup {
    html! {
        table.matrix {
            thead { tr { th { "engine" } @for check in checks::all() { th { a href={ "#check:" (check.name) } { (check.name) } } } } }
            tbody {
                @for standing in standings {
                    tr {
                        th scope="row" { (name(standing)) }
                        @match &standing.report {
                            Some(report) => { @for check in checks::all() { (cell(&standing.entry.name, report, check.name)) } },
                            None => { td colspan=(checks::all().count()) { (not_run(standing)) } },
                        }
                    }
                }
            }
        }
    }
}

/// A mark, which leads to its number.
fn cell(engine: &str, report: &Report, check: &str) -> Markup {
    let Some(outcome) = report.checks.iter().find(|outcome| outcome.check == check) else { return html! { td { "·" } } };
    let word = outcome.verdict.word();
    html! {
        td class=(word) { a href={ "#" (engine) ":" (check) } aria-label={ (engine) ", " (check) ": " (word) } { (mark(outcome.verdict)) } }
    }
}

/// Everything that is known of an engine, the bad verdicts first.
fn numbers(standing: &Standing, causes: &[Cause]) -> Markup {
    let engine = &standing.entry.name;
    let of = |report: &Report, verdict: Verdict| -> Vec<CheckOutcome> {
        report.checks.iter().filter(|outcome| outcome.verdict == verdict).cloned().collect()
    };
    html! {
        details {
            summary { b { (engine) } @if let Some(report) = &standing.report {
                " " small { (report.engine.name) " " (report.engine.version) }
            } }
            @match &standing.report {
                Some(report) => {
                    p id={ "engine:" (engine) } { "Installed by " code { (standing.entry.install) } "." }
                    @for verdict in ORDER.iter().rev() {
                        @for outcome in of(report, *verdict) { (number(engine, &outcome, causes)) }
                    }
                },
                None => { p id={ "engine:" (engine) } { (not_run(standing)) } },
            }
        }
    }
}

/// What decided one check of one engine, and why it came out so where that was found out.
fn number(engine: &str, outcome: &CheckOutcome, causes: &[Cause]) -> Markup {
    let word = outcome.verdict.word();
    let at = outcome.fails_at.iter().map(|h| significant(*h)).collect::<Vec<_>>().join(", ");
    let cause = causes.iter().position(|one| cause::is_of(one, engine, &outcome.check));
    html! {
        details open[outcome.verdict.is_bad()] {
            summary { span class={ "verdict " (word) } { (mark(outcome.verdict)) " " (word) } (outcome.check) }
            p id={ (engine) ":" (outcome.check) } { (with_code(&words(outcome))) @if !at.is_empty() { "; bad at h = " (at) " s" } }
            @if let Some(k) = cause {
                p { a href={ "#cause:" (k) } { (causes[k].error.word()) } ": " (with_code(&causes[k].cause)) }
            }
        }
    }
}

/// A cause with its evidence.
fn reason(k: usize, cause: &Cause) -> Markup {
    html! {
        details {
            summary { b { (cause.error.word()) } ": " (cause.engines.join(", ")) ": " (cause.checks.join(", ")) }
            p id={ "cause:" (k) } { (with_code(&cause.cause)) }
            p { "Seen by this: " (with_code(&cause.evidence)) }
        }
    }
}

/// The questions of a family of checks.
fn questions(family: &str) -> Markup {
    html! {
        details {
            summary { (family) }
            dl {
                @for check in checks::all().filter(|check| check.family() == family) {
                    dt id={ "check:" (check.name) } { code { (check.name) } }
                    dd { (with_code(check.question)) }
                }
            }
        }
    }
}
