//! Interior points first, and what ends the problem from there: they tell which contacts press, stick and slide, however redundant they
//! are.

use super::super::watch;
use super::super::{ContactSolver, FischerBurmeister, InteriorPoint, NonsmoothNewton, ProximalNewton};
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::newton::{NEAR, NEAR_PROXIMAL, POINTS_AFTER_INTERIOR, STEPS_AFTER_INTERIOR};
use crate::tolerance::solvers::{self as tolerance, ENOUGH};
use moreau_exact::Result;

/// Interior points, which tell which contacts press, stick and slide however redundant they are, and Newton from there.
pub(super) fn and_newton(problem: &ContactProblem, stop: f64) -> Result<Solution> {
    let begun = InteriorPoint { tolerance: stop, ..Default::default() }.solve(problem, None)?;
    let ended = NonsmoothNewton { starts: 1, tolerance: stop, ..Default::default() }.solve(problem, Some(&begun.impulse))?;
    Ok(Solution { iterations: begun.iterations + ended.iterations, ..ended })
}

/// Interior points, from more impulse and with what leaves the middle put back, as far as they tell most contacts apart, and from there
/// what tells the others: a few proximal points, where those fail Fischer and Burmeister's equations, and where those fail many points.
pub(super) fn and_points(problem: &ContactProblem, stop: f64) -> Result<Solution> {
    let interior = InteriorPoint { first_impulse: tolerance::FIRST_IMPULSE, recentres: true, ..Default::default() };
    let begun = InteriorPoint { tolerance: stop, gap: tolerance::IDENTIFIED, ..interior }.solve(problem, None)?;
    told_apart(problem, &begun, POINTS_AFTER_INTERIOR, stop)
}

/// So many proximal points from what interior points have found, where those fail Fischer and Burmeister's equations, and where those fail
/// many points.
fn told_apart(problem: &ContactProblem, begun: &Solution, few: usize, stop: f64) -> Result<Solution> {
    let relative = |solution: &Solution| Judge::default().look(problem, solution).map(|judged| judged.relative());
    let near = NEAR.max(stop);
    let points = through_points(problem, begun, few, stop)?;
    let reached = relative(&points)?;
    if reached <= stop.max(ENOUGH) || watch::is_over() {
        return Ok(points);
    }
    let smoothed = FischerBurmeister { tolerance: near, ..Default::default() }.solve(problem, Some(&begun.impulse)).ok();
    let iterations = points.iterations + smoothed.as_ref().map_or(0, |smoothed| smoothed.iterations);
    if let Some(smoothed) = smoothed.filter(|smoothed| relative(smoothed).is_ok_and(|relative| relative <= near)) {
        return to_the_end(problem, Solution { iterations, ..smoothed }, stop);
    }
    if reached <= near || watch::is_over() {
        return Ok(Solution { iterations, ..points });
    }
    through_points(problem, &Solution { iterations, ..points }, STEPS_AFTER_INTERIOR, stop)
}

/// At most so many proximal points from there, and Newton for the last digits.
fn through_points(problem: &ContactProblem, begun: &Solution, steps: usize, stop: f64) -> Result<Solution> {
    let near = NEAR.max(stop);
    let points = ProximalNewton { steps, tolerance: near, softness: NEAR_PROXIMAL, ..Default::default() };
    let points = points.solve(problem, Some(&begun.impulse))?;
    let iterations = begun.iterations + points.iterations;
    if points.iterations >= steps {
        return Ok(Solution { iterations, ..points });
    }
    to_the_end(problem, Solution { iterations, ..points }, stop)
}

/// Newton for the last digits, where more are asked for than those that others leave.
fn to_the_end(problem: &ContactProblem, near: Solution, stop: f64) -> Result<Solution> {
    if stop >= NEAR {
        return Ok(near);
    }
    let ended = NonsmoothNewton { starts: 1, tolerance: stop, ..Default::default() }.solve(problem, Some(&near.impulse))?;
    Ok(Solution { iterations: near.iterations + ended.iterations, ..ended })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Law;
    use crate::solvers::test_problems::{by_blocks, tower};
    use crate::tolerance::solvers::STOP;

    fn begun(problem: &ContactProblem) -> Solution {
        let zero = nalgebra::DVector::zeros(problem.rows());
        Solution::new("zero", zero.clone(), problem.velocity(&zero), 0)
    }

    #[test]
    fn where_few_points_do_not_tell_contacts_apart_the_equations_do() {
        for law in [Law::Coulomb, Law::Associated] {
            let problem = by_blocks(&tower(8, law, 0.3));
            let is_solved = |solution: &Solution| residuals(&problem, solution).expect("sizes fit").is_solution(ENOUGH);
            let one = through_points(&problem, &begun(&problem), 1, STOP).expect("it has an answer");
            assert!(!is_solved(&one), "{law:?}: what one point solves tests nothing");
            let smoothed = FischerBurmeister { tolerance: NEAR, ..Default::default() }.solve(&problem, None).expect("an answer");
            let by_equations = to_the_end(&problem, smoothed, STOP).expect("an answer");
            let answer = told_apart(&problem, &begun(&problem), 1, STOP).expect("it has an answer");
            assert!(is_solved(&answer), "{law:?}");
            assert_eq!((answer.impulse, answer.iterations), (by_equations.impulse, 1 + by_equations.iterations), "{law:?}");
            assert!(is_solved(&and_points(&problem, STOP).expect("it has an answer")), "{law:?}");
        }
    }

    #[test]
    fn an_accuracy_that_points_reach_is_not_gone_beyond() {
        let problem = by_blocks(&tower(8, Law::Coulomb, 0.0));
        let rough = and_points(&problem, 1e-4).expect("it has an answer");
        let fine = and_points(&problem, STOP).expect("it has an answer");
        let relative = |solution: &Solution| residuals(&problem, solution).expect("sizes fit").judged.relative();
        assert!(relative(&rough) <= 1e-4 && relative(&fine) <= ENOUGH && rough.iterations < fine.iterations);
    }
}
