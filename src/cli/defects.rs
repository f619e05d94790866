//! `moreau defects`: the planted mistakes and the checks that catch them.

use super::output::print;
use super::{Answer, Format};
use crate::Result;
use crate::gate::checks;
use crate::gate::matrix::{Row, matrix, size};
use crate::report::json::pretty;
use indicatif::{ProgressBar, ProgressStyle};

/// Run every check on every planted mistake, and print which check catches which.
///
/// A planted mistake is a reference – a scheme, a solver, a formula – with one realistic error. A check that catches
/// none of them would show nothing, and a mistake that no check catches would go unnoticed: both are answered with
/// exit code 1. It runs the quick sweep of time steps and takes a few minutes.
#[derive(clap::Args)]
pub struct Arguments {
    /// How to write the matrix: as text, or as {"defects": [{name, mistake, caught_by: [check]}]}.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let checks: Vec<_> = checks::all().collect();
    let bar = ProgressBar::new(size() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} planted mistakes  {elapsed}") {
        bar.set_style(style);
    }
    let rows = matrix(&checks, &|| bar.inc(1))?;
    bar.finish_and_clear();
    let idle: Vec<&str> = checks.iter().map(|check| check.name).filter(|name| !rows.iter().any(|row| row.catches(name))).collect();
    print(&match arguments.format {
        Format::Text => text(&rows, &idle),
        Format::Json => pretty(&serde_json::json!({"defects": rows, "checks_that_catch_nothing": idle}))?,
    })?;
    Ok((idle.is_empty() && rows.iter().all(|row| !row.caught_by.is_empty())).into())
}

impl Row {
    fn catches(&self, check: &str) -> bool {
        self.caught_by.iter().any(|name| name == check)
    }
}

fn text(rows: &[Row], idle: &[&str]) -> String {
    let mut text = String::new();
    for row in rows {
        let caught = if row.caught_by.is_empty() { "NOBODY".into() } else { row.caught_by.join(", ") };
        text += &format!("{}\n    {}\n    caught by {caught}\n", row.name, row.mistake);
    }
    let missed = rows.iter().filter(|row| row.caught_by.is_empty()).count();
    text += &format!("\n{} planted mistakes, {missed} that no check catches\n", rows.len());
    if !idle.is_empty() {
        text += &format!("checks that catch nothing: {}\n", idle.join(", "));
    }
    text
}
