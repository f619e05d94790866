//! One problem: solved, and judged.

use super::super::kind::is_lcp;
use super::super::posed;
use super::arguments::Arguments;
use crate::certificate::joints::JointedResiduals;
use crate::problem::{Posed, Solution};
use crate::report::certificate::{Certificate, Ending};
use crate::report::no_answer::NoAnswer;
use crate::solvers::{ContactSolver, least_norm, watch::watched};
use crate::tolerance::certificate::CERTIFY;
use crate::{Error, Result};
use nalgebra::DVector;
use std::path::Path;

/// What became of a problem.
pub enum Outcome {
    /// A solver proposed an answer.
    Answer(Box<Answered>),
    /// It proposed none, or could not be asked.
    None {
        /// What it says.
        error: Error,
        /// Why there is no solution, where that is proved.
        proof: Option<String>,
        /// Whether the time limit ended the solver.
        interrupted: bool,
    },
}

/// A problem with the answer that is proposed.
pub struct Answered {
    problem: Posed,
    solution: Solution,
    residuals: JointedResiduals,
    ending: Ending,
    is_lcp: bool,
}

/// Solves the problem of a file, from these impulses if they are given.
///
/// # Errors
/// Whatever is wrong with what was asked. An error of the solver is an [`Outcome`].
pub fn solved(
    arguments: &Arguments,
    solver: &dyn ContactSolver,
    file: &Path,
    problem: Posed,
    start: Option<&DVector<f64>>,
) -> Result<Outcome> {
    posed::require_memory(&problem).map_err(|error| error.in_file(file))?;
    let answered = || {
        let solution = posed::solve(&problem, solver, start).map_err(|error| error.in_file(file))?;
        Ok(if arguments.least_norm { smallest(&problem, solution, file) } else { Ok((solution, None)) })
    };
    let (answer, seen) = arguments.tolerance.within_time(|interrupt| watched(interrupt, answered));
    let (mut solution, not_least_norm) = match answer {
        Ok(smallest) => smallest?,
        Err(error) => {
            // what is refused as it stands has its own message
            let proof = NoAnswer::of(&error).filter(|_| !seen.interrupted).and_then(|_| posed::refuted(&problem));
            return Ok(Outcome::None { error, proof, interrupted: seen.interrupted });
        }
    };
    solution.keys = posed::keys(&problem);
    solution.reproducible = seen.interrupted.then_some(false);
    let residuals = posed::judge_own(&problem, &mut solution, arguments.tolerance.accepted())?;
    let exhausted = seen.interrupted || solver.iteration_limit().is_some_and(|most| solution.iterations >= most);
    // what ends without a look on the way has its answer looked at
    let looks = if seen.history.is_empty() { vec![residuals.relative()] } else { seen.history };
    let history = arguments.history.then_some(looks);
    let ending = Ending { exhausted, reproducible: !seen.interrupted, not_least_norm, history };
    let is_lcp = is_lcp(file, &problem);
    Ok(Outcome::Answer(Box::new(Answered { problem, solution, residuals, ending, is_lcp })))
}

impl Answered {
    /// The certificate; what it rejects, or accepts with doubt, is asked whether there is a solution at all.
    pub fn certificate(&self, tolerance: f64) -> Certificate<'_> {
        let certificate = posed::certificate(&self.problem, &self.solution, self.residuals, tolerance).with_ending(self.ending.clone());
        let certificate = if self.is_lcp { certificate.without_units() } else { certificate };
        if certificate.accepts() {
            posed::doubted(certificate, &self.problem, &self.residuals)
        } else {
            certificate.with_no_solution(posed::refuted(&self.problem))
        }
    }

    /// The largest relative residual.
    pub fn relative(&self) -> f64 {
        self.residuals.relative()
    }

    /// The answer as a solution/1.
    ///
    /// # Errors
    /// [`Error::Json`] if the residuals have no JSON.
    pub fn written(&self) -> Result<String> {
        Ok(self.solution.to_json(Some(posed::name(&self.problem)), Some(serde_json::to_value(self.residuals)?)))
    }
}

/// The answer with the impulses of least norm; where they are not found as it is, with the reason. A rejected one stays as it is, too.
fn smallest(problem: &Posed, solution: Solution, file: &Path) -> Result<(Solution, Option<String>)> {
    let contacts = posed::contacts(problem, "--least-norm")?;
    if !posed::judge(problem, &solution)?.contacts.judged.accepts(CERTIFY) {
        return Ok((solution, None));
    }
    match least_norm(contacts, &solution) {
        Ok(smallest) => Ok((smallest, None)),
        Err(Error::Solver { reason, .. }) => Ok((solution, Some(reason))),
        Err(error) => Err(error.in_file(file)),
    }
}
