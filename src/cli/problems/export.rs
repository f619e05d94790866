//! `moreau problems export`: problems and answers as files.

use super::super::Answer;
use super::super::convert::fields_without_place;
use super::super::output::{print, print_aside};
use super::super::progress;
use super::super::several::make_folder;
use super::named::{named, not_stored};
use crate::files::write_together;
use crate::problem::Solution;
use crate::problems::{ALL, Stored, solution};
use crate::report::text::counted;
use crate::{Error, Result};
use clap::ValueEnum;
use indicatif::ProgressBar;
use nalgebra::DVector;
use std::path::{Path, PathBuf};

/// Write a problem and its answers into a folder, or all of them.
///
/// contact-problem/1 comes with one solution/1 per answer, NAME.solution.json, NAME.solution-2.json and so on. A file of FCLIB holds the
/// problem, the first answer as its solution, and no impulses as its guess; it has no place for other laws than Coulomb's, for a shift and
/// for a compliance. What cannot be written, and what is not kept – mass and Jacobian, keys, further answers –, is named on standard error.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub struct Arguments {
    /// The problem's name and the folder; with --all the folder alone.
    #[arg(num_args = 0..=2, value_names = ["NAME", "FOLDER"])]
    what: Vec<String>,
    /// All problems that are stored; those that are listed and too large to be stored are named on standard error.
    #[arg(long)]
    all: bool,
    /// The format.
    #[arg(long, value_enum, default_value_t)]
    to: To,
}

/// The formats that are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum To {
    /// contact-problem/1 and solution/1.
    #[default]
    ContactProblem,
    /// HDF5 of FCLIB.
    Fclib,
}

const USAGE: &str = "moreau problems export [--to FORMAT] NAME FOLDER\n       moreau problems export [--to FORMAT] --all FOLDER";

const EXAMPLES: &str = "\
Examples:
  moreau problems export box-rough .
  moreau problems export --all problems --to fclib

Exit code 0: written; 2: not stored, without a place in the format, or another file has its name.
With --all what has no place is passed over.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let (chosen, folder): (Vec<&Stored>, &str) = match (arguments.all, &arguments.what[..]) {
        (true, [folder]) => (ALL.iter().filter(|stored| stored.problem.is_some()).collect(), folder),
        (false, [name, folder]) => (vec![named(name)?], folder),
        (true, []) => return Err(Error::invalid("FOLDER", "is missing", "give the folder: moreau problems export --all FOLDER")),
        (true, _) => return Err(Error::invalid("NAME", "is given with --all", "give the folder alone")),
        (false, []) => return Err(Error::invalid("NAME", "is missing", "give a problem's name and a folder, or --all and a folder")),
        (false, _) => return Err(Error::invalid("FOLDER", "is missing", "give a problem's name and a folder, or --all and a folder")),
    };
    let folder = Path::new(folder);
    make_folder("FOLDER", folder)?;
    let bar = progress::parts(chosen.len(), "problems");
    let (problems, files) = progress::shown(&bar, || exported(&chosen, arguments, folder, &bar))?;
    let (problems, files) = (counted(problems, "problem"), counted(files, "file"));
    print(&format!("{problems} in {files} in {}\n", folder.display()))?;
    if arguments.all {
        print_aside(&not_stored(ALL.iter().filter(|stored| stored.problem.is_none()).map(|stored| stored.name)));
    }
    Ok(Answer::Yes)
}

/// Writes the files of these problems, all or none; how many problems and files that are.
fn exported(chosen: &[&Stored], arguments: &Arguments, folder: &Path, bar: &ProgressBar) -> Result<(usize, usize)> {
    let (mut files, mut problems) = (Vec::new(), 0);
    for stored in chosen {
        bar.set_message(format!(", {}", stored.name));
        match written(stored, arguments.to, folder, bar) {
            Ok(made) => {
                files.extend(made);
                problems += 1;
            }
            Err(error @ Error::Unsupported(_)) if arguments.all => {
                bar.suspend(|| print_aside(&format!("{}: not written: {error}\n", stored.name)));
            }
            Err(error) => return Err(error),
        }
        bar.inc(1);
    }
    keep_others(&files)?;
    let together: Vec<(&Path, &[u8])> = files.iter().map(|(file, bytes)| (file.as_path(), &bytes[..])).collect();
    write_together(&together)?;
    Ok((problems, files.len()))
}

/// Refuses to write over what is there, unless it is the same.
fn keep_others(files: &[(PathBuf, Vec<u8>)]) -> Result<()> {
    match files.iter().find(|(file, bytes)| file.exists() && !std::fs::read(file).is_ok_and(|there| there == *bytes)) {
        Some((file, _)) => {
            let problem = format!("has {}, which is not what would be written there", file.display());
            Err(Error::invalid("FOLDER", problem, "move that file away, or name another folder"))
        }
        None => Ok(()),
    }
}

/// The files of one problem.
fn written(stored: &Stored, to: To, folder: &Path, bar: &ProgressBar) -> Result<Vec<(PathBuf, Vec<u8>)>> {
    let (problem, record) = (stored.problem()?, stored.record()?);
    let answers: Vec<_> = record.answers.iter().map(|answer| solution(&problem, &record, answer)).collect();
    let text = stored.problem.unwrap_or_default();
    match to {
        To::ContactProblem => {
            let mut files = vec![(folder.join(format!("{}.json", stored.name)), text.as_bytes().to_vec())];
            for (number, answer) in answers.iter().enumerate() {
                let end = if number == 0 { String::new() } else { format!("-{}", number + 1) };
                let file = folder.join(format!("{}.solution{end}.json", stored.name));
                files.push((file, answer.to_json(Some(problem.name()), None).into_bytes()));
            }
            Ok(files)
        }
        To::Fclib => {
            let bytes = problem.to_fclib(answers.first(), Some(&DVector::zeros(problem.rows())))?;
            let dropped = without_place(text, &answers);
            if !dropped.is_empty() {
                let remark = format!("remark: {}: not kept in FCLIB's local form: {}\n", stored.name, dropped.join(", "));
                bar.suspend(|| print_aside(&remark));
            }
            Ok(vec![(folder.join(format!("{}.hdf5", stored.name)), bytes)])
        }
    }
}

/// What a file of FCLIB does not keep of a problem and its answers.
fn without_place(text: &str, answers: &[Solution]) -> Vec<String> {
    let mut dropped = fields_without_place(text);
    let further = answers.len().saturating_sub(1);
    if !answers.is_empty() && dropped.iter().any(|field| field == "mass") {
        dropped.push("what tells the rounding of W, without which `certify` may refuse the answer".into());
    }
    dropped.extend((further > 0).then(|| format!("all answers but the first ({further})")));
    if answers.first().is_some_and(|answer| answer.beta.is_some() || answer.sigma.is_some()) {
        dropped.push("β and σ of the answer".into());
    }
    dropped
}
