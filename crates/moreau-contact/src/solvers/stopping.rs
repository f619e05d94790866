//! When an iteration may stop, and how good an answer is on the way: the certificate's own measure of the worst contact.

use super::parts::copy;
use super::watch;
use super::workspace::{self, Borrowed, Workspace};
use crate::problem::ContactProblem;
use crate::tolerance::solvers::{FRESH_ROUNDING, NEAR_SOLUTION, SAME_SIZE};
use nalgebra::DVector;

/// The largest relative residual over the contacts is at most `relative`; what is rounding counts as 0.
pub(super) struct Stopping<'a> {
    problem: &'a ContactProblem,
    memory: Borrowed,
    relative: f64,
    calls: usize,
    /// The largest impulse at which the rounding of y was computed last \[N·s\].
    sized: f64,
}

impl<'a> Stopping<'a> {
    pub(super) fn new(problem: &'a ContactProblem, relative: f64) -> Self {
        let mut memory = workspace::borrow(problem);
        memory.judge.prepare(problem);
        Stopping { problem, memory, relative, calls: 0, sized: 0.0 }
    }

    /// Whether (r, y = u_free + shift + (W + R) r) is a solution up to the tolerance, or the caller ends the iteration.
    pub(super) fn holds(&mut self, impulse: &DVector<f64>, law_velocity: &DVector<f64>) -> bool {
        self.relative(impulse, law_velocity) <= self.relative || watch::is_over()
    }

    /// The largest relative residual over the contacts, infinite where it is not a number.
    ///
    /// The rounding of y costs a pass over W. It is taken from an earlier call where the residual is large, or where it is above the
    /// tolerance and the impulses are still of one size, on which alone that rounding depends; and now and then it is taken anew.
    pub(super) fn relative(&mut self, impulse: &DVector<f64>, law_velocity: &DVector<f64>) -> f64 {
        let measured = self.evaluate(impulse, law_velocity);
        watch::note(measured);
        measured
    }

    fn evaluate(&mut self, impulse: &DVector<f64>, law_velocity: &DVector<f64>) -> f64 {
        copy(impulse, &mut self.memory.answer.impulse);
        self.calls += 1;
        if self.calls % FRESH_ROUNDING != 1 {
            let measured = self.measure(law_velocity);
            let size = impulse.amax();
            let same = size <= SAME_SIZE * self.sized && self.sized <= SAME_SIZE * size;
            if measured > NEAR_SOLUTION || (measured > self.relative && same) {
                return measured;
            }
        }
        self.sized = impulse.amax();
        self.memory.judge.set_floors(self.problem, impulse.as_slice());
        self.measure(law_velocity)
    }

    fn measure(&mut self, law_velocity: &DVector<f64>) -> f64 {
        let Workspace { judge, answer, .. } = &mut *self.memory;
        let measured = judge.measure(self.problem, answer, law_velocity.as_slice());
        measured.ok().filter(|relative| !relative.is_nan()).unwrap_or(f64::INFINITY)
    }
}
