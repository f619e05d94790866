//! What `moreau protocol-check` prints: one line per probe, and under a problem what was seen and its cure.

use crate::conformance::{Conformance, Probe, ProbeOutcome};
use moreau_checks::text::Style;

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
    text + &format!(
        "\n{} probes: {} ok, {} problems, {} skipped\n",
        conformance.probes.len(),
        count("ok"),
        count("problem"),
        count("skipped")
    )
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
    let (colour, below) = match &probe.outcome {
        ProbeOutcome::Ok => ("32", String::new()),
        ProbeOutcome::Problem { why, cure } => ("1;31", format!("          seen: {why}\n          cure: {cure}\n")),
        ProbeOutcome::Skipped { why } => ("2", format!("          {why}\n")),
    };
    let word = if style.colour { format!("\u{1b}[{colour}m{word}\u{1b}[0m") } else { word };
    format!("{word}  {:width$}  {}\n{below}", probe.probe, probe.demand)
}
