//! What `moreau protocol-check` prints: one line per probe, and under a problem what was seen and its cure.

use crate::conformance::{Conformance, Probe, ProbeOutcome};
use moreau_checks::text::{Style, counted};

/// The outcomes, and their count as the last line.
pub fn text(conformance: &Conformance, style: Style) -> String {
    let mut text = match &conformance.engine {
        Some(engine) => format!("{} {}\n\n", engine.name, engine.version),
        None => String::new(),
    };
    let width = conformance.probes.iter().map(|probe| probe.probe.len()).max().unwrap_or(0);
    for probe in &conformance.probes {
        text += &line(probe, width, style);
    }
    let count = |word: &str| conformance.probes.iter().filter(|probe| self::word(&probe.outcome) == word).count();
    let [probes, problems] = [(conformance.probes.len(), "probe"), (count("problem"), "problem")].map(|(count, word)| counted(count, word));
    text + &format!("\n{probes}: {} ok, {problems}, {} skipped\n", count("ok"), count("skipped"))
}

fn word(outcome: &ProbeOutcome) -> &'static str {
    match outcome {
        ProbeOutcome::Ok => "ok",
        ProbeOutcome::Problem { .. } => "problem",
        ProbeOutcome::Skipped { .. } => "skipped",
    }
}

fn line(probe: &Probe, width: usize, style: Style) -> String {
    let word = format!("{:8}", word(&probe.outcome));
    let below = |text: String| style.wrapped("          ", "            ", &text) + "\n";
    let (word, below) = match &probe.outcome {
        ProbeOutcome::Ok => (style.yes(&word), String::new()),
        ProbeOutcome::Problem { why, cure } => (style.alarm(&word), below(format!("seen: {why}")) + &below(format!("cure: {cure}"))),
        ProbeOutcome::Skipped { why } => (style.faint(&word), below(why.clone())),
    };
    let line = format!("{word}  {:width$}  {}", probe.probe, probe.demand);
    style.wrapped("", "            ", &line) + "\n" + &below
}
