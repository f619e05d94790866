//! `moreau convert`: writes a contact problem in another format, number for number.

mod dropped;

pub use dropped::fields_without_place;

use super::Answer;
use super::kind::read_solution;
use super::limits::MemoryOption;
use super::output::{keep_files, print, print_aside};
use super::posed::judge;
use super::problem_law::LawOption;
use super::progress;
use crate::files::write_atomically;
use crate::problem::{ContactProblem, Law, Posed, StoredAnswers};
use crate::report::quantity::short;
use crate::tolerance::cli::CERTIFY;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Write a contact problem in another format.
///
/// Reads contact-problem/1, lcp/1, Siconos's .dat or FCLIB's HDF5. Writes contact-problem/1, or FCLIB's local HDF5 where the name of the
/// output ends in .hdf5 or .h5; a matrix in which few entries are not zero is written by these. Every number that the format holds is
/// kept to its last bit, but for the sign of a zero where a form has entries that are not zero alone (HDF5; M and H by triplets, of more
/// than 240 rows). From HDF5 to HDF5 the stored solution, the guesses and the texts that describe the problem are kept as well; FCLIB's
/// holds W in place of M and H, and neither bodies nor keys; the name stands in it as the title, and what is read of it has the name of
/// the file. What is not kept is named on standard error.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// Write this answer with the problem, a solution/1 or an HDF5 file with a solution; into HDF5 only. A stored solution is replaced.
    #[arg(long, value_name = "FILE")]
    solution: Option<PathBuf>,
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
  moreau convert spheres.json --solution answer.json --out solved.hdf5
  moreau convert spheres.json --law associated --out convex.json";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.memory.apply()?;
    let (file, out) = (&arguments.problem, arguments.out.as_deref());
    let inputs: Vec<&Path> = [Some(file), arguments.solution.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
    keep_files(&inputs, &out.map(|out| ("--out", out)).into_iter().collect::<Vec<_>>())?;
    let to_fclib = is_fclib(out)?;
    if arguments.solution.is_some() && !to_fclib {
        let cure = "end --out in .hdf5 or .h5, or keep the answer as a file of its own";
        return Err(Error::invalid("--solution", "is given, and contact-problem/1 has no place for an answer", cure));
    }
    let posed = progress::shown(&progress::word("reading"), || arguments.law.pose(Posed::read(file)?))?;
    if to_fclib {
        let problem = contacts_of(&posed).and_then(of_coulomb).map_err(|error| error.in_file(file))?;
        let stored = StoredAnswers::read(file)?;
        let dropped = dropped::by_fclib(file, problem, out, &stored, arguments.solution.is_some());
        let answers = match &arguments.solution {
            Some(answer) => with_answer(stored, answer, &posed)?,
            None => stored,
        };
        let bytes = progress::shown(&progress::word("writing"), || problem.to_fclib_with(&answers)).map_err(|error| error.in_file(file))?;
        out.map_or(Ok(()), |out| write_atomically(out, &bytes))?;
        dropped::tell(file, "FCLIB's local form", &dropped);
    } else {
        let text = progress::shown(&progress::word("writing"), || match &posed {
            Posed::Contacts(problem) => problem.to_json(),
            Posed::Jointed(problem) => problem.to_json(),
        });
        match out {
            Some(out) => write_atomically(out, text.as_bytes())?,
            None => print(&text)?,
        }
        dropped::tell(file, "contact-problem/1", &dropped::by_json(file, &posed, &text));
    }
    Ok(Answer::Yes)
}

/// Whether FCLIB's HDF5 is asked for, by the name of the output.
fn is_fclib(out: Option<&Path>) -> Result<bool> {
    match out.map(|out| (out, out.extension().and_then(|end| end.to_str()))) {
        Some((_, Some("hdf5" | "h5"))) => Ok(true),
        None | Some((_, Some("json"))) => Ok(false),
        Some((out, _)) => Err(Error::invalid("--out", format!("is {}", out.display()), "end it in .json, .hdf5 or .h5")),
    }
}

/// The contacts, beside which there is nothing else.
fn contacts_of(posed: &Posed) -> Result<&ContactProblem> {
    match posed {
        Posed::Contacts(problem) => Ok(problem),
        Posed::Jointed(_) => {
            let problem = "names limits or bilateral constraints, which are not written into HDF5 here";
            Err(Error::invalid("kinds", problem, "end --out in .json; `moreau solve`, `certify` and `bench` read this file as it is"))
        }
    }
}

/// The problem under Coulomb's law, which is FCLIB's.
fn of_coulomb(problem: &ContactProblem) -> Result<&ContactProblem> {
    match problem.law() {
        Law::Coulomb => Ok(problem),
        law => {
            let found = format!("is `{}`, and FCLIB has no place for laws other than Coulomb's", law.name());
            let cure =
                if problem.rows_per_contact() == 1 { "end --out in .json" } else { "pose it with `--law coulomb`, or end --out in .json" };
            Err(Error::invalid("law", found, cure))
        }
    }
}

/// The answers with this one as the solution; one that is no solution is written all the same, and told.
fn with_answer(mut stored: StoredAnswers, file: &Path, posed: &Posed) -> Result<StoredAnswers> {
    let solution = read_solution(file, posed, "moreau convert PROBLEM --solution SOLUTION --out FILE.hdf5")?;
    let residuals = judge(posed, &solution).map_err(|error| error.in_file(file))?;
    if !residuals.is_solution(CERTIFY) {
        print_aside(&format!(
            "remark: {}: is no solution, its largest relative residual is {}; it is written\n",
            file.display(),
            short(residuals.relative())
        ));
    }
    stored.solution = Some(solution);
    Ok(stored)
}
