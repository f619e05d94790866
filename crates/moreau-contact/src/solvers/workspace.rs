//! Memory that solvers use again, from problem to problem and from step to step of a simulation.
//!
//! What is borrowed holds nothing of the problem before: whoever takes it prepares it, and no number depends on what it was used for. Each
//! thread has as many of them as solvers stand within each other, and those of large problems are not kept.

use super::contact_systems::ContactSystems;
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::solvers::KEPT;
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::{Deref, DerefMut};

/// What one solver works with.
pub(super) struct Workspace {
    pub judge: Judge,
    pub systems: ContactSystems,
    /// An answer on the way, to be judged.
    pub answer: Solution,
}

impl Default for Workspace {
    fn default() -> Self {
        let nothing = || DVector::zeros(0);
        Workspace { judge: Judge::default(), systems: ContactSystems::default(), answer: Solution::new("", nothing(), nothing(), 0) }
    }
}

thread_local! {
    #[expect(clippy::vec_box, reason = "a workspace is taken out and put back at every solve, and is large")]
    static FREE: RefCell<Vec<Box<Workspace>>> = const { RefCell::new(Vec::new()) };
}

/// A workspace for as long as it is held.
pub(super) struct Borrowed {
    /// There until the end.
    own: Option<Box<Workspace>>,
    is_kept: bool,
}

/// A workspace for this problem.
pub(super) fn borrow(problem: &ContactProblem) -> Borrowed {
    let is_kept = problem.contacts() <= KEPT;
    let own = if is_kept { FREE.with_borrow_mut(Vec::pop) } else { None };
    Borrowed { own: Some(own.unwrap_or_default()), is_kept }
}

impl Drop for Borrowed {
    fn drop(&mut self) {
        if let Some(own) = self.own.take().filter(|_| self.is_kept) {
            // at the end of a thread there may be nothing left to give it back to
            let _ = FREE.try_with(|free| free.borrow_mut().push(own));
        }
    }
}

impl Deref for Borrowed {
    type Target = Workspace;

    fn deref(&self) -> &Workspace {
        self.own.as_ref().expect("it is there until the end")
    }
}

impl DerefMut for Borrowed {
    fn deref_mut(&mut self) -> &mut Workspace {
        self.own.as_mut().expect("it is there until the end")
    }
}
