//! `moreau report`: everything that was checked, as a static site that opens from a folder.

use super::folder::Target;
use super::output::{print, print_aside};
use super::verify::judge;
use super::{Answer, progress};
use crate::claims::{self, CHAPTER, Claim, JudgedClaim};
use crate::matrix::{Source, rows, sources};
use crate::report::json::compact;
use crate::report::site::document::{FILE, ReportDocument};
use crate::report::site::{Gathered, defects};
use crate::stored::RUNS;
use crate::{Result, board, problems, systems};
use indicatif::ProgressBar;
use jiff::Zoned;
use moreau_site::pages::{self, File};
use rayon::prelude::*;
use std::path::PathBuf;

/// Write everything that was checked as a site that opens from its folder, without network and without a server.
///
/// Runs every claim, measures every system, puts the planted mistakes to their checks, and writes pages in English and
/// Chinese: the claims by section with a search, an errata sheet for the chapter's author, pictures, systems, the stored
/// scoreboard of engines, the collection of contact problems, a summary of two printed pages, and how each number was
/// obtained. The page to begin with is index.html; report.json has the same for programs.
#[derive(clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\nThe chapter is {CHAPTER}."))]
pub struct Arguments {
    /// The folder: a new one, an empty one, or a report, which is replaced.
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  moreau report --out report       then open report/index.html, or report/zh/index.html in Chinese
  moreau schema report             the fields of report/report.json

The report is written whole or not at all. A folder with other files is refused, and so is a mount point. A report that a
stopped run had set aside is put back. Exit code 0 means that every verdict
is supported by what was found, every system within its bound and every planted mistake caught; 1 that something is
not, which the front page says first.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let remark = |text: &str| print_aside(&format!("remark: {text}\n"));
    let target = Target::new(&arguments.out, remark)?;
    let claims: Vec<&'static Claim> = claims::all().collect();
    let planted = &sources(&[])[1..]; // all but the engines, which take minutes
    let trials: usize = planted.iter().map(|source| source.trials.len()).sum();
    let parts = claims.len() + systems::Report::size() + trials + pages::parts();
    let bar = progress::parts(parts, "parts of the report");
    let (gathered, files) = progress::shown(&bar, || written(&claims, planted, &bar))?;
    target.write(&files, remark)?;
    print(&told(&gathered, arguments))?;
    Ok(gathered.holds().into())
}

/// What was found, and the files that show it.
fn written(claims: &[&'static Claim], planted: &[Source], bar: &ProgressBar) -> Result<(Gathered, Vec<File>)> {
    let done = || bar.inc(1);
    let outcomes: Vec<JudgedClaim> = claims.par_iter().map(|claim| judge(claim, claims::judge)).inspect(|_| done()).collect();
    let (standings, causes) = board::stored()?;
    let gathered = Gathered {
        day: Zoned::now().date().to_string(),
        outcomes,
        systems: systems::Report::measure(&RUNS, done)?,
        standings,
        causes,
        defects: defects(rows(planted, &done)?),
        problems: problems::ALL.iter().map(|stored| stored.record()).collect::<Result<_>>()?,
        work: problems::work::tables()?,
    };
    let mut files = pages::site(&gathered.report(), &done)?;
    let names: Vec<String> = files.iter().map(|file| file.path.clone()).collect();
    let text = compact(&ReportDocument::new(&gathered, &names))?;
    files.push(File { path: FILE.into(), text });
    Ok((gathered, files))
}

/// What the command says.
fn told(gathered: &Gathered, arguments: &Arguments) -> String {
    let contradicted = gathered.contradicted();
    let which = if contradicted.is_empty() { String::new() } else { format!(": {}", contradicted.join(", ")) };
    let page = arguments.out.join("index.html");
    format!("{} claims, {} contradicted{which}\nopen {}\n", gathered.outcomes.len(), contradicted.len(), page.display())
}
