//! `moreau systems`: every simulator of the chapter on the four axes, with its agreement measured now.

use super::output::{print, style};
use super::{Answer, Format, section};
use crate::Result;
use crate::files::write_together;
use crate::report::json::pretty;
use crate::report::systems;
use crate::stored::RUNS;
use crate::systems::Report;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;

/// Show where every simulator stands on the four axes, what it was compared with, and how closely it agrees.
///
/// The axes are the level of the constraint (position, velocity, acceleration), the cone of impulses, the contact law and the
/// algorithm. Every agreement is measured when the command runs, from closed forms and stored references; the answer is
/// no (exit code 1) if one is outside the tolerance derived for it.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Replace the section between `<!-- systems -->` and `<!-- /systems -->` of this file; docs/systems.md is where the table stands.
    #[arg(long, value_name = "FILE")]
    readme: Option<PathBuf>,
    /// How to write the table to standard output.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau systems
  moreau systems --format json
  moreau systems --readme docs/systems.md";

const MARKERS: [&str; 2] = [systems::BEGIN, systems::END];

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let Some(file) = &arguments.readme {
        section::replaced(file, MARKERS, "")?; // a file without the markers is refused before anything is measured
    }
    let bar = ProgressBar::new(Report::size() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} agreements  {elapsed}") {
        bar.set_style(style);
    }
    let report = Report::measure(&RUNS, || bar.inc(1))?;
    bar.finish_and_clear();
    if let Some(file) = &arguments.readme {
        let text = section::replaced(file, MARKERS, &systems::markdown(&report))?;
        write_together(&[(file.as_path(), text.as_bytes())])?;
    }
    print(&match arguments.format {
        Format::Text => systems::text(&report, style()),
        Format::Json => pretty(&report)?,
    })?;
    Ok(report.holds().into())
}
