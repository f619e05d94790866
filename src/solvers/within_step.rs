//! The solver for long runs: as accurate as sweeps get in reasonable time, and never stuck in one step.
//!
//! Two contact points of a pair of bodies may ask for tangential velocities that differ by the tilt of their normals, 10⁻⁸ m/s or so. Then no
//! impulse below the friction limit is a solution, the tangential impulses grow by 10⁻⁹ N·s per sweep until one of them reaches the limit,
//! and no iteration of this kind ends sooner, though the natural map fell below [`GOOD_ENOUGH`] long before. Likewise a box that slides on four corners under the
//! associated law has a manifold of impulses, along which sweeps creep.

use super::stopping::Stopping;
use super::{ClarabelPolished, ContactSolver, LemkePivoting, ProjectedGaussSeidel, Reference};
use crate::Result;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers::{FIRST_SWEEPS, GOOD_ENOUGH, PATIENT_ROUNDS, ROUNDS, STOP};
use nalgebra::DVector;

/// Rounds of sweeps, accelerated and plain in turn: until one converges to the rounding floor, or after [`PATIENT_ROUNDS`] has ended with a
/// natural map below [`GOOD_ENOUGH`]. A polyhedral problem on which they fail goes to Lemke.
///
/// Only a step of a simulation is solved like this, one with impulses to start from. A problem on its own, and a law that sweeps do not
/// solve, goes to [`Reference`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WithinStep;

impl ContactSolver for WithinStep {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let polyhedral = problem.law.directions().is_some();
        let swept = !polyhedral || (problem.rows_per_contact == 3 && matches!(problem.law, Law::PolyhedralCoulomb { .. }));
        if problem.compliance.is_some() {
            return Reference.solve(problem, warm_start);
        }
        let Some(start) = warm_start.filter(|_| swept) else { return Reference.solve(problem, warm_start) };
        match rounds(problem, start)? {
            Answer::Good(solution) => Ok(solution),
            Answer::Rough(_) if polyhedral => LemkePivoting.solve(problem, None),
            Answer::Rough(solution) => Ok(solution),
        }
    }
}

enum Answer {
    Good(Solution),
    Rough(Solution),
}

fn rounds(problem: &ContactProblem, start: &DVector<f64>) -> Result<Answer> {
    let accelerated = ProjectedGaussSeidel { sweeps: FIRST_SWEEPS, ..ProjectedGaussSeidel::accelerated() };
    let plain = ProjectedGaussSeidel { memory: 0, ..accelerated };
    let solves = |solution: &Solution, relative: f64| {
        Stopping::new(problem, relative).holds(&solution.impulse, &problem.law_velocity(&solution.impulse))
    };
    let mut impulse = start.clone();
    let mut sweeps = 0;
    for round in 1..=ROUNDS {
        let solver = if round % 2 == 1 { accelerated } else { plain };
        let mut solution = solver.solve(problem, Some(&impulse))?;
        sweeps += solution.iterations;
        if problem.law == Law::Associated && !solves(&solution, STOP) {
            // Where impulses are not unique, sweeps creep along their manifold for ever; an interior point is a place to go on from.
            solution = ClarabelPolished.solve(problem, None).unwrap_or(solution);
        }
        if solves(&solution, STOP) || (round >= patience(problem.law) && solves(&solution, GOOD_ENOUGH)) {
            return Ok(Answer::Good(Solution { iterations: sweeps, ..solution }));
        }
        impulse = solution.impulse;
    }
    let velocity = problem.velocity(&impulse);
    Ok(Answer::Rough(Solution { impulse, velocity, beta: None, sigma: None, solver: "auto".into(), iterations: sweeps }))
}

/// The round from which on an answer may be good enough; the interior point of a convex law is not improved by repetition.
fn patience(law: Law) -> usize {
    if law == Law::Associated { 1 } else { PATIENT_ROUNDS }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::scenes::named;
    use crate::schemes::{Anitescu, MoreauJean, Scheme, StewartTrinkle, run};
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    /// Certifies every answer and keeps the largest number of sweeps.
    #[derive(Default)]
    struct Certified(AtomicUsize);

    impl ContactSolver for Certified {
        fn name(&self) -> &'static str {
            "certified"
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let solution = WithinStep.solve(problem, warm_start)?;
            let found = residuals(problem, &solution)?;
            assert!(found.natural_map <= GOOD_ENOUGH * found.natural_map_scale * problem.contacts() as f64, "{}: {found:?}", problem.name);
            self.0.fetch_max(solution.iterations, Relaxed);
            Ok(solution)
        }
    }

    #[test]
    fn every_step_of_a_stack_in_space_is_solved_by_a_bounded_number_of_sweeps() {
        for scheme in [&MoreauJean::default() as &dyn Scheme, &Anitescu, &StewartTrinkle::default()] {
            let (mechanism, start) = named("box-stack").and_then(|scene| scene.spatial_mechanism()).expect("built in");
            let solver = Certified::default();
            run(scheme, &solver, mechanism.as_ref(), start, 0.01, 20, |_, _| ()).expect("solved");
            assert!(solver.0.into_inner() <= ROUNDS * FIRST_SWEEPS, "{}", scheme.name());
        }
    }
}
