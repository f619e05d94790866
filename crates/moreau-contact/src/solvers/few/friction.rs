//! A few contacts under Coulomb's law: sweeps until they tell which contacts press, stick and slide, and Newton's method from there.
//!
//! A contact is prepared when it closes first; where all stay open but one or two, little is done.

use super::contacts::Contacts;
use super::newton;
use super::parts::MOST;
use crate::cones::second_order::tangential_norm;
use crate::problem::{ContactProblem, Solution};
use crate::solvers::{watch, workspace};
use crate::tolerance::newton::{FEW_NEWTON_STEPS, FEW_ROUNDS, FEW_SWEEPS_BEFORE};
use crate::tolerance::solvers::NONSMOOTH_PROXIMALS;
use nalgebra::DVector;

/// Rows of five contacts in space, and one; more take the larger system.
const SHORT: usize = 16;
const LONG: usize = 3 * MOST;

/// The answer by sweeps and Newton's method.
pub(super) fn solve<const D: usize>(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64, enough: f64) -> Option<Solution> {
    let mut contacts = Contacts::<D>::new(problem, start);
    let mut iterations = 0;
    for round in 0..FEW_ROUNDS {
        for _ in 0..FEW_SWEEPS_BEFORE << (2 * round) {
            let change = contacts.sweep(problem)?;
            iterations += 1;
            let is_due = contacts.count == 1 || change <= stop * contacts.largest();
            if let Some(found) = is_due.then(|| contacts.judged(problem, "pgs", iterations, stop)).flatten() {
                return Some(found);
            }
        }
        let before = (contacts.impulse, contacts.velocity);
        if let Some(found) = contacts.newton(problem, &mut iterations, [stop, enough]) {
            return Some(found);
        }
        (contacts.impulse, contacts.velocity) = before;
    }
    None
}

impl<const D: usize> Contacts<D> {
    /// The answer, if its residual is at most this.
    fn judged(&self, problem: &ContactProblem, name: &str, iterations: usize, most: f64) -> Option<Solution> {
        let mut memory = workspace::borrow(problem);
        let impulse = memory.propose(self.impulse[..self.count].as_flattened());
        impulse.chunks_exact_mut(D).zip(problem.friction()).for_each(|(r, mu)| take_back(r, *mu));
        let relative = memory.relative(problem);
        watch::note(relative);
        (relative <= most).then(|| memory.answered(name, iterations))
    }

    fn newton(&mut self, problem: &ContactProblem, iterations: &mut usize, [stop, enough]: [f64; 2]) -> Option<Solution> {
        let proximals = NONSMOOTH_PROXIMALS[0];
        for taken in 0..FEW_NEWTON_STEPS {
            let step = self.begin(problem)?;
            let is_due = step.residual <= stop * self.largest();
            if let Some(found) = is_due.then(|| self.judged(problem, "nonsmooth-newton", *iterations, stop)).flatten() {
                return Some(found);
            }
            let proximal = proximals[taken.min(proximals.len() - 1)];
            if step.count * D <= SHORT {
                self.take(problem, &step, newton::step::<D, SHORT>(problem, self, &step, [proximal, stop])?);
            } else {
                self.take(problem, &step, newton::step::<D, LONG>(problem, self, &step, [proximal, stop])?);
            }
            *iterations += 1;
        }
        self.judged(problem, "nonsmooth-newton", *iterations, enough)
    }
}

/// Takes back the friction that Newton's method leaves beyond the disk of radius μ r_n.
fn take_back(impulse: &mut [f64], friction: f64) {
    let (radius, reach) = (friction * impulse[0].max(0.0), tangential_norm(impulse));
    if reach > radius {
        impulse[1..].iter_mut().for_each(|r| *r *= radius / reach);
    }
}
