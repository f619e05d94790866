//! An answer from its impulses.

use moreau_contact::problem::{ContactProblem, Solution};
use nalgebra::DVector;

/// These impulses with the velocity that belongs to them.
pub fn answer(problem: &ContactProblem, impulse: DVector<f64>, iterations: usize) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new("auto", impulse, velocity, iterations)
}
