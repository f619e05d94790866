//! `moreau scoreboard`: every installed engine through the same checks, stored and rendered.

use super::output::{print, print_aside, style};
use super::outputs::{self, HTML};
use super::several::make_folder;
use super::{Answer, Format, number, section};
use crate::board;
use crate::files::write_together;
use crate::gate::cause::{self, Cause};
use crate::gate::process::end_engines_on_interrupt;
use crate::gate::runner::{QUICK, SWEEP};
use crate::gate::scoreboard::{Engines, Entry, Standing};
use crate::gate::{Check, checks};
use crate::report::gate::{scoreboard, scoreboard_page, terminal};
use crate::report::json::pretty;
use crate::{Error, Result};
use indicatif::{ProgressBar, ProgressStyle};
use jiff::Zoned;
use std::path::{Path, PathBuf};

/// The list of engines and the stored results of a checkout.
const ENGINES: &str = "scripts/engines/engines.json";
const RESULTS: &str = "references/scoreboard";

/// The section of a Markdown file that is replaced.
const MARKERS: [&str; 2] = [scoreboard::BEGIN, scoreboard::END];

/// Run every engine that is installed here through the checks, and render the table engine × check.
///
/// The engines are those of `scripts/engines/engines.json`; `python3 scripts/install_engines.py` installs them. What is
/// found is stored with the engines' versions in `references/scoreboard/`. An engine that cannot be run here keeps
/// the result that is stored; without one it is listed as not run, with the reason, never as passed. Why a check is not
/// passed, where that was found out, stands in the folder's `causes/*.toml` and is shown with the table.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The list of engines [default: scripts/engines/engines.json, the one of a checkout].
    #[arg(long, value_name = "FILE")]
    engines: Option<PathBuf>,
    /// Run only engines whose name contains one of these, or show only them of what is stored.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Run only the checks whose name contains one of these; every other check keeps what is stored of it.
    #[arg(long, value_name = "NAME", value_delimiter = ',', conflicts_with = "stored")]
    checks: Vec<String>,
    /// The whole sweep of time steps instead of 1/60, 1/240 and 0.001 s.
    #[arg(long)]
    full: bool,
    /// Run nothing: render what is stored; outside of a checkout that is what this program holds.
    #[arg(long)]
    stored: bool,
    /// Where the results are stored [default: references/scoreboard, that of a checkout].
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Engines of one kind that run at once.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", default_value_t = 1, allow_negative_numbers = true)]
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

const EXAMPLES: &str = "\
Examples:
  moreau scoreboard --stored                      the stored results; works anywhere
  moreau scoreboard --stored --only mujoco        some engines
  moreau scoreboard --stored --html board.html    with every number
  moreau scoreboard --only mujoco                 run them, in a checkout

Exit codes: 0 the table is shown; 2 usage; 130 interrupted, by Ctrl-C, SIGTERM or SIGHUP, after its engines were ended.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    end_engines_on_interrupt()?;
    outputs::require("--html", arguments.html.as_deref(), HTML)?;
    let checks = chosen(arguments)?;
    let (mut standings, causes) = if arguments.is_elsewhere() { arguments.embedded()? } else { arguments.judged(&checks)? };
    for misfit in cause::misfits(&causes, &standings) {
        print_aside(&format!("{misfit}\n"));
    }
    standings.retain(|standing| !arguments.stored || arguments.selects(&standing.entry.name));
    show(arguments, &standings, &causes)?;
    Ok(Answer::Yes)
}

impl Arguments {
    /// Whether neither list nor folder is given, and there is none of a checkout: then the results that the program holds are shown.
    fn is_elsewhere(&self) -> bool {
        self.stored && self.engines.is_none() && self.folder.is_none() && !Path::new(ENGINES).is_file()
    }

    fn embedded(&self) -> Result<(Vec<Standing>, Vec<Cause>)> {
        let (standings, causes) = board::stored()?;
        self.require(standings.iter().map(|standing| standing.entry.name.as_str()))?;
        Ok((standings, causes))
    }

    fn selects(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|part| name.contains(part.as_str()))
    }

    /// Refuses, before an engine runs, a selection of none and a file without the markers.
    fn require<'a>(&self, names: impl Iterator<Item = &'a str> + Clone) -> Result<()> {
        if !names.clone().any(|name| self.selects(name)) {
            let cure = format!("name one of {}", names.collect::<Vec<_>>().join(", "));
            return Err(Error::invalid("--only", "selects no engine", cure));
        }
        self.readme.as_ref().map_or(Ok(()), |file| section::replaced(file, MARKERS, "").map(|_| ()))
    }

    /// The list of engines; without a checkout the cure is another one.
    fn engines(&self) -> Result<Vec<Entry>> {
        let file = self.engines.as_deref().unwrap_or(Path::new(ENGINES));
        if self.engines.is_none() && !file.is_file() {
            let cure =
                "run it in a checkout of moreau, or give a list; `moreau scoreboard --stored` shows the results that this program holds";
            return Err(Error::invalid("--engines", format!("is not given, and there is no {ENGINES} here"), cure));
        }
        Ok(Engines::read(file)?.engines)
    }

    /// What is stored and what is found now.
    fn judged(&self, checks: &[&'static Check]) -> Result<(Vec<Standing>, Vec<Cause>)> {
        let engines = self.engines()?;
        self.require(engines.iter().map(|entry| entry.name.as_str()))?;
        let folder = self.folder.as_deref().unwrap_or(Path::new(RESULTS));
        make_folder("--folder", folder)?;
        let causes = cause::read(&folder.join("causes"))?;
        let mut standings = Vec::new();
        for entry in engines {
            let stored = Some(Standing::file(folder, &entry.name)).filter(|file| file.is_file());
            let stored = stored.map(|file| Standing::read(&file)).transpose()?;
            standings.push(self.standing(entry, stored, folder, checks)?);
        }
        Ok((standings, causes))
    }

    /// What stands of one engine, run now if it is selected.
    fn standing(&self, entry: Entry, stored: Option<Standing>, folder: &Path, checks: &[&'static Check]) -> Result<Standing> {
        if self.stored || !self.selects(&entry.name) {
            return Ok(stored.unwrap_or(Standing { entry, report: None, not_run: Some("never".into()) }));
        }
        let standing = judge(self, checks, &entry);
        match (&standing.report, stored) {
            (None, Some(stored)) => {
                print_aside(&format!("{}: not run: {}; the stored result stays\n", entry.name, standing.not_run.as_deref().unwrap_or("")));
                Ok(stored)
            }
            (_, stored) => {
                let standing = if self.checks.is_empty() { standing } else { standing.beside(stored) };
                standing.store(folder)?;
                Ok(standing)
            }
        }
    }
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

fn judge(arguments: &Arguments, checks: &[&'static Check], entry: &Entry) -> Standing {
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
        Format::Text => terminal::table(standings, causes, style()),
        Format::Json => pretty(&Scoreboard { engines: standings, causes })?,
    })
}

/// What `--format json` prints.
#[derive(serde::Serialize)]
struct Scoreboard<'a> {
    engines: &'a [Standing],
    causes: &'a [Cause],
}
