//! A solver that knows whether it was asked, for some schemes have an iteration of their own; where it refuses the problem of a step,
//! solvers that take it are named, as `moreau solve` names them.

use super::posed::in_name_of;
use crate::Result;
use crate::problem::{ContactProblem, Law, Solution};
use crate::solvers::{self, ContactSolver};
use nalgebra::DVector;
use std::sync::atomic::{AtomicBool, Ordering};

/// The same solver, with a note of being asked.
pub struct Asked<'a> {
    solver: &'a dyn ContactSolver,
    asked: AtomicBool,
}

impl<'a> Asked<'a> {
    /// Nobody has asked it yet.
    pub fn new(solver: &'a dyn ContactSolver) -> Self {
        Asked { solver, asked: AtomicBool::new(false) }
    }

    /// Whether a step has asked it.
    pub fn was_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}

impl ContactSolver for Asked<'_> {
    fn name(&self) -> &'static str {
        self.solver.name()
    }

    fn is_truncated(&self) -> bool {
        self.solver.is_truncated()
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        self.solver.with_tolerance(relative)
    }

    fn iteration_limit(&self) -> Option<usize> {
        self.solver.iteration_limit()
    }

    fn takes_start(&self) -> bool {
        self.solver.takes_start()
    }

    fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool {
        self.solver.takes(law, rows, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        self.asked.store(true, Ordering::Relaxed);
        let answer = self.solver.solve(problem, warm_start);
        answer.map_err(|error| solvers::ALL.with_cure(in_name_of(self.solver.name(), error), problem))
    }
}
