//! `moreau solve`: solves a contact problem and certifies its own answer.

use super::kind::{is_lcp, read_problem};
use super::limits::CommonOptions;
use super::output::{keep_input, no_answer, print, print_aside, style};
use super::problem_law::LawOption;
use super::remarks::remark;
use super::residual_names::RESIDUALS;
use super::solver_options::ToleranceOption;
use super::{Answer, Format, posed, progress, solver_table};
use crate::files::write_atomically;
use crate::problem::{Posed, Solution};
use crate::report::certificate::Ending;
use crate::report::json::pretty;
use crate::report::no_answer::NoAnswer;
use crate::solvers::{least_norm, watch::watched};
use crate::tolerance::certificate::CERTIFY;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Solve a contact problem and certify the answer.
///
/// Reads a file contact-problem/1, lcp/1, Siconos's .dat or FCLIB's HDF5, writes a solution/1 with its residuals, and prints the
/// certificate: on standard error if the solution goes to standard output, on standard output if it goes to a file.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{RESIDUALS}"))]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// Which algorithm proposes the answer.
    #[arg(long, default_value = "auto", value_name = "NAME", help = solver_table::names(), long_help = solver_table::table())]
    solver: String,
    #[command(flatten)]
    tolerance: ToleranceOption,
    /// Most sweeps, steps or pivots of an iterative solver; its own number if absent.
    #[arg(long, value_name = "NUMBER")]
    iterations: Option<usize>,
    /// Start from the impulses of this solution/1, in place of zero; not with solvers that pivot, go through all patterns or begin
    /// inside the cone.
    #[arg(long, value_name = "FILE")]
    start: Option<PathBuf>,
    /// Among the impulses that give the velocity of the answer, choose those of least norm ‖r‖ [N·s]: how legs share a load, how hard
    /// fingers press. Not for polyhedral laws nor joints.
    #[arg(long)]
    least_norm: bool,
    /// Add to the certificate the largest relative residual of every look that the solver took.
    #[arg(long)]
    history: bool,
    #[command(flatten)]
    law: LawOption,
    /// Write the solution to this file, completely or not at all, instead of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    common: CommonOptions,
}

const USAGE: &str = "moreau solve PROBLEM";

const EXAMPLES: &str = "\
Examples:
  moreau solve problem.json                              solution/1 on standard output
  moreau solve problem.json --solver pgs --out answer.json
  moreau solve problem.json | moreau certify problem.json /dev/stdin
  moreau solve problem.json --start answer.json --tolerance 1e-12 --history --format json --out better.json

Exit code 1 means that the solver gave no answer, or one that its certificate rejects; a rejected
answer is written all the same, with its residuals. In JSON, \"status\" tells which: solved; stalled or
limit, of an answer that the certificate rejects, the latter after the most iterations or the time; and
without an answer refused (not a problem for this solver), breakdown, ray, limit. Where it is proved that
there is no solution, it is infeasible, and \"no_solution\" has the proof.

The smallest problem, a block of 1 kg that slides and arrives at 1 m/s:
  {\"schema\": \"contact-problem/1\", \"name\": \"block\", \"dimension\": 2, \"law\": \"coulomb\",
   \"friction\": [0.5], \"free_velocity\": [-1, 2], \"delassus\": {\"shape\": [2, 2], \"rows\": [[1, 0], [0, 1]]}}";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.tolerance.check()?;
    arguments.common.apply()?;
    let solver = arguments.tolerance.solver(&arguments.solver, arguments.iterations)?;
    keep_input(&arguments.problem, "--out", arguments.out.as_deref())?;
    let problem = arguments.law.pose(read_problem(&arguments.problem, USAGE)?)?;
    let start = arguments.start.as_deref().map(|file| posed::read_answer(&problem, file).map(|solution| (file, solution))).transpose()?;
    if start.is_some() && !solver.takes_start() {
        let problem = format!("does nothing with `{}`, which has a start of its own", solver.name());
        return Err(Error::invalid("--start", problem, "leave it out, or ask `auto`, which takes one"));
    }
    posed::require_memory(&problem)?;
    remark(&arguments.problem, &problem, arguments.common.format);
    let warm = start.as_ref().map(|(_, solution)| &solution.impulse);
    let solved = || arguments.tolerance.within_time(|interrupt| watched(interrupt, || posed::solve(&problem, &*solver, warm)));
    let (answer, seen) = progress::shown(&progress::word("solving"), solved);
    let place = match (&answer, &start) {
        (Err(Error::Invalid { field, .. }), Some((file, _))) if field.starts_with("warm_start") => file,
        _ => arguments.problem.as_path(),
    };
    let solution = match answer.map_err(|error| error.in_file(place)) {
        Ok(solution) => solution,
        Err(error) => {
            // what is refused as it stands has its own message
            let proof = NoAnswer::of(&error).filter(|_| !seen.interrupted).and_then(|_| posed::refuted(&problem));
            if arguments.common.format == Format::Json {
                return no_answer(error, proof, arguments.out.is_none());
            }
            if let Some(proof) = proof {
                print_aside(&proof);
            }
            return Err(error);
        }
    };
    let solution = if arguments.least_norm { smallest(&problem, solution, &arguments.problem)? } else { solution };
    let residuals = posed::judge(&problem, &solution)?;
    let exhausted = seen.interrupted || solver.iteration_limit().is_some_and(|most| solution.iterations >= most);
    let ending = Ending { exhausted, reproducible: !seen.interrupted, history: arguments.history.then_some(seen.history) };
    let certificate = posed::certificate(&problem, &solution, residuals, arguments.tolerance.accepted()).with_ending(ending);
    let certificate = if is_lcp(&arguments.problem, &problem) { certificate.without_units() } else { certificate };
    let believed = certificate.accepts() && !posed::is_doubtful(&residuals);
    let certificate = if believed { certificate } else { certificate.with_no_solution(posed::refuted(&problem)) };
    let report = match arguments.common.format {
        Format::Text => style().fitted(&certificate.text()),
        Format::Json => pretty(&certificate)?,
    };
    let answer = solution.to_json(Some(posed::name(&problem)), Some(serde_json::to_value(residuals)?));
    match &arguments.out {
        Some(file) => {
            write_atomically(file, answer.as_bytes())?;
            print(&report)?;
        }
        None => {
            print(&answer)?;
            print_aside(&report);
        }
    }
    Ok(certificate.accepts().into())
}

/// The answer with the impulses of least norm; a rejected one stays as it is.
fn smallest(problem: &Posed, solution: Solution, file: &Path) -> Result<Solution> {
    let contacts = posed::contacts(problem, "--least-norm")?;
    let rejected = !posed::judge(problem, &solution)?.contacts.judged.accepts(CERTIFY);
    if rejected { Ok(solution) } else { least_norm(contacts, &solution).map_err(|error| error.in_file(file)) }
}
