//! Contacts that all stick, and Newton's method from there.
//!
//! ```text
//!     (A r + q)_i = 0   at normal rows, and at tangential ones where μ > 0 ;     r_i = 0   at the others ;     ‖r‖ least
//!     A = W + R ,   q = u_free + shift
//! ```
//! Points that are opposite to each other but for an angle of 10⁻⁵ all but hold a stress of their own: W has an eigenvalue of 10⁻¹⁰ of the
//! largest or less, and impulses along its vector that are large, and well inside of their cones, stop what moves along it. A method that
//! goes by residuals creeps along that vector. With all rows at rest it is one linear system, solved by singular values.

use super::super::{ContactSolver, NonsmoothNewton};
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, SVD};

const NAME: &str = "stuck";

/// Whether it has few enough contacts.
pub(super) fn fits(problem: &ContactProblem) -> bool {
    problem.contacts() <= tolerance::CONTACTS_IN_SETS && NonsmoothNewton::fits(problem)
}

/// Contacts that all stick, or Newton's method from there where that leaves more than `stop` and has a better answer.
///
/// # Errors
/// A breakdown where the singular values do not come out as numbers.
pub(super) fn solve(problem: &ContactProblem, stop: f64) -> Result<Solution> {
    let impulse = impulses(problem).ok_or_else(|| Error::breakdown(NAME, "has no singular values made of numbers"))?;
    let (velocity, mut judge) = (problem.velocity(&impulse), Judge::default());
    let stuck = Solution::new(NAME, impulse, velocity, 1);
    let left = judge.look(problem, &stuck)?.relative();
    if left <= stop {
        return Ok(stuck);
    }
    let newton = NonsmoothNewton { steps: tolerance::STEPS_LEFT_OUT, starts: 1, tolerance: stop, ..Default::default() };
    let Ok(ended) = newton.solve(problem, Some(&stuck.impulse)) else { return Ok(stuck) };
    let is_better = judge.judge_prepared(problem, &ended)?.relative() < left || left.is_nan();
    Ok(if is_better { ended } else { stuck })
}

/// The impulses of least norm with which nothing moves at these rows \[N·s\], once improved by what they leave.
fn impulses(problem: &ContactProblem) -> Option<DVector<f64>> {
    let rows = problem.rows_per_contact();
    let rubs = |k: usize| problem.law().cone_friction(problem.friction()[k]) > 0.0;
    let held: Vec<usize> = (0..problem.rows()).filter(|row| row.is_multiple_of(rows) || rubs(row / rows)).collect();
    let soft = |i: usize, j: usize| if i == j { problem.row_compliance(held[i]) } else { 0.0 };
    let a = DMatrix::from_fn(held.len(), held.len(), |i, j| problem.entry(held[i], held[j]) + soft(i, j));
    let svd = SVD::try_new(a, true, true, f64::EPSILON, tolerance::SINGULAR_VALUE_STEPS * held.len())?;
    // smaller singular values are rounding of the largest
    let least = held.len() as f64 * f64::EPSILON * svd.singular_values.max();
    let mut impulse = DVector::zeros(problem.rows());
    for _ in 0..2 {
        let y = problem.law_velocity(&impulse);
        let step = svd.solve(&DVector::from_fn(held.len(), |i, _| -y[held[i]]), least).ok()?;
        held.iter().zip(&step).for_each(|(row, step)| impulse[*row] += step);
    }
    impulse.iter().all(|r| r.is_finite()).then_some(impulse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Law;
    use crate::tolerance::solvers::{ENOUGH, STOP};
    use nalgebra::dvector;

    /// 1 kg between two walls whose normals are opposite but for the angle, which falls at 1 m/s along them and at 10⁻⁴ m/s into one.
    fn between(angle: f64, law: Law) -> ContactProblem {
        let (sin, cos) = angle.sin_cos();
        let h = DMatrix::from_row_slice(4, 2, &[1.0, 0.0, 0.0, 1.0, -cos, sin, sin, cos]);
        let free = &h * dvector![-1e-4, -1.0];
        ContactProblem::new(&h * h.transpose(), free).law(law).rows_per_contact(2).friction(vec![0.5; 2]).build().unwrap()
    }

    #[test]
    fn what_is_jammed_along_a_small_eigenvalue_is_solved_at_once() {
        for law in [Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 2 }] {
            for angle in [1e-2, 1e-4, 1e-6] {
                let problem = between(angle, law);
                let solution = solve(&problem, STOP).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(ENOUGH), "{law:?} {angle}");
            }
        }
    }

    #[test]
    fn rows_that_do_not_rub_are_not_held() {
        let free = dvector![-1.0, 3.0, 4.0, -2.0, 5.0, 6.0];
        let slippery = ContactProblem::new(DMatrix::identity(6, 6), free).friction(vec![0.0, 0.5]).build().unwrap();
        assert_eq!(impulses(&slippery).unwrap(), dvector![1.0, 0.0, 0.0, 2.0, -5.0, -6.0]);
    }

    #[test]
    fn what_rounding_alone_moves_takes_no_impulse() {
        let of = |least: f64| {
            let w = DMatrix::from_diagonal(&dvector![1.0, 0.0, least]);
            impulses(&ContactProblem::new(w, dvector![-1.0, -1.0, -least]).rows_per_contact(1).build().unwrap()).unwrap()
        };
        // three singular values, of which one is at least 3ε of the largest
        let border = 3.0 * f64::EPSILON;
        assert_eq!(of(0.5 * border), dvector![1.0, 0.0, 0.0]);
        assert!((of(2.0 * border) - dvector![1.0, 0.0, 1.0]).amax() < 1e-9);
    }
}
