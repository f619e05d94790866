//! The gate's report as one self-contained HTML page: no scripts, no other files.

use crate::baseline::{Change, ChangeKind};
use crate::conformance::ProbeOutcome;
use crate::report::{counts, decisive, plot, sentence};
use crate::{CheckOutcome, Measurement, Report, StepOutcome, checks};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use moreau_exact::Result;
use moreau_exact::number::significant;

pub(super) const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}\
h1{font-size:1.5rem}table{border-collapse:collapse;width:100%;margin:.6rem 0}td,th{border-bottom:1px solid #ddd;padding:.25rem .5rem;\
text-align:left;vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\
.pass{background:#dff3e4}.difference{background:#fff3cf}.fail,.errored,.regression{background:#ffd9d4}.unsupported{background:#eee}\
details{margin:.4rem 0;border:1px solid #ddd;border-radius:4px;padding:.3rem .6rem}summary{cursor:pointer}\
code{overflow-wrap:anywhere}\
span.verdict{display:inline-block;min-width:6.5rem;padding:0 .4rem;border-radius:3px;margin-right:.5rem}";

/// The page of a run, with the changes against a baseline if there is one.
///
/// # Errors
/// If a picture cannot be drawn.
pub fn html(report: &Report, changes: Option<&[Change]>) -> Result<String> {
    let title = format!("moreau gate: {} {}", report.engine.name, report.engine.version);
    let mut outcomes: Vec<&CheckOutcome> = report.checks.iter().collect();
    outcomes.sort_by_key(|outcome| std::cmp::Reverse(outcome.verdict.is_bad()));
    let details = outcomes.into_iter().map(details).collect::<Result<Vec<_>>>()?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (title) }
                p { b { (report.checks.len()) " checks: " (counts(report)) } }
                (engine(report))
                (adapter(report))
                p { "In the pictures: " b style="color:#0072b2" { "measured" } ", " b style="color:#999" { "allowed to a sound \
                    discretisation" } ", "
                    b style="color:#d55e00" { "the declared law's own deviation" } "." }
                @if let Some(changes) = changes { (comparison(changes)) }
                @for part in details { (part) }
            }
        }
    };
    Ok(page.into_string())
}

fn engine(report: &Report) -> Markup {
    let model = &report.engine.contact_model;
    let steps: Vec<String> = report.sweep.iter().map(|h| significant(*h)).collect();
    html! {
        table {
            tr { th { "declared contact" } td { (format!("{:?}", model.kind).to_lowercase()) ", " (model.law.as_deref().unwrap_or("no \
                documented law")) } }
            tr { th { "parameters" } td {
                @for (name, parameter) in &model.parameters { code { (name) " = " (serde_json::json!(parameter.value)) " \
                    " (serde_json::json!(parameter.unit)) } " " }
            } }
            tr { th { "options" } td { code { (serde_json::Value::Object(report.engine.options.clone())) } } }
            tr { th { "time steps [s]" } td { (steps.join(", ")) } }
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
                        li class="fail" { b { (probe.probe) } " " (probe.demand) ". Seen: " (why) ". Cure: " (cure) "." }
                    }
                }
            }
        }
    }
}

fn comparison(changes: &[Change]) -> Markup {
    let class = |kind| if kind == ChangeKind::Regression { "regression" } else { "" };
    html! {
        h2 { "Against the baseline" }
        @if changes.is_empty() { p { "As the baseline." } }
        ul { @for change in changes { li class=(class(change.kind)) { b { (format!("{:?}", change.kind)) } " " (change.check) ": \
            " (change.what) } } }
    }
}

fn details(outcome: &CheckOutcome) -> Result<Markup> {
    let word = outcome.verdict.word();
    let summary = outcome.reason.clone().or_else(|| decisive(outcome).map(|(step, one)| sentence(step, one))).unwrap_or_default();
    let quantities = drawn(outcome);
    let pictures = quantities.iter().map(|quantity| plot::svg(outcome, quantity)).collect::<Result<Vec<_>>>()?;
    Ok(html! {
        details id=(outcome.check) open[outcome.verdict.is_bad()] {
            summary { span class={ "verdict " (word) } { (word) } b { (outcome.check) } " " (summary) }
            @if let Some(check) = checks::find(&outcome.check) {
                p { (check.question) }
                p { i { (check.derivation) } " Source: " (check.source) }
            }
            @for trend in &outcome.trends { p { (trend) } }
            @for picture in pictures.iter().flatten() { (PreEscaped(picture)) }
            (values(outcome))
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
            tr { th { "h [s]" } th { "quantity" } th { "value" } th { "spread" } th { "Coulomb–Signorini" } th { "declared \
                law" } th { "verdict" } }
            @for (step, one) in rows { (row(step, one)) }
        }
    }
}

fn row(step: &StepOutcome, one: &Measurement) -> Markup {
    let expected =
        |value: f64, tolerance: f64, why: &str| html! { (significant(value)) " ± " (format!("{tolerance:.1e}")) br; small { (why) } };
    html! {
        tr {
            td.n { (step.time_step.map_or("–".into(), significant)) }
            td { (one.quantity) }
            td.n { (significant(one.value)) " " (if one.unit == "1" { "" } else { &one.unit }) }
            td.n { (if one.spread > 0.0 { format!("{:.1e}", one.spread) } else { "–".into() }) }
            td { (expected(one.ideal.value, one.ideal.tolerance, &one.ideal.why)) }
            td { @if let Some(model) = &one.model { (expected(model.value, model.tolerance, &model.why)) } @else { "–" } }
            td class=(one.verdict().word()) { (one.verdict().word()) }
        }
    }
}
