//! Newton's method on min(z, M z + q) = 0, kept from cycling.
//!
//! ```text
//!     α = {i : zᵢ > wᵢ} ,   M_αα z_α = −q_α ,   z = 0 elsewhere ,   w = M z + q
//! ```
//! Every row with a negative number changes sides at once. On some P-matrices of three rows and more that goes round in a circle (Ben
//! Gharbia and Gilbert, Math. Program. 134, 2012). So there are a few steps without fewer negative numbers than ever, and then the row of
//! greatest index alone changes sides, by which a P-matrix is sure to get there (Murty), until there are fewer.

use super::linear_form::Form;
use super::{ContactSolver, on_support};
use crate::problem::{ContactProblem, Law, Lcp, Solution};
use crate::tolerance::complementarity::{FULL_STEPS, NEWTON_MIN_STEPS, negligible};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Safeguarded Newton-min, for P-matrices.
///
/// # Source
/// J. J. Júdice, F. M. Pires, *A block principal pivoting algorithm for large-scale strictly monotone linear complementarity problems*,
/// Computers & Operations Research 21 (1994).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NewtonMin {
    /// Most steps.
    pub steps: usize,
}

impl Default for NewtonMin {
    fn default() -> Self {
        NewtonMin { steps: NEWTON_MIN_STEPS }
    }
}

const NAME: &str = "newton-min";

impl NewtonMin {
    /// z and the number of steps, from the support of a guess.
    ///
    /// # Errors
    /// [`Error::Solver`] if a basis is singular, which none of a P-matrix is, or after the limit of steps.
    pub fn solve_lcp(&self, lcp: &Lcp<f64>, mut support: Vec<bool>) -> Result<(DVector<f64>, usize)> {
        let (mut fewest, mut left) = (usize::MAX, FULL_STEPS);
        for steps in 0..=self.steps {
            if super::watch::is_over() {
                return Err(Error::limit(NAME, format!("was ended after {}", counted(steps, "step"))));
            }
            let z =
                on_support(lcp, &support).ok_or_else(|| Error::breakdown(NAME, "met a singular basis: M is no P-matrix; use `lemke`"))?;
            let negative = negative(lcp, &z, &support);
            let Some(&last) = negative.last() else { return Ok((z, steps)) };
            if negative.len() < fewest {
                (fewest, left) = (negative.len(), FULL_STEPS);
            } else {
                left = left.saturating_sub(1);
            }
            let changed = if left > 0 { &negative[..] } else { &[last] };
            changed.iter().for_each(|&i| support[i] = !support[i]);
        }
        Err(Error::limit(NAME, format!("made {}; use `lemke`", counted(self.steps, "step"))))
    }
}

/// The rows whose basic number is negative: z in the support, w elsewhere.
fn negative(lcp: &Lcp<f64>, z: &DVector<f64>, support: &[bool]) -> Vec<usize> {
    let w = lcp.slack(z);
    let floor = negligible::<f64>(lcp.size()) * z.amax().max(1.0);
    (0..lcp.size()).filter(|&i| if support[i] { z[i] < -floor } else { w[i] < -floor }).collect()
}

impl ContactSolver for NewtonMin {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law == Law::Frictionless
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let form = Form::frictionless(problem, NAME)?;
        let start = super::start_of_use(problem, warm_start)?;
        let lcp = form.lcp(problem, NAME)?;
        let rows = problem.rows_per_contact();
        let guess = start.as_slice().chunks_exact(rows).map(|contact| contact[0] > 0.0).collect();
        let scaled = form.scaled(problem, &lcp);
        let (z, steps) = self.solve_lcp(&scaled.lcp, guess)?;
        let support: Vec<bool> = z.iter().map(|z| *z > 0.0).collect();
        let z = scaled.on_support(&lcp, &support).ok_or_else(|| Error::breakdown(NAME, "ended on a singular basis; use `lemke`"))?;
        super::finite(form.solution(problem, &z, NAME, steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dmatrix, dvector};

    /// The supports that plain Newton-min goes through: all rows with a negative number change sides.
    fn plain(lcp: &Lcp<f64>, mut support: Vec<bool>, steps: usize) -> Vec<Vec<bool>> {
        let mut seen = vec![support.clone()];
        for _ in 0..steps {
            let z = on_support(lcp, &support).expect("a P-matrix");
            negative(lcp, &z, &support).iter().for_each(|&i| support[i] = !support[i]);
            seen.push(support.clone());
        }
        seen
    }

    #[test]
    fn the_p_matrix_of_three_rows_on_which_newton_min_cycles_is_solved() {
        // M = (1 0 a; a 1 0; 0 a 1), q = 1, a = 2: from {1} to {2} to {3} to {1}, and z = 0 is the solution
        let cycling = Lcp::new(dmatrix![1.0, 0.0, 2.0; 2.0, 1.0, 0.0; 0.0, 2.0, 1.0], dvector![1.0, 1.0, 1.0]);
        let seen = plain(&cycling, vec![true, false, false], 6);
        assert_eq!(seen[3], seen[0]);
        assert_eq!(seen[6], seen[0]);
        assert!(seen.iter().all(|support| support.iter().filter(|inside| **inside).count() == 1));
        let (z, steps) = NewtonMin::default().solve_lcp(&cycling, vec![true, false, false]).unwrap();
        assert_eq!(z, dvector![0.0, 0.0, 0.0]);
        assert!(steps > 3);
        // the same after an exchange of w₁ and z₁ cycles from z = 0, from where the solver starts
        let from_zero = Lcp::new(dmatrix![1.0, 0.0, -2.0; 2.0, 1.0, -4.0; 0.0, 2.0, 1.0], dvector![-1.0, -1.0, 1.0]);
        let seen = plain(&from_zero, vec![false; 3], 6);
        assert_eq!((&seen[3], &seen[6]), (&seen[0], &seen[0]));
        let problem = ContactProblem::new(from_zero.matrix, from_zero.vector).law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let answer = NewtonMin::default().solve(&problem, None).unwrap();
        assert_eq!(answer.impulse, dvector![1.0, 0.0, 0.0]);
    }

    #[test]
    fn a_singular_basis_is_a_breakdown_and_a_long_way_a_limit() {
        let singular = Lcp::new(DMatrix::from_element(2, 2, 1.0), dvector![-1.0, -1.0]);
        let message = NewtonMin::default().solve_lcp(&singular, vec![false; 2]).unwrap_err().to_string();
        assert!(message.contains("singular"), "{message}");
        let cycling = Lcp::new(dmatrix![1.0, 0.0, 2.0; 2.0, 1.0, 0.0; 0.0, 2.0, 1.0], dvector![1.0, 1.0, 1.0]);
        let message = NewtonMin { steps: 2 }.solve_lcp(&cycling, vec![true, false, false]).unwrap_err().to_string();
        assert!(message.contains("2 steps"), "{message}");
    }
}
