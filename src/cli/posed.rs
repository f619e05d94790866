//! What a file poses, contacts alone or contacts with joints: solved, judged and shown in the same way.

use crate::certificate::Judge;
use crate::certificate::joints::{self, JointedResiduals, jointed_residuals};
use crate::certificate::natural_map::of_unit_mass;
use crate::certificate::residuals;
use crate::number::larger;
use crate::problem::{ContactKey, ContactProblem, Posed, Solution};
use crate::report::certificate::Certificate;
use crate::report::proofs::{NoSolution, no_solution, no_solution_jointed};
use crate::solvers::{self, Auto, ContactSolver, WithoutJoints, solve_jointed};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::joints::AGREES;
use crate::tolerance::proof::LOADED;
use crate::{Error, Result, memory};
use nalgebra::DVector;
use std::path::Path;

/// Its name.
pub fn name(posed: &Posed) -> &str {
    match posed {
        Posed::Contacts(problem) => problem.name(),
        Posed::Jointed(problem) => problem.name(),
    }
}

/// Which contact each is, where that is known of contacts alone: with joints an answer has no keys.
pub fn keys(posed: &Posed) -> Option<Vec<ContactKey>> {
    match posed {
        Posed::Contacts(problem) => problem.keys().map(<[_]>::to_vec),
        Posed::Jointed(_) => None,
    }
}

/// How many contacts and joints it has.
pub fn constraints(posed: &Posed) -> usize {
    match posed {
        Posed::Contacts(problem) => problem.contacts(),
        Posed::Jointed(problem) => problem.kinds().len(),
    }
}

/// Refuses what takes more memory than is allowed before it is begun.
pub fn require_memory(posed: &Posed) -> Result<()> {
    match posed {
        // a W by blocks or bodies is measured by the solvers that need it whole
        Posed::Contacts(problem) if problem.delassus().is_dense() => {
            memory::require(format_args!("solving {} rows", problem.rows()), 8 * memory::matrix(problem.rows(), problem.rows()))
        }
        // joints are measured when they are read
        _ => Ok(()),
    }
}

/// The contacts, where there are no joints.
pub fn contacts<'a>(posed: &'a Posed, option: &str) -> Result<&'a ContactProblem> {
    match posed {
        Posed::Contacts(problem) => Ok(problem),
        Posed::Jointed(_) => Err(Error::invalid(option, "is for contacts alone, and this problem has `kinds` with joints", "leave it out")),
    }
}

/// What a solver proposes from zero impulses, as it is timed.
pub fn answer_of(posed: &Posed, solver: &dyn ContactSolver) -> Result<Solution> {
    propose(posed, solver, None)
}

/// What a solver proposes; a refusal names solvers that take the contacts.
pub fn solve(posed: &Posed, solver: &dyn ContactSolver, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
    propose(posed, solver, warm_start).map_err(|error| with_cure(error, posed))
}

fn propose(posed: &Posed, solver: &dyn ContactSolver, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
    let answer = match posed {
        Posed::Contacts(problem) => solver.solve(problem, warm_start),
        Posed::Jointed(problem) => solve_jointed(problem, solver, warm_start),
    };
    answer.map_err(|error| in_name_of(solver.name(), error))
}

/// The error of a solver that asks others in its own name, for that is the one that was asked for.
pub(super) fn in_name_of(asked: &str, error: Error) -> Error {
    match error {
        Error::Solver { solver, failure, reason } if solver != asked => {
            Error::solver(asked, failure, format!("`{solver}`, which it asked: {reason}"))
        }
        other => other,
    }
}

/// The error of a solver; a refusal with solvers that take the contacts.
pub fn with_cure(error: Error, posed: &Posed) -> Error {
    match posed {
        Posed::Contacts(problem) => solvers::ALL.with_cure(error, problem),
        Posed::Jointed(problem) => match WithoutJoints::new(problem) {
            Ok(left) => solvers::ALL.with_cure(error, left.contacts()),
            Err(_) => error,
        },
    }
}

/// ‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg; none with joints, which it does not know.
pub fn natural_map(posed: &Posed, solution: &Solution) -> Option<f64> {
    match posed {
        Posed::Contacts(problem) => of_unit_mass(problem, &solution.impulse),
        Posed::Jointed(_) => None,
    }
}

/// The residuals of an answer.
pub fn judge(posed: &Posed, solution: &Solution) -> Result<JointedResiduals> {
    match posed {
        Posed::Contacts(problem) => residuals(problem, solution).map(|contacts| JointedResiduals { contacts, bilateral: None }),
        Posed::Jointed(problem) => jointed_residuals(problem, solution),
    }
}

/// The residuals of what a solver answered. Where its u is not right to the last digits it is summed again with twice of them.
pub fn judge_own(posed: &Posed, solution: &mut Solution, tolerance: f64) -> Result<JointedResiduals> {
    let judged = judge(posed, solution)?;
    let is_sharp = !judged.is_solution(tolerance)
        && match posed {
            Posed::Contacts(problem) => Judge::default().sharpen(problem, solution)?,
            Posed::Jointed(problem) => joints::sharpen(problem, solution)?,
        };
    if is_sharp { judge(posed, solution) } else { Ok(judged) }
}

/// The answer of a file.
pub fn read_answer(posed: &Posed, file: &Path) -> Result<Solution> {
    Solution::read_posed(file, posed)
}

/// The certificate of an answer with these residuals.
pub fn certificate<'a>(posed: &'a Posed, solution: &'a Solution, residuals: JointedResiduals, tolerance: f64) -> Certificate<'a> {
    match posed {
        Posed::Contacts(problem) => Certificate::new(problem, solution, &residuals.contacts, tolerance),
        Posed::Jointed(problem) => Certificate::of_jointed(problem, solution, residuals, tolerance),
    }
}

/// That there is no solution, of an answer that would be accepted and whose impulses are so large that they may hide it. Where the data
/// contradict themselves by no more than their rounding, and the answer misses the law by no more, the residuals decide.
pub fn denied(posed: &Posed, residuals: &JointedResiduals) -> Option<String> {
    let proof = if residuals.contacts.judged.loaded > LOADED { proof(posed) } else { None };
    proof.filter(|proof| !(proof.is_by_rounding() && misses_rounding(residuals))).map(|proof| proof.text)
}

/// Whether an answer misses the law by no more of the given velocities than joints may contradict each other.
fn misses_rounding(residuals: &JointedResiduals) -> bool {
    let joints = residuals.bilateral.map_or(0.0, |worst| worst.part.relative());
    larger(residuals.contacts.judged.missed, joints) <= AGREES
}

/// The certificate, which rejects an answer that it would accept where that is so.
pub fn doubted<'a>(certificate: Certificate<'a>, posed: &Posed, residuals: &JointedResiduals) -> Certificate<'a> {
    if certificate.accepts() { certificate.with_no_solution(denied(posed, residuals)) } else { certificate }
}

/// That there is no solution, where that is proved, and not by what may be the rounding of the data.
pub fn refuted(posed: &Posed) -> Option<String> {
    proof(posed).filter(|proof| !(proof.is_by_rounding() && (proof.relative.is_some() || is_solved(posed)))).map(|proof| proof.text)
}

/// Whether `auto` has an answer that misses the law by rounding.
fn is_solved(posed: &Posed) -> bool {
    let judged = propose(posed, &Auto, None).and_then(|answer| judge(posed, &answer));
    judged.is_ok_and(|residuals| residuals.is_solution(CERTIFY) && misses_rounding(&residuals))
}

fn proof(posed: &Posed) -> Option<NoSolution> {
    match posed {
        Posed::Contacts(problem) => no_solution(problem),
        Posed::Jointed(problem) => no_solution_jointed(problem),
    }
}
