//! `moreau certify`: judges an answer to a contact problem without knowing where it came from.

use super::kind::{Kind, is_lcp, read_problem};
use super::limits::{CommonOptions, check_tolerance, default_tolerance};
use super::output::{print, style};
use super::remarks::remark;
use super::residual_names::RESIDUALS;
use super::{Answer, Format, posed, progress};
use crate::certificate::backward::backward;
use crate::certificate::forward::{Forward, forward};
use crate::certificate::impulse_set::impulse_set;
use crate::certificate::jointed_proof::{NearJointed, backward_jointed, forward_jointed};
use crate::certificate::lcp_proof::{Count, count_with, lcp_of, prove};
use crate::certificate::polyhedral_proof::prove_polyhedral;
use crate::certificate::residuals;
use crate::problem::{ContactProblem, JointedProblem, Law, Lcp, Posed, Solution};
use crate::problems::from_several_starts;
use crate::report::certificate::Certificate;
use crate::report::json::pretty;
use crate::report::lcp_proof::{Counted, LcpProved};
use crate::report::proofs::{Proofs, no_solution};
use crate::solvers::{self, Solvers};
use crate::tolerance::proof::LOADED;
use crate::{Error, Result};
use std::path::PathBuf;

/// Certify an answer to a contact problem: residuals with units, and whether they are small enough.
///
/// The residuals are computed from the impulses alone; residuals stored in the solution are not read, and its
/// velocities are only compared. Each residual is held against the size of the impulses and velocities of its own pair of
/// bodies, normal and tangential parts apart, and against the rounding of its evaluation; it is shown at the contact where
/// it is worst.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{RESIDUALS}"))]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// The answer, a file solution/1; left out, the solution that an HDF5 file of FCLIB holds beside its problem.
    solution: Option<PathBuf>,
    /// Largest residual accepted, relative to the scale of its contact.
    #[arg(long, default_value = default_tolerance(), value_name = "NUMBER", allow_hyphen_values = true)]
    tolerance: f64,
    /// Prove, in fractions, how far the nearest problem is that impulses near these solve exactly; and by intervals, within which radius
    /// the problem itself has a solution, or why that is not proved, and how many dimensions the impulses with its velocity have; whether
    /// velocities are unique; whether there is no solution at all; how many velocities there are, to six contacts in the plane, three in
    /// space and 20 unknowns λ, β, σ of polyhedral friction. Of that, besides, how far a solution of its complementarity problem is. Of a linear
    /// complementarity problem, moreover: how far a solution is, and how many there are; without an answer, the latter alone. Of a problem
    /// with joints, all of this but the number of velocities.
    #[arg(long)]
    prove: bool,
    #[command(flatten)]
    common: CommonOptions,
}

const USAGE: &str = "moreau certify PROBLEM SOLUTION";

const EXAMPLES: &str = "\
Examples:
  moreau certify problem.json solution.json
  moreau certify problem.json solution.json --tolerance 1e-12 --format json
  moreau certify problem.json solution.json --prove      with proved backward and forward errors
  moreau certify lcp.json --prove                        how many solutions a linear complementarity problem has
  moreau certify collected.hdf5                          an FCLIB file and the solution stored in it

A problem and a solution of it, as `moreau new problem` writes the first and `moreau new solution` the form of the second:
  {\"schema\": \"contact-problem/1\", \"name\": \"block\", \"dimension\": 3, \"law\": \"coulomb\",
   \"friction\": [0.5], \"free_velocity\": [-1, 2, 0],
   \"delassus\": {\"shape\": [3, 3], \"rows\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
  {\"schema\": \"solution/1\", \"problem\": \"block\", \"solver\": \"by hand\",
   \"impulse\": [1, -0.5, 0], \"velocity\": [0, 1.5, 0]}
`impulse` is r [N·s], of every contact the normal entry first; `velocity` is u = W r + u_free [m/s] and may be left
out; so may `problem` and `solver`. Every field: docs/formats.md, `moreau schema solution`.

Exit code 0: a solution, or one is proved to exist; 1: not a solution, or none is proved to exist;
2: the files cannot be read or do not fit each other.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.common.apply()?;
    check_tolerance("--tolerance", arguments.tolerance)?;
    let posed = read_problem(&arguments.problem, USAGE)?;
    remark(&arguments.problem, &posed, arguments.common.format);
    let bar = progress::word(if arguments.prove { "proving" } else { "judging" });
    let (text, accepted) = progress::shown(&bar, || judged(arguments, &posed))?;
    print(&text)?;
    Ok(accepted.into())
}

/// The certificate as it is printed, and whether the answer is yes.
fn judged(arguments: &Arguments, posed: &Posed) -> Result<(String, bool)> {
    let problem = match posed {
        Posed::Contacts(problem) => problem,
        Posed::Jointed(problem) => return jointed(arguments, posed, problem),
    };
    let lcp = arguments.prove.then(|| lcp_of(problem)).flatten();
    if let (Some(lcp), None) = (&lcp, &arguments.solution) {
        let counted = Counted::new(problem.name(), lcp, &counted(problem, lcp, None)?);
        let text = if arguments.common.format == Format::Json { pretty(&counted)? } else { style().fitted(&counted.text()) };
        return Ok((text, counted.is_solvable()));
    }
    let (file, solution) = read_answer(arguments, posed)?;
    let residuals = residuals(problem, &solution).map_err(|error| error.in_file(file))?;
    let mut certificate = Certificate::new(problem, &solution, &residuals, arguments.tolerance);
    if is_lcp(&arguments.problem, posed) {
        certificate = certificate.without_units();
    }
    // what is proved is the same under every law where nothing rubs
    let without_friction = (arguments.prove && problem.is_frictionless()).then(|| problem.clone().into_builder().law(Law::Frictionless));
    let without_friction = without_friction.map(|builder| builder.build()).transpose()?;
    let problem = without_friction.as_ref().unwrap_or(problem);
    if arguments.prove {
        certificate = match backward(problem, &solution.impulse) {
            Ok(proof) => certificate.with_proof(&proof),
            // a law without this proof has the ordinary verdict all the same
            Err(Error::Unsupported(reason)) => certificate.without_proof(reason),
            Err(error) => return Err(error.in_file(file)),
        };
        let near = forward(problem, &solution).map_err(|error| error.in_file(file))?;
        let impulses = match &near {
            Forward::Proved(radius) => impulse_set(problem, &solution, radius),
            Forward::NotProved(_) => None,
        };
        certificate = certificate.with_solution_near(&near, impulses);
        if matches!(problem.law(), Law::PolyhedralCoulomb { .. }) {
            let answer = prove_polyhedral(problem, &solution).map_err(|error| error.in_file(file))?;
            certificate = certificate.with_lcp(LcpProved::polyhedral(&problem.stewart_trinkle_lcp()?, &answer));
        }
        if lcp.is_none() {
            let exists = certificate.is_near_a_solution();
            let started = || from_several_starts(problem, std::slice::from_ref(&solution), &Solvers::own());
            certificate = certificate.with_proofs(Proofs::new(problem, exists, started)?);
        }
    }
    if let Some(lcp) = &lcp {
        let answer = prove(lcp, &solution.impulse).map_err(|error| error.in_file(file))?;
        certificate = certificate.with_lcp(LcpProved::new(lcp, Some(&answer), &counted(problem, lcp, Some(&solution))?));
    }
    if certificate.accepts() && !arguments.prove && residuals.judged.loaded > LOADED {
        certificate = certificate.with_no_solution(no_solution(problem));
    }
    show(&certificate, arguments.common.format)
}

/// The certificate of an answer with joints.
fn jointed(arguments: &Arguments, posed: &Posed, problem: &JointedProblem) -> Result<(String, bool)> {
    let (file, solution) = read_answer(arguments, posed)?;
    let residuals = posed::judge(posed, &solution).map_err(|error| error.in_file(file))?;
    let mut certificate = posed::certificate(posed, &solution, residuals, arguments.tolerance);
    if arguments.prove {
        certificate = match backward_jointed(problem, &solution.impulse) {
            Ok(proof) => certificate.with_proof(&proof),
            Err(Error::Unsupported(reason)) => certificate.without_proof(reason),
            Err(error) => return Err(error.in_file(file)),
        };
        let NearJointed { near, impulses } = forward_jointed(problem, &solution).map_err(|error| error.in_file(file))?;
        certificate = certificate.with_solution_near(&near, impulses);
        let exists = certificate.is_near_a_solution();
        certificate = certificate.with_proofs(Proofs::of_jointed(problem, exists)?);
    }
    if certificate.accepts() && !arguments.prove && posed::is_doubtful(&residuals) {
        certificate = certificate.with_no_solution(posed::refuted(posed));
    }
    show(&certificate, arguments.common.format)
}

fn show(certificate: &Certificate, format: Format) -> Result<(String, bool)> {
    let text = match format {
        Format::Text => style().fitted(&certificate.text()),
        Format::Json => pretty(certificate)?,
    };
    Ok((text, certificate.accepts()))
}

/// The answer, and the file that it is in.
fn read_answer<'a>(arguments: &'a Arguments, problem: &Posed) -> Result<(&'a PathBuf, Solution)> {
    let Some(file) = &arguments.solution else { return stored_answer(&arguments.problem, problem) };
    let solution = posed::read_answer(problem, file).map_err(|error| match Kind::of(file) {
        kind if kind.is_problem() => {
            let found = format!("is {}, which is {}, a problem and no answer", file.display(), kind.words());
            Error::invalid("SOLUTION", found, format!("give a solution/1: {USAGE}"))
        }
        _ => error,
    })?;
    Ok((file, solution))
}

/// The answer that an HDF5 file of FCLIB holds beside its problem; other problems hold none.
fn stored_answer<'a>(file: &'a PathBuf, problem: &Posed) -> Result<(&'a PathBuf, Solution)> {
    match Kind::of(file) {
        Kind::Hdf5 => Ok((file, posed::read_answer(problem, file)?)),
        kind => {
            let found = format!("is missing: {} is {}, which holds no answer", file.display(), kind.words());
            let cure = format!("give one: {USAGE}; `moreau solve {} --out answer.json` makes one", file.display());
            Err(Error::invalid("SOLUTION", found, cure))
        }
    }
}

/// Solvers whose answers may be different solutions of one problem.
const SEVERAL: [&str; 4] = ["lemke", "newton-min", "parametric-pivoting", "nonsmooth-newton"];

/// How many solutions there are; if that is not known, how many different ones the given answer and those of some solvers are near.
fn counted(problem: &ContactProblem, lcp: &Lcp<f64>, given: Option<&Solution>) -> Result<Count> {
    let proposed = || SEVERAL.iter().filter_map(|name| solvers::ALL.by_name(name).ok()?.solve(problem, None).ok());
    count_with(lcp, || proposed().map(|answer| answer.impulse).chain(given.map(|answer| answer.impulse.clone())).collect())
}
