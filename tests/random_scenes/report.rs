//! The table of scheme × (scenes, steps, rejected, worst ratios), and what failed.

use crate::motion::Outcome;
use std::collections::BTreeMap;
use std::fmt;

/// Sums of one scheme.
#[derive(Clone, Debug, Default)]
struct Line {
    scenes: usize,
    refused: usize,
    ended: BTreeMap<String, usize>,
    steps: usize,
    rejected: usize,
    ratio: f64,
    work: f64,
    failed: Vec<(u64, String)>,
}

/// All runs.
#[derive(Clone, Debug, Default)]
pub struct Report(BTreeMap<&'static str, Line>);

impl Report {
    /// Adds a run.
    pub fn add(&mut self, scheme: &'static str, seed: u64, outcome: &Outcome) {
        let line = self.0.entry(scheme).or_default();
        line.refused += usize::from(outcome.refused);
        line.scenes += usize::from(!outcome.refused);
        line.steps += outcome.steps;
        line.rejected += outcome.rejected;
        line.ratio = line.ratio.max(outcome.ratio);
        line.work = line.work.max(outcome.work);
        if let Some(reason) = &outcome.ended {
            let cause: String = reason.chars().take(90).collect();
            *line.ended.entry(cause).or_default() += 1;
        }
        line.failed.extend(outcome.failure.clone().map(|failure| (seed, failure)));
    }

    /// Whether nothing was run.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Scheme, seed and reason of everything that must not be.
    pub fn failures(&self) -> Vec<String> {
        let of = |(name, line): (&&'static str, &Line)| {
            line.failed.iter().map(|(seed, reason)| format!("{name}, seed {seed}: {reason}")).collect::<Vec<_>>()
        };
        self.0.iter().flat_map(of).collect()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:24} {:>6} {:>7} {:>6} {:>7} {:>8} {:>9} {:>9} {:>6}",
            "scheme", "scenes", "refused", "ended", "steps", "rejected", "ratio", "work", "failed"
        )?;
        for (name, line) in &self.0 {
            let ended: usize = line.ended.values().sum();
            writeln!(
                f,
                "{name:24} {:>6} {:>7} {ended:>6} {:>7} {:>8} {:>9.1e} {:>9.1e} {:>6}",
                line.scenes,
                line.refused,
                line.steps,
                line.rejected,
                line.ratio,
                line.work,
                line.failed.len()
            )?;
        }
        for (name, line) in &self.0 {
            for (cause, count) in &line.ended {
                writeln!(f, "{name} ended {count} times: {cause}")?;
            }
        }
        for failure in self.failures() {
            writeln!(f, "FAILED {failure}")?;
        }
        Ok(())
    }
}
