//! Every contact problem that a scheme poses is certified.
//!
//! [`Certified`] stands between a scheme and its solver, so that a step with many problems (events, stages, contacts that join) hands on
//! the worst of them. It judges answers and changes none.

use moreau_contact::certificate::{Judge, StepResidual};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::ContactSolver;
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A problem with the answer that its certificate rejects.
#[derive(Clone, Debug)]
pub struct Rejected {
    /// The problem.
    pub problem: ContactProblem,
    /// The answer.
    pub solution: Solution,
}

/// A solver whose every answer is certified.
pub struct Certified<'a> {
    solver: &'a dyn ContactSolver,
    tolerance: f64,
    found: Mutex<Found>,
}

#[derive(Default)]
struct Found {
    judge: Judge,
    worst: Option<StepResidual>,
    rejected: Option<Rejected>,
}

impl<'a> Certified<'a> {
    /// Certifies against the default tolerance of `moreau certify`.
    pub fn new(solver: &'a dyn ContactSolver) -> Self {
        Certified::with_tolerance(solver, CERTIFY)
    }

    /// Certifies against another tolerance.
    pub fn with_tolerance(solver: &'a dyn ContactSolver, tolerance: f64) -> Self {
        Certified { solver, tolerance, found: Mutex::default() }
    }

    /// Largest relative residual that is accepted.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The worst residual since the last call, and the first answer that was rejected.
    pub fn take(&self) -> (Option<StepResidual>, Option<Rejected>) {
        let mut found = self.found();
        (found.worst.take(), found.rejected.take())
    }

    fn found(&self) -> MutexGuard<'_, Found> {
        // what a panic of another thread leaves is a judgement between two answers: it can be used
        self.found.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ContactSolver for Certified<'_> {
    fn name(&self) -> &'static str {
        self.solver.name()
    }

    fn is_truncated(&self) -> bool {
        self.solver.is_truncated()
    }

    fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool {
        self.solver.takes(law, rows, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let mut solution = self.solver.solve(problem, warm_start)?;
        let mut found = self.found();
        let failed = |error: Error| Error::breakdown(self.name(), error.to_string());
        let mut worst = found.judge.judge_once(problem, &solution).map_err(failed)?.worst();
        let is_accepted = worst.1.part.relative() <= self.tolerance;
        if !is_accepted && found.judge.sharpen(problem, &mut solution).map_err(failed)? {
            worst = found.judge.judge(problem, &solution).map_err(failed)?.worst();
        }
        let ((residual, worst), relative) = (worst, worst.1.part.relative());
        let pair = problem.bodies().and_then(|bodies| bodies.get(worst.contact).copied());
        let own = StepResidual { rule: "certificate", residual, relative, limit: self.tolerance, contact: Some(worst.contact), pair };
        if !own.is_accepted() && found.rejected.is_none() {
            found.rejected = Some(Rejected { problem: problem.clone(), solution: solution.clone() });
        }
        found.worst = StepResidual::worse_of(found.worst, Some(own));
        Ok(solution)
    }
}
