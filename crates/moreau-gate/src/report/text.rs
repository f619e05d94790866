//! The gate's report as a table for a terminal.

use crate::baseline::{Change, ChangeKind};
use crate::conformance::ProbeOutcome;
use crate::report::{counts, decisive, sentence};
use crate::{CheckOutcome, Report, Verdict};
use moreau_checks::text::Style;
use moreau_exact::number::significant;

/// One block per check: verdict, name, and what decided it.
pub fn table(report: &Report, style: Style) -> String {
    let engine = &report.engine;
    let steps: Vec<String> = report.sweep.iter().map(|h| significant(*h)).collect();
    let law = engine.contact_model.law.as_deref().unwrap_or("no law");
    let mut text = format!(
        "{} {}, declares {:?} contact, {law}; h = {} s\n\n",
        engine.name,
        engine.version,
        engine.contact_model.kind,
        steps.join(", ")
    );
    text += &adapter(report);
    for check in &report.checks {
        text += &line(check, style);
        text.extend(report.explaining(check).map(|probe| format!("            see the adapter's {} above\n", probe.probe)));
    }
    text + &format!("\n{} checks: {}\n", report.checks.len(), counts(report))
}

/// What is wrong with the adapter, before any check.
fn adapter(report: &Report) -> String {
    let told = report.adapter.iter().filter_map(|probe| match &probe.outcome {
        ProbeOutcome::Problem { why, cure } => Some(format!("  {}: {}\n    seen: {why}\n    cure: {cure}\n", probe.probe, probe.demand)),
        _ => None,
    });
    let told: String = told.collect();
    if told.is_empty() { told } else { format!("The adapter, by the probes of `moreau protocol-check`:\n{told}\n") }
}

fn line(check: &CheckOutcome, style: Style) -> String {
    let word = format!("{:<12}", check.verdict.word());
    let colour = match check.verdict {
        Verdict::Pass => "32",
        Verdict::Difference => "33",
        Verdict::Unsupported => "2",
        Verdict::Errored | Verdict::Fail => "31",
    };
    let word = if style.colour { format!("\x1b[{colour}m{word}\x1b[0m") } else { word };
    let mut text = format!("{word}{}\n", check.check);
    if let Some(reason) = &check.reason {
        text += &format!("            {reason}\n");
    } else if let Some((step, one)) = decisive(check) {
        text += &format!("            {}\n", sentence(step, one));
    }
    if !check.fails_at.is_empty() {
        let at: Vec<String> = check.fails_at.iter().map(|h| significant(*h)).collect();
        text += &format!("            {} at h = {} s\n", check.verdict.word(), at.join(", "));
    }
    for trend in &check.trends {
        text += &format!("            {trend}\n");
    }
    text
}

/// The changes against a baseline, regressions first.
pub fn changes(changes: &[Change]) -> String {
    let mut text = String::new();
    for (kind, title) in [
        (ChangeKind::Regression, "Regressions"),
        (ChangeKind::Known, "Known issues"),
        (ChangeKind::Improvement, "Improvements (save a new baseline to keep them)"),
    ] {
        let of_kind: Vec<&Change> = changes.iter().filter(|change| change.kind == kind).collect();
        if !of_kind.is_empty() {
            text += &format!("\n{title}:\n");
            text.extend(of_kind.iter().map(|change| format!("  {}: {}\n", change.check, change.what)));
        }
    }
    if text.is_empty() { "\nAs the baseline.\n".into() } else { text }
}
