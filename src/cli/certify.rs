//! `moreau certify`: judges an answer to a contact problem without knowing where it came from.

use super::limits::{CommonOptions, check_tolerance};
use super::output::print;
use super::{Answer, Format};
use crate::Result;
use crate::certificate::backward::backward;
use crate::certificate::forward::forward;
use crate::certificate::lcp_proof::{Count, count_with, lcp_of, prove};
use crate::certificate::residuals;
use crate::problem::{ContactProblem, Lcp, Solution};
use crate::report::certificate::Certificate;
use crate::report::json::pretty;
use crate::report::lcp_proof::{Counted, LcpProved};
use crate::report::proofs::Proofs;
use crate::solvers;
use crate::tolerance::cli::CERTIFY;
use std::path::PathBuf;

/// Certify an answer to a contact problem: residuals with units, and whether they are small enough.
///
/// The residuals are computed from the impulses alone; residuals stored in the solution are not read, and its
/// velocities are only compared. Each residual is held against the size of the impulses and velocities of its own pair of
/// bodies, normal and tangential parts apart, and against the rounding of its evaluation; it is shown at the contact where
/// it is worst.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// The answer, a file solution/1; left out, the solution that an HDF5 file of FCLIB holds beside its problem.
    solution: Option<PathBuf>,
    /// Largest residual accepted, relative to the scale of its contact.
    #[arg(long, default_value_t = CERTIFY, value_name = "NUMBER", allow_hyphen_values = true)]
    tolerance: f64,
    /// Prove, in fractions, how far the nearest problem is that impulses near these solve exactly; and by intervals, within which radius
    /// the problem itself has a solution, or why that is not proved; whether velocities are unique; whether there is no solution at all.
    /// Not for polyhedral laws. Of a linear complementarity problem, moreover: how far a solution is, and how many there are; without an
    /// answer, the latter alone.
    #[arg(long)]
    prove: bool,
    #[command(flatten)]
    common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau certify problem.json solution.json
  moreau certify problem.json solution.json --tolerance 1e-12 --format json
  moreau certify problem.json solution.json --prove      with proved backward and forward errors
  moreau certify lcp.json --prove                        how many solutions a linear complementarity problem has
  moreau certify collected.hdf5                          an FCLIB file and the solution stored in it

Exit code 0: a solution, or one is proved to exist; 1: not a solution, or none is proved to exist;
2: the files cannot be read or do not fit each other.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.common.memory.apply()?;
    let tolerance = arguments.tolerance;
    check_tolerance("--tolerance", tolerance)?;
    let problem = ContactProblem::read(&arguments.problem)?;
    let lcp = arguments.prove.then(|| lcp_of(&problem)).flatten();
    if let (Some(lcp), None) = (&lcp, &arguments.solution) {
        let counted = Counted::new(problem.name(), lcp, &counted(&problem, lcp, None)?);
        print(&if arguments.common.format == Format::Json { pretty(&counted)? } else { counted.text() })?;
        return Ok(counted.is_solvable().into());
    }
    let file = arguments.solution.as_ref().unwrap_or(&arguments.problem);
    let solution = Solution::read(file, &problem)?;
    let residuals = residuals(&problem, &solution).map_err(|error| error.in_file(file))?;
    let mut certificate = Certificate::new(&problem, &solution, &residuals, tolerance);
    if arguments.prove {
        certificate = certificate.with_proof(&backward(&problem, &solution.impulse).map_err(|error| error.in_file(&arguments.problem))?);
        certificate = certificate.with_solution_near(&forward(&problem, &solution).map_err(|error| error.in_file(file))?);
        if lcp.is_none() {
            let accepted = certificate.accepts();
            certificate = certificate.with_proofs(Proofs::new(&problem, accepted));
        }
    }
    if let Some(lcp) = &lcp {
        let answer = prove(lcp, &solution.impulse).map_err(|error| error.in_file(file))?;
        certificate = certificate.with_lcp(LcpProved::new(lcp, Some(&answer), &counted(&problem, lcp, Some(&solution))?));
    }
    print(&match arguments.common.format {
        Format::Text => certificate.text(),
        Format::Json => pretty(&certificate)?,
    })?;
    Ok(certificate.accepts().into())
}

/// Solvers whose answers may be different solutions of one problem.
const SEVERAL: [&str; 4] = ["lemke", "newton-min", "parametric-pivoting", "nonsmooth-newton"];

/// How many solutions there are; if that is not known, how many different ones the given answer and those of some solvers are near.
fn counted(problem: &ContactProblem, lcp: &Lcp<f64>, given: Option<&Solution>) -> Result<Count> {
    let proposed = || SEVERAL.iter().filter_map(|name| solvers::ALL.by_name(name).ok()?.solve(problem, None).ok());
    count_with(lcp, || proposed().map(|answer| answer.impulse).chain(given.map(|answer| answer.impulse.clone())).collect())
}
