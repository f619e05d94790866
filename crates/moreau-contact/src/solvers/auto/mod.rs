//! The default solver, which tries several algorithms in turn.

mod by_blocks;
mod fewer_contacts;
mod interior;
mod kept;
mod rounds;
mod smoothing;
mod stages;
mod stuck;

use super::{ContactSolver, workspace};
use crate::certificate::Judge;
use crate::memory::spare::{self, Lent, Spare};
use crate::operator::Islands;
use crate::problem::{ContactProblem, Coordinates, Law, Solution, island_rows};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::newton::{FIRST_ROUND, ROUNDS};
use crate::tolerance::solvers::{ACCEPTABLE, ENOUGH, FEWEST_IN_ISLANDS, STOP};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use stages::{ENDING, QUICK, SMOOTHED, THOROUGH, left_out};

/// The default choice: one algorithm after another, in a fixed order, until the certificate's residuals are below [`ENOUGH`], after the
/// first of nonsmooth Newton below [`ACCEPTABLE`]; otherwise the best answer seen.
///
/// | for | algorithm |
/// |---|---|
/// | many contacts, of which most do not meet | all that follows with W by blocks, however it is stored |
/// | many contacts, or a few at which all else failed | each island of contacts that meet by itself |
/// | a warm start of many contacts that is no solution any more | a few plain sweeps where they close, a few steps of Newton from there |
/// | the same of more than a hundred, fewer rows for each velocity | measured sweeps, and a few steps of Newton |
/// | the same, where those do not end it | plain sweeps and proximal points in turn, ever more of the former |
/// | up to 12 contacts without friction | Newton-min or Lemke's path on the stack |
/// | up to 12 contacts under Coulomb's law | a few sweeps and Newton, on the stack |
/// | soft contacts | Newton on Gauss's principle |
/// | no friction, up to 12 contacts | Newton-min, and Lemke where a contact does not move itself |
/// | many contacts, two rows for each velocity, round cones | interior points until contacts are told apart, proximal points, Newton |
/// | all but a compliance on edges | a few accelerated sweeps, and a few steps of nonsmooth Newton from what they found |
/// | fewer contacts of that kind under Coulomb's law | interior points and Newton; the same as of many contacts |
/// | a thousand contacts, fewer rows for each velocity, W stored by blocks, round cones | plain sweeps, and proximal points from there |
/// | W stored by blocks, round cones | interior points, and Newton from there |
/// | friction with round cones at up to 100 contacts, where that was not good enough | Fischer and Burmeister's equations, and Newton |
/// | up to 12 contacts, where that was not good enough | Newton from contacts that all stick |
/// | all but a compliance on edges | Newton |
/// | no friction, up to 1 000 contacts | parametric principal pivots |
/// | soft contacts, where that was not good enough | Newton on Gauss's principle, from zero |
/// | 150 to 999 contacts under Coulomb's law, W stored by blocks, where that was not enough | plain sweeps, then proximal points |
/// | all but a compliance on edges, where that was not good enough | proximal points around Newton, from zero |
/// | second-order cones at more contacts; W stored by blocks | Fischer and Burmeister's equations, and Newton |
/// | second-order cones, the fewer contacts the longer | proximal points that creep and leap, and Newton |
/// | W stored by blocks | Newton from zero |
/// | one row, the plane, polyhedral laws, no friction; up to five times as many contacts as further down | Lemke |
/// | the same without the polyhedral associated law in space | more accelerated sweeps, and Newton |
/// | all but a compliance on edges | Newton from zero; Newton on contacts that are soft at first and then harder and harder |
/// | second-order cones | plain sweeps, and Newton from what they found |
/// | second-order cones | a few steps of the alternating directions, and Newton |
/// | one row, the plane, polyhedral laws, no friction; not too many contacts | Lemke |
/// | second-order cones, up to 50 contacts | Newton without some of them, for every set of those that are left |
/// | second-order cones, not too many contacts | Lemke with an octagon, then a pentagon, in place of the disk, and Newton |
/// | second-order cones | many steps of the alternating directions, and Newton |
/// | Coulomb's law, not too many contacts | convex problems with the lift of the one before |
/// | second-order cones | over-relaxation |
/// | polyhedral Coulomb in space | plain sweeps |
/// | the associated laws | accelerated projected gradient with round cones, Clarabel |
/// | one row, the plane, polyhedral laws, no friction; up to ten times as many contacts as before | Lemke |
/// | no friction, several rows | all of this again, for the normal rows alone |
/// | one row, the plane, polyhedral Coulomb, no friction; few contacts | complementary cones: a solution, or the proof of none |
///
/// What takes a start has the best answer of those before; pivots, interior points, paths from soft to hard and from smooth to sharp begin
/// anew. The order and the numbers of iterations are fixed, so that the same problem has the same answer on every machine; no clock is
/// asked unless `--time-limit` gives one. The answer names the algorithm it came from, with the iterations of all that were tried after the
/// stack; of several islands, those of the one that took most.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Auto;

/// [`Auto`] for another accuracy: its algorithms stop, and its chain ends, where the largest relative residual of the certificate is at
/// most this.
///
/// To a millionth:
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
/// use moreau_contact::solvers::AutoWithin;
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let answer = AutoWithin { tolerance: 1e-6 }.solve(&block, None)?;
/// assert!(residuals(&block, &answer)?.is_solution(1e-6));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AutoWithin {
    /// The largest relative residual that is asked for.
    pub tolerance: f64,
}

/// The relative residuals at which the algorithms stop, the quick ones are enough, and the expensive ones are not tried.
#[derive(Clone, Copy)]
struct Goal {
    stop: f64,
    enough: f64,
    acceptable: f64,
}

const NAME: &str = "auto";

impl ContactSolver for Auto {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        // below STOP the rounding of y begins
        Some(Box::new(AutoWithin { tolerance: relative.max(STOP) }))
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        chain(problem, warm_start, Goal { stop: STOP, enough: ENOUGH, acceptable: ACCEPTABLE })
    }
}

impl ContactSolver for AutoWithin {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        // below STOP the rounding of y begins
        Some(Box::new(AutoWithin { tolerance: relative.max(STOP) }))
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let goal = self.tolerance;
        chain(problem, warm_start, Goal { stop: goal, enough: goal, acceptable: goal })
    }
}

fn is_infeasible(error: &Error) -> bool {
    matches!(error, Error::Solver { failure: Failure::Infeasible, .. })
}

/// Whether every contact opens by itself, so that r = 0 solves the problem to the last bit: q = u_free + shift is in K*, or q_n ≥ 0 under
/// the laws that are not associated. An answer to a compliance on edges must give the impulses of the edges, which Lemke's does.
fn opens_everywhere(problem: &ContactProblem) -> bool {
    if problem.compliance().is_some_and(|compliance| compliance.coordinates == Coordinates::Edge) {
        return false;
    }
    let rows = problem.rows_per_contact();
    let (free, shift) = (problem.free_velocity().as_slice(), problem.shift().as_slice());
    let associated = matches!(problem.law(), Law::Associated | Law::PolyhedralAssociated { .. });
    (0..problem.contacts()).all(|k| {
        let q = |row: usize| free[k * rows + row] + shift[k * rows + row];
        let slip: f64 = if associated { (1..rows).map(|row| q(row).abs()).sum() } else { 0.0 };
        q(0) >= problem.friction()[k] * slip
    })
}

/// The answer of [`through`], to W by blocks where it has few; where it is not good and nothing rubs, that of the normal rows, for which
/// there are algorithms to the end.
fn chain(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Result<Solution> {
    super::parts::check_start(problem, warm_start)?;
    if let Some(stored) = by_blocks::stored(problem) {
        let found = chain(&stored, warm_start, goal)?;
        return Ok(Solution { velocity: problem.velocity(&found.impulse), ..found });
    }
    let found = through(problem, warm_start, goal);
    let is_decided = problem.rows_per_contact() == 1 || found.as_ref().is_err_and(is_infeasible);
    if is_decided || !problem.is_frictionless() || super::watch::is_over() {
        return found;
    }
    let relative = |solution: &Solution| Judge::default().look(problem, solution).map(|judged| judged.relative());
    let reached = found.as_ref().map_or(Ok(f64::INFINITY), relative)?;
    let reached = if reached.is_nan() { f64::INFINITY } else { reached };
    let Some(normals) = (reached > goal.acceptable).then(|| problem.normal_rows()).transpose()?.flatten() else {
        return found;
    };
    match through(&normals, None, goal) {
        Ok(Solution { impulse, solver, iterations, .. }) => {
            let rows = problem.rows_per_contact();
            let whole = DVector::from_fn(problem.rows(), |row, _| if row.is_multiple_of(rows) { impulse[row / rows] } else { 0.0 });
            let velocity = problem.velocity(&whole);
            let solution = Solution { solver, ..Solution::new(NAME, whole, velocity, iterations) };
            if relative(&solution)? < reached { Ok(solution) } else { found }
        }
        Err(error) if is_infeasible(&error) && reached > CERTIFY => Err(error),
        Err(_) => found,
    }
}

/// What needs no algorithm; else one island after another, of a few contacts only where one algorithm after another fails at the whole.
fn through(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Result<Solution> {
    if let Some(solution) = at_once(problem, warm_start, goal) {
        return Ok(solution);
    }
    if let Some(solution) = super::few::solve(problem, warm_start, goal.stop, goal.enough) {
        return Ok(solution);
    }
    let many = problem.contacts() >= FEWEST_IN_ISLANDS;
    if let Some(solution) = many.then(|| islands(problem, warm_start, goal)).flatten() {
        return Ok(solution);
    }
    let whole = stages_in_turn(problem, warm_start, goal);
    let is_good = |(relative, _): &(f64, Solution)| *relative <= goal.acceptable;
    let is_last = many || whole.as_ref().is_ok_and(is_good) || whole.as_ref().is_err_and(is_infeasible);
    let whole = whole.map(|(_, solution)| solution);
    if is_last {
        return whole;
    }
    islands(problem, warm_start, goal).map_or(whole, Ok)
}

/// What needs no algorithm: r = 0 where every contact opens, or what is kept where it is still a solution – at rest the impulses of the
/// step before are those of this one.
fn at_once(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Option<Solution> {
    if opens_everywhere(problem) {
        return Some(Solution::new(spare::text(NAME), spare::zeros(problem.rows()), problem.free_velocity().copied(), 0));
    }
    let kept = warm_start?;
    let mut memory = workspace::borrow(problem);
    memory.propose(kept.as_slice());
    let is_answer = !memory.closes(problem, goal.enough) && memory.relative_as_it_is(problem) <= goal.enough;
    is_answer.then(|| memory.answered(NAME, 0))
}

/// The answers to all islands, if there are several and one has an answer; no other algorithm does better, for they do not move each other.
/// An island without an answer, which may have no solution, has no impulses. The answer has the name and the iterations of the algorithm
/// that took most of them.
fn islands(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Option<Solution> {
    let islands = problem.islands();
    let lone = islands.members.last().filter(|_| islands.last_is_of_lone).map_or(0, <[usize]>::len);
    if islands.members.len() + lone.saturating_sub(1) < 2 || !stages::is_iterated(problem) {
        return None;
    }
    let mut merged = Merged { impulse: spare::zeros(problem.rows()), longest: None };
    for (place, members) in islands.members.iter().enumerate() {
        let answer = |members: &[usize]| island(problem, islands, members, warm_start, goal);
        let together = answer(members);
        let is_of_lone = members.len() > 1 && islands.last_is_of_lone && place + 1 == islands.members.len();
        match together {
            // what one of them cannot do is no reason for the others
            Err(_) | Ok((_, false)) if is_of_lone => members.iter().for_each(|k| merged.take(&[*k], answer(&[*k]).ok())),
            other => merged.take(members, other.ok()),
        }
    }
    let (iterations, solver) = merged.longest?;
    let velocity = problem.velocity(&merged.impulse);
    Some(Solution::new(solver.into_inner(), merged.impulse, velocity, iterations))
}

/// The answer to one island, and whether it is good enough.
fn island(
    problem: &ContactProblem,
    islands: &Islands,
    members: &[usize],
    warm_start: Option<&DVector<f64>>,
    goal: Goal,
) -> Result<(Solution, bool)> {
    let island = problem.island(islands, members);
    let kept = warm_start.map(|whole| Lent::from(island_rows(whole, members, problem.rows_per_contact())));
    let kept = kept.as_deref();
    if let Some(solution) = at_once(&island, kept, goal) {
        return Ok((solution, true));
    }
    if let Some(solution) = super::few::solve(&island, kept, goal.stop, goal.enough) {
        return Ok((solution, true));
    }
    let (relative, solution) = stages_in_turn(&island, kept, goal)?;
    Ok((solution, relative <= goal.acceptable))
}

/// The answers to islands, put together.
struct Merged {
    impulse: DVector<f64>,
    longest: Option<(usize, Lent<String>)>,
}

impl Merged {
    fn take(&mut self, members: &[usize], answer: Option<(Solution, bool)>) {
        let Some((mut solution, _)) = answer else { return };
        let rows = solution.impulse.len() / members.len();
        for (k, part) in members.iter().zip(solution.impulse.as_slice().chunks_exact(rows)) {
            self.impulse.rows_mut(k * rows, rows).copy_from_slice(part);
        }
        if self.longest.as_ref().is_none_or(|(most, _)| solution.iterations > *most) {
            self.longest = Some((solution.iterations, std::mem::take(&mut solution.solver).into()));
        }
        solution.leave();
    }
}

/// One algorithm after another until the goal is reached, and the best answer of all with its relative residual.
fn stages_in_turn(problem: &ContactProblem, warm_start: Option<&DVector<f64>>, goal: Goal) -> Result<(f64, Solution)> {
    let (mut memory, mut iterations) = (workspace::borrow(problem), 0);
    let judge = &mut memory.judge;
    judge.prepare(problem);
    let mut best: Option<(f64, Solution)> = None;
    if let Some(solution) = warm_start.and_then(|kept| kept::solve(problem, kept, goal.stop)) {
        // most contacts do what they did in the step before; where they do not, it is as if nothing had been tried
        let relative = judge.judge_prepared(problem, &solution)?.relative();
        iterations += solution.iterations;
        if relative <= goal.enough {
            best = Some((relative, solution));
        } else {
            solution.leave();
        }
    }
    let kept = warm_start.filter(|_| best.is_none());
    let kept = kept.filter(|_| stages::is_taken_in_rounds(problem));
    if let Some(solution) = kept.and_then(|kept| rounds::in_rounds(problem, kept, [FIRST_ROUND, ROUNDS], [goal.stop, goal.enough])) {
        let relative = judge.judge_prepared(problem, &solution)?.relative();
        iterations += solution.iterations;
        best = (!relative.is_nan()).then_some((relative, solution));
    }
    let mut failure = None;
    let stages = [(QUICK, goal.enough), (SMOOTHED, goal.acceptable), (ENDING, goal.enough), (THOROUGH, goal.acceptable)];
    for ((takes, stage), enough) in stages.into_iter().flat_map(|(stages, enough)| stages.iter().map(move |stage| (stage, enough))) {
        if best.as_ref().is_some_and(|(least, _)| *least <= enough || super::watch::is_over()) || !takes(problem) {
            continue;
        }
        let start = best.as_ref().map(|(_, solution)| &solution.impulse).or(warm_start);
        let solution = match stage(problem, start, goal.stop) {
            Ok(solution) => solution,
            // that there is no solution is proved; what was found before is one to the tolerance of the certificate, or none
            Err(error) if is_infeasible(&error) && best.as_ref().is_none_or(|(least, _)| *least > CERTIFY) => return Err(error),
            Err(error) => {
                failure = failure.or(Some(error));
                continue;
            }
        };
        iterations += solution.iterations;
        let relative = judge.judge_prepared(problem, &solution)?.relative();
        let better = !relative.is_nan() && best.as_ref().is_none_or(|(least, _)| relative < *least);
        let worse = if better { best.replace((relative, solution)).map(|(_, worse)| worse) } else { Some(solution) };
        worse.into_iter().for_each(Solution::leave);
    }
    if let Some(given) = warm_start.filter(|_| best.as_ref().is_none_or(|(least, _)| *least > goal.acceptable)) {
        best = or_as_given(problem, judge, given, best);
    }
    match (best, failure) {
        (Some((relative, solution)), _) => {
            let untried = if relative <= goal.acceptable { "" } else { left_out(problem) };
            Ok((relative, Solution { iterations, solver: solution.solver + untried, ..solution }))
        }
        (None, Some(Error::Solver { solver, failure, reason })) => {
            // one of several algorithms may refuse a problem; the chain takes them all, so that it breaks down
            let failure = if failure == Failure::Refused { Failure::Breakdown } else { failure };
            Err(Error::solver(solver, failure, reason + left_out(problem)))
        }
        (None, Some(error)) => Err(error),
        (None, None) => {
            let reason = "no algorithm gave an answer made of numbers; rescale the units of the problem";
            Err(Error::breakdown(NAME, format!("{reason}{}", left_out(problem))))
        }
    }
}

/// The best answer, or what was given where that is a better one: no answer is worse than its start. Of a law that judges more than
/// impulses, as the edges that a compliance acts on, a start tells nothing.
fn or_as_given(
    problem: &ContactProblem,
    judge: &mut Judge,
    given: &DVector<f64>,
    best: Option<(f64, Solution)>,
) -> Option<(f64, Solution)> {
    let given = Solution::new(NAME, given.clone(), problem.velocity(given), 0);
    let relative = judge.judge_prepared(problem, &given).map_or(f64::NAN, |judged| judged.relative());
    let is_better = !relative.is_nan() && best.as_ref().is_none_or(|(least, _)| relative < *least);
    if is_better { Some((relative, given)) } else { best }
}

#[cfg(test)]
mod tests;
