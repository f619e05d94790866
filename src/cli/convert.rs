//! `moreau convert`: writes a contact problem in another format, number for number.

use super::Answer;
use super::limits::MemoryOption;
use super::output::{keep_input, print};
use super::posed::contacts;
use super::problem_law::LawOption;
use crate::files::write_atomically;
use crate::problem::{ContactProblem, Posed};
use crate::{Error, Result};
use std::path::PathBuf;

/// Write a contact problem in another format.
///
/// Reads contact-problem/1, lcp/1, Siconos's .dat or FCLIB's HDF5. Writes contact-problem/1, or FCLIB's local HDF5 where the name of the
/// output ends in .hdf5 or .h5. Every number that the format holds is kept to its last bit; FCLIB's holds W in place of M and H, and
/// neither bodies nor keys nor a name: the file's name is the problem's.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// Write to this file, completely or not at all, instead of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    law: LawOption,
    #[command(flatten)]
    memory: MemoryOption,
}

const EXAMPLES: &str = "\
Examples:
  moreau convert NESpheres_10_1.dat > spheres.json
  moreau convert spheres.json --out spheres.hdf5
  moreau convert spheres.json --law associated --out convex.json";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.memory.apply()?;
    keep_input(&arguments.problem, "--out", arguments.out.as_deref())?;
    let posed = arguments.law.pose(Posed::Contacts(Box::new(ContactProblem::read(&arguments.problem)?)))?;
    let problem = contacts(&posed, "PROBLEM")?;
    let Some(file) = &arguments.out else {
        print(&problem.to_json())?;
        return Ok(Answer::Yes);
    };
    match file.extension().and_then(|end| end.to_str()) {
        Some("hdf5" | "h5") => write_atomically(file, &problem.to_fclib(None, None)?)?,
        Some("json") => problem.write(file)?,
        _ => return Err(Error::invalid("--out", format!("is {}", file.display()), "end it in .json, .hdf5 or .h5")),
    }
    Ok(Answer::Yes)
}
