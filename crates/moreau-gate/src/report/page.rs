//! The gate's report as one self-contained HTML page: no scripts, no other files. What fails comes first.

use crate::baseline::{Change, ChangeKind};
use crate::conformance::ProbeOutcome;
use crate::report::frame::{VERSION, document, scrolled, with_code};
use crate::report::{ORDER, plot, words};
use crate::{CheckOutcome, Measurement, Report, StepOutcome, checks};
use jiff::civil::Date;
use maud::{Markup, PreEscaped, html};
use moreau_exact::Result;
use moreau_exact::number::significant;

/// The page of a run on a day, with the changes against a baseline if there is one.
///
/// # Errors
/// If a picture cannot be drawn.
pub fn html(report: &Report, changes: Option<&[Change]>, day: Date) -> Result<String> {
    let title = format!("moreau gate: {} {}", report.engine.name, report.engine.version);
    let (bad, others): (Vec<_>, Vec<_>) = report.checks.iter().partition(|outcome| outcome.verdict.is_bad());
    let every = bad.iter().chain(&others).map(|outcome| details(outcome)).collect::<Result<Vec<_>>>()?;
    let body = html! {
        h1 { (title) }
        p.meta { "Judged by moreau " (VERSION) " on " (day) "." }
        (verdicts(report))
        @if let Some(changes) = changes { (comparison(report, changes)) }
        (failures(&bad))
        (adapter(report))
        h2 { "The engine" }
        (engine(report))
        h2 { "Every check" }
        p { "In the pictures: " b.measured { "measured" } ", " b.allowed { "allowed to a sound discretisation" } ", " b.predicted { "the \
            declared law's own deviation" } "." }
        @for part in every { (part) }
    };
    Ok(document(&title, "", &body))
}

/// How many checks have each verdict, the worst first.
fn verdicts(report: &Report) -> Markup {
    html! {
        p { (report.checks.len()) " checks:" }
        ul.counts {
            @for (verdict, count) in ORDER.iter().rev().map(|verdict| (verdict, report.count(*verdict))) {
                li class=(if count > 0 { verdict.word() } else { "" }) { b { (count) } " " (verdict.word()) }
            }
        }
    }
}

/// One line per check that fails or errs, which leads to it.
fn failures(bad: &[&CheckOutcome]) -> Markup {
    html! {
        h2 { "What is bad" }
        @if bad.is_empty() { p { "No check fails or errs." } }
        ul.list {
            @for outcome in bad {
                li { a href={ "#" (outcome.check) } { (verdict(outcome)) b { (outcome.check) } " " (with_code(&words(outcome))) } }
            }
        }
    }
}

fn verdict(outcome: &CheckOutcome) -> Markup {
    let word = outcome.verdict.word();
    html! { span class={ "verdict " (word) } { (word) } }
}

fn engine(report: &Report) -> Markup {
    let model = &report.engine.contact_model;
    let steps: Vec<String> = report.sweep.iter().map(|h| significant(*h)).collect();
    let parameter = |value: &serde_json::Value| value.to_string();
    html! {
        table {
            tr { th scope="row" { "engine" } td { (report.engine.name) " " (report.engine.version) } }
            tr { th scope="row" { "declared contact" } td {
                (format!("{:?}", model.kind).to_lowercase()) ", " (model.law.as_deref().unwrap_or("no documented law"))
            } }
            tr { th scope="row" { "parameters" } td {
                @if model.parameters.is_empty() { "none" }
                @for (name, one) in &model.parameters {
                    code { (name) " = " (parameter(&serde_json::json!(one.value))) " " (parameter(&serde_json::json!(one.unit))) } " "
                }
            } }
            tr { th scope="row" { "options" } td { code { (serde_json::Value::Object(report.engine.options.clone())) } } }
            tr { th scope="row" { "time steps [s]" } td { (steps.join(", ")) } }
        }
    }
}

/// What is wrong with the adapter.
fn adapter(report: &Report) -> Markup {
    html! {
        @if !report.adapter.is_empty() {
            h2 { "The adapter" }
            ul {
                @for probe in &report.adapter {
                    @if let ProbeOutcome::Problem { why, cure } = &probe.outcome {
                        li class="fail" {
                            b { (probe.probe) } " " (with_code(&probe.demand)) ". Seen: " (with_code(why)) ". Cure: " (with_code(cure)) "."
                        }
                    }
                }
            }
        }
    }
}

fn comparison(report: &Report, changes: &[Change]) -> Markup {
    let class = |kind| if kind == ChangeKind::Regression { "regression" } else { "" };
    let words = |change: &Change| html! { b { (format!("{:?}", change.kind)) } " " (change.check) ": " (with_code(&change.what)) };
    let is_here = |change: &Change| report.checks.iter().any(|outcome| outcome.check == change.check);
    html! {
        h2 { "Against the baseline" }
        @if changes.is_empty() { p { "As the baseline." } }
        ul.list {
            @for change in changes {
                li class=(class(change.kind)) {
                    @if is_here(change) { a href={ "#" (change.check) } { (words(change)) } } @else { (words(change)) }
                }
            }
        }
    }
}

fn details(outcome: &CheckOutcome) -> Result<Markup> {
    let quantities = drawn(outcome);
    let pictures = quantities.iter().map(|quantity| plot::svg(outcome, quantity)).collect::<Result<Vec<_>>>()?;
    Ok(html! {
        details id=(outcome.check) open[outcome.verdict.is_bad()] {
            summary { (verdict(outcome)) b { (outcome.check) } " " (with_code(&words(outcome))) }
            @if let Some(check) = checks::find(&outcome.check) {
                p { (with_code(check.question)) }
                p { i { (with_code(check.derivation)) } " Source: " (with_code(check.source)) }
            }
            @if !outcome.trends.is_empty() { ul { @for trend in &outcome.trends { li { (trend) } } } }
            @for picture in pictures.iter().flatten() { (PreEscaped(picture)) }
            @if outcome.steps.iter().any(|step| !step.measurements.is_empty()) {
                (scrolled(&format!("Every value of {}", outcome.check), &values(outcome)))
            }
        }
    })
}

/// The quantities worth a picture: each that deviates somewhere, in the order in which they were measured.
fn drawn(outcome: &CheckOutcome) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for one in outcome.steps.iter().flat_map(|step| &step.measurements) {
        if one.ideal.miss(one.value) > 0.0 && !names.contains(&one.quantity) {
            names.push(one.quantity.clone());
        }
    }
    names
}

fn values(outcome: &CheckOutcome) -> Markup {
    let rows = outcome.steps.iter().flat_map(|step| step.measurements.iter().map(move |one| (step, one)));
    html! {
        table {
            thead { tr {
                th { "h [s]" } th { "quantity" } th { "value" } th { "verdict" } th { "spread" } th { "Coulomb–Signorini" }
                th { "declared law" }
            } }
            tbody { @for (step, one) in rows { (row(step, one)) } }
        }
    }
}

fn row(step: &StepOutcome, one: &Measurement) -> Markup {
    let expected = |value: f64, tolerance: f64, why: &str| {
        html! { (significant(value)) " ± " (format!("{tolerance:.1e}")) br; small { (with_code(why)) } }
    };
    html! {
        tr {
            td.n { (step.time_step.map_or("–".into(), significant)) }
            td { (one.quantity) }
            td.n { (significant(one.value)) " " (if one.unit == "1" { "" } else { &one.unit }) }
            td class=(one.verdict().word()) { (one.verdict().word()) }
            td.n { (if one.spread > 0.0 { format!("{:.1e}", one.spread) } else { "–".into() }) }
            td { (expected(one.ideal.value, one.ideal.tolerance, &one.ideal.why)) }
            td { @if let Some(model) = &one.model { (expected(model.value, model.tolerance, &model.why)) } @else { "–" } }
        }
    }
}
