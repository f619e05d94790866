//! `moreau scoreboard`: every installed engine through the same checks, stored and rendered.

use super::output::{print, print_aside};
use super::{Answer, Format, section};
use crate::files::write_together;
use crate::gate::cause::{self, Cause};
use crate::gate::process::end_engines_on_interrupt;
use crate::gate::runner::{QUICK, SWEEP};
use crate::gate::scoreboard::{Engines, Standing};
use crate::gate::{Check, checks};
use crate::report::gate::{scoreboard, scoreboard_page};
use crate::report::json::pretty;
use crate::{Error, Result};
use indicatif::{ProgressBar, ProgressStyle};
use jiff::Zoned;
use std::path::{Path, PathBuf};

/// The section of a Markdown file that is replaced.
const MARKERS: [&str; 2] = [scoreboard::BEGIN, scoreboard::END];

/// Run every engine that is installed here through the checks, and render the table engine × check.
///
/// The engines are those of `scripts/engines/engines.json`; `python3 scripts/install_engines.py` installs them. What is
/// found is stored with the engines' versions in `references/scoreboard/`. An engine that cannot be run here keeps
/// the result that is stored; without one it is listed as not run, with the reason, never as passed. Why a check is not
/// passed, where that was found out, stands in the folder's `causes/*.toml` and is shown with the table.
#[derive(clap::Args)]
pub struct Arguments {
    /// The list of engines.
    #[arg(long, value_name = "FILE", default_value = "scripts/engines/engines.json")]
    engines: PathBuf,
    /// Only engines whose name contains one of these.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Run only the checks whose name contains one of these; every other check keeps what is stored of it.
    #[arg(long, value_name = "NAME", value_delimiter = ',', conflicts_with = "stored")]
    checks: Vec<String>,
    /// The whole sweep of time steps instead of 1/60, 1/240 and 0.001 s.
    #[arg(long)]
    full: bool,
    /// Run nothing: render what is stored.
    #[arg(long)]
    stored: bool,
    /// Where the results are stored.
    #[arg(long, value_name = "FOLDER", default_value = "references/scoreboard")]
    folder: PathBuf,
    /// Engines of one kind that run at once.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    jobs: usize,
    /// Write the table with every number as one self-contained HTML page: a mark leads to the number that decided it, and to the cause.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Replace the section between `<!-- scoreboard -->` and `<!-- /scoreboard -->` of this file; docs/scoreboard.md is where the table
    /// stands.
    #[arg(long, value_name = "FILE")]
    readme: Option<PathBuf>,
    /// How to write the table to standard output.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    end_engines_on_interrupt()?;
    let engines = Engines::read(&arguments.engines)?.engines;
    let selected = |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|part| name.contains(part.as_str()));
    if !engines.iter().any(|entry| selected(&entry.name)) {
        let names: Vec<&str> = engines.iter().map(|entry| entry.name.as_str()).collect();
        return Err(Error::invalid("--only", "selects no engine", format!("name one of {}", names.join(", "))));
    }
    let checks = chosen(arguments)?;
    if let Some(file) = &arguments.readme {
        section::replaced(file, MARKERS, "")?; // a file without the markers is refused before the engines run
    }
    std::fs::create_dir_all(&arguments.folder).map_err(|source| Error::Write { file: arguments.folder.clone(), source })?;
    let causes = cause::read(&arguments.folder.join("causes"))?;
    let mut standings = Vec::new();
    for entry in engines {
        let stored = Some(Standing::file(&arguments.folder, &entry.name)).filter(|file| file.is_file());
        let stored = stored.map(|file| Standing::read(&file)).transpose()?;
        if arguments.stored || !selected(&entry.name) {
            let absent = || Standing { entry: entry.clone(), report: None, not_run: Some("never".into()) };
            standings.push(stored.unwrap_or_else(absent));
            continue;
        }
        let standing = judge(arguments, &checks, &entry);
        match (&standing.report, stored) {
            (None, Some(stored)) => {
                print_aside(&format!("{}: not run: {}; the stored result stays\n", entry.name, standing.not_run.as_deref().unwrap_or("")));
                standings.push(stored);
            }
            (_, stored) => {
                let standing = if arguments.checks.is_empty() { standing } else { standing.beside(stored) };
                standing.store(&arguments.folder)?;
                standings.push(standing);
            }
        }
    }
    for misfit in cause::misfits(&causes, &standings) {
        print_aside(&format!("{misfit}\n"));
    }
    show(arguments, &standings, &causes)?;
    Ok(Answer::Yes)
}

/// The checks to run.
fn chosen(arguments: &Arguments) -> Result<Vec<&'static Check>> {
    let named = |check: &&Check| arguments.checks.is_empty() || arguments.checks.iter().any(|part| check.name.contains(part.as_str()));
    let checks: Vec<_> = checks::all().filter(named).collect();
    if checks.is_empty() {
        return Err(Error::invalid("--checks", "selects no check", "`moreau gate --list` shows every check"));
    }
    Ok(checks)
}

fn judge(arguments: &Arguments, checks: &[&'static Check], entry: &crate::gate::scoreboard::Entry) -> Standing {
    let sweep = if arguments.full { SWEEP.to_vec() } else { QUICK.to_vec() };
    let bar = ProgressBar::new((checks.len() * sweep.len()) as u64).with_message(entry.name.clone());
    if let Ok(style) = ProgressStyle::with_template("{msg:24} {bar:40} {elapsed}") {
        bar.set_style(style);
    }
    let standing = entry.judge(checks, &sweep, arguments.jobs, &|| bar.inc(1));
    bar.finish_and_clear();
    standing
}

fn show(arguments: &Arguments, standings: &[Standing], causes: &[Cause]) -> Result<()> {
    let text = scoreboard::section(standings, causes);
    let mut files: Vec<(&Path, String)> = Vec::new();
    if let Some(file) = &arguments.html {
        files.push((file, scoreboard_page::html(standings, causes, Zoned::now().date())));
    }
    if let Some(file) = &arguments.readme {
        files.push((file, section::replaced(file, MARKERS, &text)?));
    }
    let files: Vec<(&Path, &[u8])> = files.iter().map(|(file, text)| (*file, text.as_bytes())).collect();
    write_together(&files)?;
    print(&match arguments.format {
        Format::Text => text,
        Format::Json => pretty(&Scoreboard { engines: standings, causes })?,
    })
}

/// What `--format json` prints.
#[derive(serde::Serialize)]
struct Scoreboard<'a> {
    engines: &'a [Standing],
    causes: &'a [Cause],
}
