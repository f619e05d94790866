//! How often all of W is gone through: work that is the same on every machine, where times are not.
//!
//! ```text
//!     one pass     W r for one r, or one sweep, which changes the impulse of every contact once
//! ```
//! Counted are the products of the operator for a whole r and the sweeps of `pgs` and `psor`; what goes through W contact by contact
//! elsewhere, or through |W|, is not.
//! What factorises W does its work elsewhere: its passes say nothing of it. Passes are counted on the thread that makes them; a sweep in
//! several threads is one pass of the thread that waits for it.

use std::cell::Cell;

thread_local! {
    static PASSES: Cell<usize> = const { Cell::new(0) };
}

/// Runs `work` on this thread, with the number of passes through W that are counted.
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::operator::passes::counted;
/// use moreau_contact::prelude::*;
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// assert_eq!(counted(|| block.velocity(&dvector![1.0, -0.5])), (dvector![0.0, 1.5], 1));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = PASSES.get();
    let result = work();
    (result, PASSES.get() - before)
}

/// Notes a pass.
#[inline]
pub(crate) fn note() {
    PASSES.set(PASSES.get().wrapping_add(1));
}

#[cfg(test)]
mod tests {
    use super::counted;
    use crate::operator::{BlockRows, MatrixFree};
    use crate::problem::{ContactProblem, Law};
    use crate::solvers::{AcceleratedProjectedGradient, ContactSolver, ProjectedGaussSeidel, ProjectedOverRelaxation};
    use nalgebra::{DMatrix, DVector};

    /// A chain of seven bodies in which each meets the next, W by bodies and as a square matrix.
    fn chains(law: Law) -> [ContactProblem; 2] {
        let number = |seed: usize| ((seed.wrapping_mul(2_654_435_761) >> 7) % 1000) as f64 / 500.0 - 1.0;
        let mut rows = BlockRows::new(3, vec![6; 7]).expect("rows");
        for k in 0..6 {
            let block = |side: usize| -> [f64; 18] { std::array::from_fn(|place| number(36 * k + 18 * side + place)) };
            rows.push(&[(k, &block(0)), (k + 1, &block(1))]).expect("a contact");
        }
        let free = DVector::from_fn(18, |row, _| number(7 * row + 3) - if row % 3 == 0 { 0.5 } else { 0.0 });
        let operator = MatrixFree::new(&vec![DMatrix::identity(6, 6); 7], rows).expect("an operator");
        let bodies = ContactProblem::new(operator, free).law(law).friction(vec![0.5; 6]).build().expect("a problem");
        let dense = bodies.clone().into_builder().delassus(bodies.dense().clone()).build().expect("a problem");
        [bodies, dense]
    }

    fn passes(solver: &dyn ContactSolver, problem: &ContactProblem) -> [usize; 2] {
        let (answer, passes) = counted(|| solver.solve(problem, None));
        [answer.expect("an answer").iterations, passes]
    }

    #[test]
    fn a_gradient_makes_one_pass_and_a_relaxation_two() {
        for problem in chains(Law::Associated) {
            let [iterations, found] = passes(&AcceleratedProjectedGradient { iterations: 30, ..Default::default() }, &problem);
            // one for the start and one for u of the answer
            assert!(iterations > 2 && found == iterations + 2, "{iterations}: {found}");
            let [iterations, found] = passes(&ProjectedOverRelaxation { sweeps: 20, ..Default::default() }, &problem);
            // the residual afresh before every sweep and after the last one, and u of the answer
            assert!(iterations > 2 && found == 2 * iterations + 2, "{iterations}: {found}");
        }
    }

    #[test]
    fn sweeps_over_bodies_and_over_entries_are_as_many_passes() {
        for law in [Law::Associated, Law::Coulomb] {
            let found = chains(law).map(|problem| passes(&ProjectedGaussSeidel { sweeps: 7, ..Default::default() }, &problem));
            assert_eq!(found[0], found[1]);
            // y of the start and u of the answer, and looks at the residual that grow apart: after the sweeps 1, 2 and 4 of seven
            let [sweeps, passes] = found[0];
            let looks = [1, 1, 2, 2, 3, 3, 3][sweeps - 1];
            assert_eq!(passes, sweeps + 2 + looks, "{law:?}");
        }
    }
}
