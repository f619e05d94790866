//! One answer: its certificate, with proofs where they are asked for.

use super::super::kind::is_lcp;
use super::super::output::style;
use super::super::{Format, posed};
use super::arguments::Arguments;
use super::reading::{holds_answer, read_answer};
use crate::certificate::backward::backward;
use crate::certificate::forward::Forward;
use crate::certificate::impulse_set::impulse_set;
use crate::certificate::jointed_proof::{NearJointed, backward_jointed, forward_jointed};
use crate::certificate::lcp_proof::{Count, count_with, lcp_of, prove};
use crate::certificate::polyhedral_proof::prove_polyhedral;
use crate::certificate::true_operator::is_stored_exactly;
use crate::problem::{ContactProblem, JointedProblem, Law, Lcp, Posed, Solution};
use crate::problems::{from_several_starts, near};
use crate::report::certificate::Certificate;
use crate::report::json::pretty;
use crate::report::lcp_proof::{Counted, LcpProved};
use crate::report::no_answer::NoAnswer;
use crate::report::proofs::Proofs;
use crate::solvers::{self, Solvers};
use crate::{Error, Result};

/// The certificate as it is printed, and whether the answer is yes.
pub fn judged(arguments: &Arguments, posed: &Posed) -> Result<(String, bool)> {
    let lcp = match posed {
        Posed::Contacts(problem) => arguments.prove.then(|| lcp_of(problem)).flatten(),
        Posed::Jointed(_) => None,
    };
    let is_alone = lcp.is_none() && arguments.solution.is_none() && !holds_answer(&arguments.problem);
    if let Some(proof) = is_alone.then(|| posed::refuted(posed)).flatten() {
        return without_solution(arguments, proof);
    }
    let problem = match posed {
        Posed::Contacts(problem) => problem,
        Posed::Jointed(problem) => return jointed(arguments, posed, problem),
    };
    if let (Some(lcp), None) = (&lcp, &arguments.solution) {
        let counted = Counted::new(problem.name(), lcp, &counted(problem, lcp, None)?);
        let text = if arguments.common.format == Format::Json { pretty(&counted)? } else { style().fitted(&counted.text()) };
        return Ok((text, counted.is_solvable()));
    }
    let (file, solution) = read_answer(&arguments.problem, arguments.solution.as_deref(), posed)?;
    let residuals = posed::judge(posed, &solution).map_err(|error| error.in_file(file))?;
    let mut certificate = posed::certificate(posed, &solution, residuals, arguments.tolerance);
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
        let near = near(problem, &solution).map_err(|error| error.in_file(file))?;
        let impulses = match &near {
            Forward::Proved(radius) => impulse_set(problem, &solution, radius),
            Forward::NotProved(_) => None,
        };
        certificate = certificate.with_solution_near(&near, impulses);
        if matches!(problem.law(), Law::PolyhedralCoulomb { .. }) && is_stored_exactly(problem) {
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
    if !arguments.prove {
        certificate = posed::doubted(certificate, posed, &residuals);
    }
    show(&certificate, arguments.common.format)
}

/// That no answer need be looked for, as of a file in a folder.
fn without_solution(arguments: &Arguments, proof: String) -> Result<(String, bool)> {
    let error = Error::infeasible("certify", proof.trim_end()).in_file(&arguments.problem);
    let text = match (arguments.common.format, NoAnswer::of(&error)) {
        (Format::Json, Some(failure)) => pretty(&failure)?,
        _ => style().fitted(&format!("{error}\n")),
    };
    Ok((text, false))
}

/// The certificate of an answer with joints.
fn jointed(arguments: &Arguments, posed: &Posed, problem: &JointedProblem) -> Result<(String, bool)> {
    let (file, solution) = read_answer(&arguments.problem, arguments.solution.as_deref(), posed)?;
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
    if !arguments.prove {
        certificate = posed::doubted(certificate, posed, &residuals);
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

/// Solvers whose answers may be different solutions of one problem.
const SEVERAL: [&str; 4] = ["lemke", "newton-min", "parametric-pivoting", "nonsmooth-newton"];

/// How many solutions there are; if that is not known, how many different ones the given answer and those of some solvers are near.
fn counted(problem: &ContactProblem, lcp: &Lcp<f64>, given: Option<&Solution>) -> Result<Count> {
    let proposed = || SEVERAL.iter().filter_map(|name| solvers::ALL.by_name(name).ok()?.solve(problem, None).ok());
    count_with(lcp, || proposed().map(|answer| answer.impulse).chain(given.map(|answer| answer.impulse.clone())).collect())
}
