//! What `moreau solve` is asked.

use super::super::limits::CommonOptions;
use super::super::number;
use super::super::problem_law::LawOption;
use super::super::residual_names::RESIDUALS;
use super::super::solver_options::ToleranceOption;
use super::super::solver_table;
use std::path::PathBuf;

/// Solve a contact problem and certify the answer.
///
/// Reads a file contact-problem/1, lcp/1, Siconos's .dat or FCLIB's HDF5, writes a solution/1 with its residuals, and prints the
/// certificate: on standard error if the solution goes to standard output, on standard output if it goes to a file. Of a folder every
/// problem is solved, each answer goes into the folder --out as NAME.solution.json, and a line per problem is printed.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{RESIDUALS}"))]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB; or a folder of them.
    pub(super) problem: PathBuf,
    /// Which algorithm proposes the answer.
    #[arg(long, default_value = "auto", value_name = "NAME", help = solver_table::names(), long_help = solver_table::table())]
    pub(super) solver: String,
    #[command(flatten)]
    pub(super) tolerance: ToleranceOption,
    /// Most sweeps, steps or pivots of an iterative solver; its own number if absent.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", allow_negative_numbers = true)]
    pub(super) iterations: Option<usize>,
    /// Start from the impulses of this solution/1, in place of zero: contact by contact where it and the problem have `keys`, by position
    /// elsewhere; not with solvers that pivot, go through all patterns or begin inside the cone.
    #[arg(long, value_name = "FILE")]
    pub(super) start: Option<PathBuf>,
    /// Among the impulses that give the velocity of the answer, choose those of least norm ‖r‖ [N·s]: how legs share a load, how hard
    /// fingers press. Not for polyhedral laws nor joints.
    #[arg(long)]
    pub(super) least_norm: bool,
    /// Add to the certificate the largest relative residual of every look that the solver took.
    #[arg(long)]
    pub(super) history: bool,
    #[command(flatten)]
    pub(super) law: LawOption,
    /// Write the solution to this file, completely or not at all, instead of standard output; of a folder of problems, into this folder,
    /// which is made if it is not there.
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    #[command(flatten)]
    pub(super) common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau solve problem.json                              solution/1 on standard output
  moreau solve problem.json --solver pgs --out answer.json
  moreau solve problem.json | moreau certify problem.json /dev/stdin
  moreau solve problem.json --start answer.json --tolerance 1e-12 --history --format json --out better.json
  moreau solve problems/ --out answers/                  every problem of a folder, answers/NAME.solution.json

Exit code 1 means that the solver gave no answer, or one that its certificate rejects; a rejected
answer is written all the same, with its residuals. In JSON, \"status\" tells which: solved; stalled or
limit, of an answer that the certificate rejects, the latter after the most iterations or the time; and
without an answer refused (not a problem for this solver), breakdown, ray, limit. Where it is proved that
there is no solution, it is infeasible, and \"no_solution\" has the proof. Of a folder the code is the worst of its
problems; 2 where a file cannot be read, and the others are solved all the same. A problem that is proved to have
no solution counts as 1, for it has no answer; in `moreau bench`, which judges solvers and not problems, it
does not count.

The smallest problem, a block of 1 kg that slides and arrives at 1 m/s:
  {\"schema\": \"contact-problem/1\", \"name\": \"block\", \"dimension\": 2, \"law\": \"coulomb\",
   \"friction\": [0.5], \"free_velocity\": [-1, 2], \"delassus\": {\"shape\": [2, 2], \"rows\": [[1, 0], [0, 1]]}}";
