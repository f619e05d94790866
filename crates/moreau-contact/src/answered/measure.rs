//! What solvers do with a problem: each from zero impulses, its answer judged, the answers compared in u.
//!
//! ```text
//!     two answers are one if        max |u − u′| ≤ d · max(|u|, |u_free|)                            [m/s]
//! ```
//! An iterative solver may make as many iterations as a fixed number of multiplications by W allows, so that the same problem ends in the
//! same way on every machine: no clock is asked.

use super::record::{Bound, Difficulty, Ended, OtherAnswer, Outcome};
use crate::certificate::backward::backward;
use crate::certificate::{natural_map, residuals};
use crate::problem::{ContactProblem, Solution};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel, Solvers};
use crate::tolerance::answered::{DIFFERENT, FEW_ITERATIONS, FIRM, LARGEST_PIVOTED, WORK};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::solvers::SWEEPS;
use moreau_exact::error::Failure;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::Serialize;
use std::cell::Cell;

/// What came of a problem.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Measured {
    /// Accepted answers with different velocities, the best first.
    pub answers: Vec<Found>,
    /// What every solver did.
    pub solvers: Vec<Outcome>,
    /// Plain sweeps to 1e-8.
    pub difficulty: Difficulty,
    /// False where a time limit ended a solver, which another run need not do at the same place; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reproducible: Option<bool>,
}

/// Runs the work of one solver, and tells whether it was ended early.
pub type Within<'a> = &'a dyn Fn(&mut dyn FnMut()) -> bool;

/// What is said of a solver that was ended.
const ENDED: &str = "ended by the time limit";

/// An accepted answer.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Found {
    /// r \[N·s\].
    pub impulse: Vec<f64>,
    /// u \[m/s\].
    pub velocity: Vec<f64>,
    /// β or edge impulses \[N·s\], of polyhedral laws.
    pub beta: Option<Vec<f64>>,
    /// σ \[m/s\], of Stewart–Trinkle.
    pub sigma: Option<Vec<f64>>,
    /// Who proposed it.
    pub by: String,
    /// The largest residual relative to the scale of its contact.
    pub relative: f64,
    /// Which one it is.
    pub residual: String,
    /// The contact where it is.
    pub contact: usize,
    /// ‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg.
    pub natural_map_one: Option<f64>,
    /// The proved backward error.
    pub backward: Bound,
    /// Others that found it, of other families of algorithms, nearest first.
    pub agreement: Vec<OtherAnswer>,
}

/// An answer that the certificate accepts.
struct Accepted {
    /// Its source, and the family of the algorithm.
    by: String,
    family: String,
    solution: Solution,
    relative: f64,
}

/// Asks every solver, and judges what it and `given` answer: closed forms, exact fractions, engines, each in the name of its solver.
///
/// # Errors
/// What a certificate says of an answer that does not fit the problem.
pub fn measure(problem: &ContactProblem, given: &[Solution], solvers: &Solvers) -> Result<Measured> {
    let unlimited = |work: &mut dyn FnMut()| {
        work();
        false
    };
    measure_within(problem, given, solvers, &|_| (), &unlimited)
}

/// [`measure`] that tells the name of each solver before it is asked, asks it within a limit, and counts plain sweeps within it.
///
/// # Errors
/// Those of [`measure`].
pub fn measure_within(
    problem: &ContactProblem,
    given: &[Solution],
    solvers: &Solvers,
    asked: &dyn Fn(&str),
    within: Within,
) -> Result<Measured> {
    let was_ended = Cell::new(false);
    let within: Within = &|work| {
        let ended = within(work);
        was_ended.set(was_ended.get() || ended);
        ended
    };
    let mut accepted = Vec::new();
    for candidate in given {
        problem.require_size("impulse", candidate.impulse.len())?;
        let solution = Solution { velocity: problem.velocity(&candidate.impulse), ..candidate.clone() };
        let judged = residuals(problem, &solution)?;
        if judged.is_solution(CERTIFY) {
            let (by, family) = (candidate.solver.clone(), candidate.solver.clone());
            accepted.push(Accepted { by, family, solution, relative: judged.judged.relative() });
        }
    }
    let mut outcomes = Vec::new();
    let mut found: Vec<Option<DVector<f64>>> = Vec::new();
    for name in solvers.names() {
        asked(name);
        let (outcome, solution) = ask(problem, solvers, name, within)?;
        found.push(solution.as_ref().map(|solution| solution.velocity.clone()));
        if let (Some(solution), Some(relative)) = (solution, outcome.relative) {
            accepted.push(Accepted { by: name.into(), family: family(&solution.solver).into(), solution, relative });
        }
        outcomes.push(outcome);
    }
    let answers = answers(problem, accepted)?;
    for (outcome, velocity) in outcomes.iter_mut().zip(found) {
        let distance =
            |velocity: &DVector<f64>| answers.iter().map(|answer| distance(&answer.velocity, velocity)).fold(f64::INFINITY, f64::min);
        outcome.difference = velocity.as_ref().map(distance).filter(|distance| distance.is_finite());
    }
    let difficulty = difficulty(problem, within)?;
    Ok(Measured { answers, solvers: outcomes, difficulty, reproducible: was_ended.get().then_some(false) })
}

/// The family of an algorithm, by the name it gives itself: two of one family are no two witnesses.
fn family(solver: &str) -> &str {
    match solver.split([' ', ',']).next().unwrap_or_default() {
        "pgs" | "psor" => "sweeps",
        "apgd" | "bb" => "gradients",
        "interior-point" | "clarabel" => "interior points",
        "admm" => "alternating directions",
        "newton" | "nonsmooth-newton" | "jean-moreau" | "fischer-burmeister" | "proximal-newton" => "Newton",
        "lemke" => "pivots",
        _ => solver,
    }
}

/// Iterations that [`WORK`] allows.
pub(super) fn iterations(problem: &ContactProblem) -> usize {
    (WORK / problem.delassus().entries().len().max(1)).clamp(FEW_ITERATIONS, SWEEPS)
}

/// What a solver answers within the limit, and whether that ended it.
fn limited_answer(problem: &ContactProblem, solver: &dyn ContactSolver, within: Within) -> (Result<Solution>, bool) {
    let mut answer = None;
    let ended = within(&mut || answer = Some(solver.solve(problem, None)));
    (answer.unwrap_or_else(|| Err(Error::limit(solver.name(), ENDED))), ended)
}

fn ask(problem: &ContactProblem, solvers: &Solvers, name: &'static str, within: Within) -> Result<(Outcome, Option<Solution>)> {
    let mut outcome =
        Outcome { solver: name.into(), ended: Ended::LeftOut, iterations: None, relative: None, difference: None, reason: None };
    if name == "lemke" && problem.rows() > LARGEST_PIVOTED {
        outcome.reason = Some(format!("it has more than {LARGEST_PIVOTED} rows"));
        return Ok((outcome, None));
    }
    let (answer, ended) = limited_answer(problem, &*limited(solvers, name, problem)?, within);
    match answer {
        Ok(solution) => {
            outcome.reason = ended.then(|| ENDED.into());
            let judged = residuals(problem, &solution)?;
            let solved = judged.is_solution(CERTIFY);
            outcome.ended = if solved { Ended::Solved } else { Ended::Rejected };
            outcome.iterations = Some(solution.iterations);
            outcome.relative = Some(judged.judged.relative()).filter(|relative| relative.is_finite());
            Ok((outcome, solved.then_some(solution)))
        }
        Err(Error::Solver { failure, reason, .. }) => {
            outcome.ended = if failure == Failure::Refused { Ended::Refused } else { Ended::Failed };
            outcome.reason = Some(reason);
            Ok((outcome, None))
        }
        Err(error) => Err(error),
    }
}

/// The solver with as many iterations as [`WORK`] allows where it multiplies by W once in each, and its own number elsewhere.
fn limited(solvers: &Solvers, name: &str, problem: &ContactProblem) -> Result<Box<dyn ContactSolver>> {
    let is_swept = ["sweeps", "gradients", "alternating directions"].contains(&family(name));
    solvers.with_iterations(name, is_swept.then(|| iterations(problem)))
}

/// max |u − u′|.
fn distance(one: &[f64], other: &DVector<f64>) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The accepted answers, one for each velocity; only a firm one shows that there is another velocity.
fn answers(problem: &ContactProblem, mut accepted: Vec<Accepted>) -> Result<Vec<Found>> {
    accepted.sort_by(|one, other| one.relative.total_cmp(&other.relative));
    let mut found: Vec<(Found, String)> = Vec::new();
    for one in &accepted {
        let scale = one.solution.velocity.amax().max(problem.free_velocity().amax());
        let nearest = found
            .iter_mut()
            .map(|(answer, family)| (distance(&answer.velocity, &one.solution.velocity), answer, family))
            .min_by(|one, other| one.0.total_cmp(&other.0));
        match nearest {
            Some((difference, answer, family)) if difference <= DIFFERENT * scale => {
                if one.family != *family && answer.agreement.iter().all(|known| self::family(&known.by) != one.family) {
                    answer.agreement.push(OtherAnswer { by: one.by.clone(), difference });
                }
            }
            Some(_) if one.relative > FIRM => {}
            _ => found.push((answer(problem, one)?, one.family.clone())),
        }
    }
    Ok(found
        .into_iter()
        .map(|(mut answer, _)| {
            answer.agreement.sort_by(|one, other| one.difference.total_cmp(&other.difference));
            answer
        })
        .collect())
}

fn answer(problem: &ContactProblem, one: &Accepted) -> Result<Found> {
    let judged = residuals(problem, &one.solution)?.judged;
    let (residual, worst) = judged.worst();
    let backward = match backward(problem, &one.solution.impulse) {
        Ok(proof) => Bound { velocity: Some(proof.worst().map_or(0.0, |(_, delta)| delta)), impulse: Some(proof.moved()), reason: None },
        Err(error) => Bound { velocity: None, impulse: None, reason: Some(error.to_string()) },
    };
    let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
    Ok(Found {
        impulse: list(&one.solution.impulse),
        velocity: list(&one.solution.velocity),
        beta: one.solution.beta.as_ref().map(list),
        sigma: one.solution.sigma.as_ref().map(list),
        by: one.by.clone(),
        relative: one.relative,
        residual: residual.into(),
        contact: worst.contact,
        natural_map_one: natural_map::of_unit_mass(problem, &one.solution.impulse),
        backward,
        agreement: Vec::new(),
    })
}

fn difficulty(problem: &ContactProblem, within: Within) -> Result<Difficulty> {
    let limit = iterations(problem);
    let none = |reason: String| Ok(Difficulty { sweeps: None, reason: Some(reason) });
    let (answer, ended) = limited_answer(problem, &ProjectedGaussSeidel { sweeps: limit, tolerance: CERTIFY, memory: 0 }, within);
    match answer {
        Ok(solution) if residuals(problem, &solution)?.is_solution(CERTIFY) => {
            Ok(Difficulty { sweeps: Some(solution.iterations), reason: None })
        }
        Ok(_) if ended => none(ENDED.into()),
        Ok(solution) => none(format!("{} do not reach it", counted(solution.iterations, "sweep"))),
        Err(Error::Solver { reason, .. }) => none(reason),
        Err(error) => Err(error),
    }
}
