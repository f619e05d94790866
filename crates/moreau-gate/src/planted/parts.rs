//! What planted engines are made of: Moreau–Jean with one part exchanged, solvers that are functions, schemes with one line changed.

use crate::Engine;
use crate::own::{Mechanics, OwnEngine, by_name};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver, SolverEntry, Solvers};
use moreau_dynamics::schemes::{MoreauJean, Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Moreau–Jean with one part exchanged; it still describes itself as Moreau–Jean.
pub(super) fn moreau_jean(change: impl FnOnce(&mut OwnEngine)) -> Box<dyn Engine> {
    let mut engine = by_name("moreau-jean").expect("a listed name");
    engine.certified = false;
    change(&mut engine);
    Box::new(engine)
}

/// Moreau–Jean with another solver.
pub(super) fn with_solver(default: fn() -> Box<dyn ContactSolver>) -> Box<dyn Engine> {
    moreau_jean(|engine| engine.solvers = Solvers::of(&[SolverEntry { name: "auto", default, limited: None }]))
}

/// Moreau–Jean of a scene that was misread.
pub(super) fn with_mechanism(mechanism: Mechanics) -> Box<dyn Engine> {
    moreau_jean(|engine| engine.mechanism = mechanism)
}

/// A solver that is a function of the problem and the impulses to start from; polyhedral laws are left to the reference.
pub(super) struct Answers(pub fn(&ContactProblem, &DVector<f64>) -> Result<Solution>);

impl ContactSolver for Answers {
    /// The name of the solver it stands in for.
    fn name(&self) -> &'static str {
        "auto"
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.law().directions().is_some() {
            return Auto.solve(problem, warm_start);
        }
        let start = warm_start.cloned().unwrap_or_else(|| DVector::zeros(problem.rows()));
        let solution = (self.0)(problem, &start)?;
        let finite = solution.impulse.iter().chain(&solution.velocity).all(|x| x.is_finite());
        if finite { Ok(solution) } else { Err(Error::breakdown("auto", "ended with impulses that are not finite")) }
    }
}

/// These impulses with the velocity that belongs to them.
pub(super) fn answer(problem: &ContactProblem, impulse: DVector<f64>, iterations: usize) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new("auto", impulse, velocity, iterations)
}

/// Gauss–Seidel row by row: r_i ← r_i − y_i/W_ii, then the contact's impulse is limited.
pub(super) fn row_by_row(problem: &ContactProblem, start: &DVector<f64>, sweeps: usize, limit: fn(&mut [f64], f64)) -> DVector<f64> {
    let rows = problem.rows_per_contact();
    let mut impulse = start.clone();
    for _ in 0..sweeps {
        for i in 0..problem.rows() {
            let y = problem.dense().row(i).tr_dot(&impulse) + problem.free_velocity()[i] + problem.shift()[i];
            if problem.entry(i, i) > 0.0 {
                impulse[i] -= y / problem.entry(i, i);
            }
            let contact = i / rows;
            let mu = if problem.law() == moreau_contact::problem::Law::Frictionless { 0.0 } else { problem.friction()[contact] };
            limit(&mut impulse.as_mut_slice()[contact * rows..(contact + 1) * rows], mu);
        }
    }
    impulse
}

/// Moreau–Jean with what is assembled and how positions advance changed.
pub(super) struct Altered {
    /// Changes the velocity without contact, given h.
    pub free_velocity: fn(&mut DVector<f64>, f64),
    /// Changes the velocity that positions advance with.
    pub moving_velocity: fn(&mut DVector<f64>),
    /// Changes the new positions.
    pub position: fn(&mut DVector<f64>),
}

impl Altered {
    /// Nothing changed.
    pub(super) const NOTHING: Altered = Altered { free_velocity: |_, _| {}, moving_velocity: |_| {}, position: |_| {} };

    fn scheme() -> MoreauJean {
        MoreauJean::default()
    }
}

impl Scheme for Altered {
    fn name(&self) -> String {
        "moreau-jean".into()
    }

    passes_the_waist!();
}

impl Waist for Altered {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let h = at.h();
        let mut step = Altered::scheme().assemble(at)?;
        (self.free_velocity)(&mut step.free_velocity, h);
        if let Some(problem) = step.problem.take() {
            step.problem = Some(problem.into_builder().free_velocity(&step.jacobian * &step.free_velocity).build()?);
        }
        Ok(step)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let scheme = Altered::scheme();
        let mut velocity = velocity_post.clone();
        (self.moving_velocity)(&mut velocity);
        let mut position = scheme.advance(at, &velocity);
        (self.position)(&mut position);
        position
    }
}
