//! What planted engines are made of: Moreau–Jean with one part exchanged, solvers that are functions.

use crate::Engine;
use crate::own::{Mechanics, OwnEngine, by_name};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver, SolverEntry, Solvers};
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
pub(super) struct Answers(pub moreau_checks::answers::Answers);

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
