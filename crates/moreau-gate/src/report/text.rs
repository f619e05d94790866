//! The gate's report as a table for a terminal.

use crate::baseline::{Change, ChangeKind};
use crate::conformance::ProbeOutcome;
use crate::report::{counts, decisive, sentence};
use crate::{CheckOutcome, Report, Verdict};
use moreau_checks::text::{Style, counted};
use moreau_exact::number::significant;

/// One block per check: verdict, name, and what decided it.
pub fn table(report: &Report, style: Style) -> String {
    let engine = &report.engine;
    let steps: Vec<String> = report.sweep.iter().map(|h| significant(*h)).collect();
    let law = engine.contact_model.law.as_deref().unwrap_or("no law");
    let kind = format!("{:?}", engine.contact_model.kind).to_lowercase();
    let head = format!("{} {}, declares {kind} contact, {law}; h = {} s", engine.name, engine.version, steps.join(", "));
    let mut text = style.wrapped("", "  ", &head) + "\n\n" + &adapter(report, style);
    for check in &report.checks {
        text += &line(check, style);
        text.extend(report.explaining(check).map(|probe| below(&format!("see the adapter's {} above", probe.probe), style)));
    }
    if report.checks.iter().any(|check| check.verdict.is_bad()) {
        text += &(style.wrapped("\n", "", "`moreau gate --explain CHECK` explains a check: question, derivation, control.") + "\n");
    }
    let counts = format!("{}: {}", counted(report.checks.len(), "check"), counts(report));
    text + "\n" + &style.wrapped("", "", &counts) + "\n"
}

/// A line under that of a check.
fn below(line: &str, style: Style) -> String {
    style.wrapped("            ", "              ", line) + "\n"
}

/// What is wrong with the adapter, before any check.
fn adapter(report: &Report, style: Style) -> String {
    let told = report.adapter.iter().filter_map(|probe| match &probe.outcome {
        ProbeOutcome::Problem { why, cure } => {
            let lines =
                [("  ", format!("{}: {}", probe.probe, probe.demand)), ("    ", format!("seen: {why}")), ("    ", format!("cure: {cure}"))];
            Some(lines.map(|(indent, line)| style.wrapped(indent, "      ", &line) + "\n").concat())
        }
        _ => None,
    });
    let told: String = told.collect();
    if told.is_empty() { told } else { format!("The adapter, by the probes of `moreau protocol-check`:\n{told}\n") }
}

fn line(check: &CheckOutcome, style: Style) -> String {
    let word = format!("{:<12}", check.verdict.word());
    let word = match check.verdict {
        Verdict::Pass => style.yes(&word),
        Verdict::Difference => style.reserved(&word),
        Verdict::Unsupported => style.faint(&word),
        Verdict::Errored | Verdict::Fail => style.no(&word),
    };
    let mut text = format!("{word}{}\n", check.check);
    if let Some(reason) = &check.reason {
        text += &below(reason, style);
    } else if let Some((step, one)) = decisive(check) {
        text += &below(&sentence(step, one), style);
    }
    if !check.fails_at.is_empty() {
        let at: Vec<String> = check.fails_at.iter().map(|h| significant(*h)).collect();
        text += &below(&format!("{} at h = {} s", check.verdict.word(), at.join(", ")), style);
    }
    text.extend(check.trends.iter().map(|trend| below(&trend.to_string(), style)));
    text
}

/// The changes against a baseline, regressions first.
pub fn changes(changes: &[Change], style: Style) -> String {
    let mut text = String::new();
    for (kind, title) in [
        (ChangeKind::Regression, "Regressions"),
        (ChangeKind::Known, "Known issues"),
        (ChangeKind::Improvement, "Improvements (save a new baseline to keep them)"),
    ] {
        let of_kind: Vec<&Change> = changes.iter().filter(|change| change.kind == kind).collect();
        if !of_kind.is_empty() {
            text += &format!("\n{title}:\n");
            text.extend(of_kind.iter().map(|change| style.wrapped("  ", "    ", &format!("{}: {}", change.check, change.what)) + "\n"));
        }
    }
    if text.is_empty() { "\nAs the baseline.\n".into() } else { text }
}
