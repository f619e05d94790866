//! Memory that solvers use again, from problem to problem and from step to step of a simulation.
//!
//! What is borrowed holds nothing of the problem before: whoever takes it prepares it, and no number depends on what it was used for. Each
//! thread has as many of them as solvers stand within each other, and those of large problems are not kept.

use super::contact_systems::ContactSystems;
use super::parts::resize;
use crate::certificate::Judge;
use crate::memory::spare::{self, Spare};
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::certificate::{HIDDEN, JAMMED};
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

impl Workspace {
    /// Proposes impulses \[N·s\], which may be changed before they are judged.
    pub fn propose(&mut self, impulse: &[f64]) -> &mut [f64] {
        resize(&mut self.answer.impulse, impulse.len());
        resize(&mut self.answer.velocity, impulse.len());
        self.answer.impulse.copy_from_slice(impulse);
        self.answer.impulse.as_mut_slice()
    }

    /// Computes the velocities of what is proposed, and tells whether a contact closes so fast that no scale of the certificate excuses it.
    ///
    /// ```text
    ///     y_n < −(10⁻⁵ + 10³ τ) V   ⟹   relative residual > τ ,       V = max |q| ,  q = u_free + shift
    /// ```
    /// For w ≤ y_n under every law with a round cone, s_n ≤ 10³ ρ_n V_I and floor ≤ 10⁻⁵ V_I, V_I = max |q| of the island, where q is not
    /// zero.
    pub fn closes(&mut self, problem: &ContactProblem, tolerance: f64) -> bool {
        let Workspace { answer, .. } = self;
        problem.write_velocity(answer.impulse.as_slice(), answer.velocity.as_mut_slice());
        let (rows, shift) = (problem.rows_per_contact(), problem.shift().as_slice());
        let data = || problem.free_velocity().as_slice().iter().zip(shift).map(|(free, shift)| (free + shift).abs());
        // none is NaN
        let most = (HIDDEN + JAMMED * tolerance) * data().fold(0.0, |most, q| if q > most { q } else { most });
        let is_given = |k: usize| data().skip(k * rows).take(rows).any(|q| q > 0.0);
        let (velocity, impulse) = (answer.velocity.as_slice(), answer.impulse.as_slice());
        let normal = |row: usize| velocity[row] + shift[row] + problem.row_compliance(row) * impulse[row];
        problem.law().directions().is_none() && (0..problem.contacts()).any(|k| normal(k * rows) < -most && is_given(k))
    }

    /// The largest relative residual of what is proposed, whose velocities are computed; infinite where it is not a number.
    pub fn relative(&mut self, problem: &ContactProblem) -> f64 {
        let Workspace { answer, .. } = self;
        problem.write_velocity(answer.impulse.as_slice(), answer.velocity.as_mut_slice());
        self.relative_as_it_is(problem)
    }

    /// [`Workspace::relative`] with velocities that are computed already.
    pub fn relative_as_it_is(&mut self, problem: &ContactProblem) -> f64 {
        let Workspace { judge, answer, .. } = self;
        let judged = judge.look(problem, answer).map_or(f64::INFINITY, |judged| judged.relative());
        if judged.is_nan() { f64::INFINITY } else { judged }
    }

    /// What was judged last, as the answer of a solver.
    pub fn answered(&self, solver: &str, iterations: usize) -> Solution {
        Solution::new(spare::text(solver), self.answer.impulse.copied(), self.answer.velocity.copied(), iterations)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use nalgebra::{DMatrix, DVector};

    /// n masses that fall onto the floor one by one.
    fn falling(n: usize, mass: f64) -> ContactProblem {
        let delassus = DMatrix::from_diagonal_element(n, n, 1.0 / mass);
        ContactProblem::new(delassus, DVector::from_element(n, -1.0)).rows_per_contact(1).build().unwrap()
    }

    #[test]
    fn nothing_of_the_problem_before_is_left_in_the_memory() {
        for (n, mass) in [(5, 1.0), (2, 4.0), (7, 0.5), (2, 1.0)] {
            let problem = falling(n, mass);
            for part in [1.0, 0.75] {
                let mut memory = borrow(&problem);
                memory.propose(&vec![part * mass; n]);
                let found = memory.relative(&problem);
                let answer = memory.answered("by hand", 3);
                assert_eq!(found, residuals(&problem, &answer).unwrap().judged.relative(), "{n} {mass} {part}");
                assert_eq!((found == 0.0, answer.velocity), (part == 1.0, DVector::from_element(n, part - 1.0)));
            }
        }
    }

    /// Two contacts that push against each other, so that the rounding of y grows with their impulses, and a third that stops what comes at
    /// 1 m/s.
    #[test]
    fn what_closes_is_no_solution_at_any_scale() {
        let normal = [[1.0, -1.0, 0.25], [-1.0, 1.0, -0.25], [0.25, -0.25, 1.0]];
        let (mut closes, mut answers) = (0, 0);
        for law in [crate::problem::Law::Coulomb, crate::problem::Law::Associated] {
            for (push, miss) in (0..16).flat_map(|size| (0..12).map(move |part| (10f64.powi(size - 2), 10f64.powi(-part)))) {
                let w = DMatrix::from_fn(6, 6, |row, column| match [row % 2, column % 2] {
                    [0, 0] => normal[row / 2][column / 2],
                    _ => f64::from(u8::from(row == column)),
                });
                let free = DVector::from_vec(vec![-miss - 0.25, 0.0, -miss + 0.25, 0.0, -1.0, 0.0]);
                let problem = ContactProblem::new(w, free).law(law).rows_per_contact(2).friction(vec![0.5; 3]).build().unwrap();
                let mut memory = borrow(&problem);
                memory.propose(&[push, 0.0, push, 0.0, 1.0, 0.0]);
                let is_closing = memory.closes(&problem, 1e-10);
                let relative = memory.relative_as_it_is(&problem);
                assert!(!is_closing || relative > 1e-10, "{law:?} {push:e} {miss:e}: {relative:e}");
                closes += usize::from(is_closing);
                answers += usize::from(relative <= 1e-10);
            }
        }
        assert!(closes > 40 && answers > 40, "{closes} {answers}");
    }

    #[test]
    fn a_solver_within_another_has_memory_of_its_own() {
        let problem = falling(3, 1.0);
        let mut outer = borrow(&problem);
        outer.propose(&[1.0; 3]);
        borrow(&problem).propose(&[0.0; 3]);
        assert_eq!(outer.relative(&problem), 0.0);
        let large = falling(KEPT + 1, 1.0);
        borrow(&large).propose(&vec![1.0; KEPT + 1]);
        drop(outer);
        assert!(borrow(&problem).answer.impulse.len() <= KEPT, "that of a large problem is not kept");
    }
}
