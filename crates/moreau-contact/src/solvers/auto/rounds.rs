//! Plain sweeps and proximal points in turn.
//!
//! Where many contacts close at once, as in a pile that falls, a few steps do not end it: loads find their way through the pile sweep by
//! sweep, and Newton's method ends it only from where they have come. When they have is not known, so that both take turns: proximal points
//! from what the sweeps have found, and where those fail twice as many sweeps, which go on from their own end.

use super::super::{ContactSolver, ProjectedGaussSeidel, ProximalNewton, watch};
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::newton::STEPS_OF_ROUND;
use nalgebra::DVector;

/// Sweeps and proximal points in turn from these impulses, until the relative residual is `enough`, or the best of their answers: so
/// many sweeps in the first round, and so many rounds.
pub(super) fn in_rounds(
    problem: &ContactProblem,
    from: &DVector<f64>,
    [first, rounds]: [usize; 2],
    [stop, enough]: [f64; 2],
) -> Option<Solution> {
    let (mut judge, mut iterations, mut swept, mut best) = (Judge::default(), 0, from.clone(), None);
    let mut offer = |solution: Solution, best: &mut Option<(f64, Solution)>| {
        iterations += solution.iterations;
        let relative = judge.look(problem, &solution).map_or(f64::NAN, |judged| judged.relative());
        let better = best.as_ref().is_none_or(|(least, _)| relative < *least);
        let worse = if better { best.replace((relative, solution)).map(|(_, worse)| worse) } else { Some(solution) };
        worse.into_iter().for_each(Solution::leave);
        best.as_ref().is_some_and(|(least, _)| *least <= enough) || watch::is_over()
    };
    for round in 0..rounds {
        let sweeps = ProjectedGaussSeidel { sweeps: first << round, tolerance: stop, ..Default::default() };
        let Ok(found) = sweeps.solve(problem, Some(&swept)) else { break };
        swept.copy_from(&found.impulse);
        if offer(found, &mut best) {
            break;
        }
        let points = ProximalNewton { steps: STEPS_OF_ROUND, tolerance: stop, ..Default::default() };
        let Ok(found) = points.solve(problem, Some(&swept)) else { break };
        if offer(found, &mut best) {
            break;
        }
    }
    best.map(|(_, found)| Solution { iterations, ..found })
}
