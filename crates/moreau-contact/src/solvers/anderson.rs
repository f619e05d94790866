//! Anderson's acceleration of a fixed-point iteration x ← G(x), f(x) = G(x) − x.
//!
//! ```text
//!     x⁺ = G(x) − Σ γ_i ΔG_i ,   γ = argmin ‖f(x) − Σ γ_i ΔF_i‖ ,
//! ```
//! with the differences ΔG_i, ΔF_i of the last few steps. Where G is affine this is GMRES in disguise; the sweeps of a contact solver are
//! affine as long as no contact changes between open, sticking and sliding, and are slow there exactly when many sweeps carry
//! information through a pile.
//!
//! A step that made ‖f‖ larger is taken back: the iteration goes on from the last plain G(x), without memory. So every second
//! evaluation at least is a plain one where the acceleration does not help.
//!
//! # Source
//! Walker and Ni, *Anderson acceleration for fixed-point iterations*, SIAM J. Numer. Anal. 49 (2011).

use crate::tolerance::solvers::DEPENDENT;
use nalgebra::DVector;
use std::collections::VecDeque;

/// The memory of the acceleration.
pub(super) struct Anderson {
    memory: usize,
    /// (ΔF, ΔG), the newest first.
    differences: VecDeque<(DVector<f64>, DVector<f64>)>,
    /// f and G(x) of the last step.
    last: Option<(DVector<f64>, DVector<f64>)>,
}

impl Anderson {
    pub(super) fn new(memory: usize) -> Self {
        Anderson { memory, differences: VecDeque::new(), last: None }
    }

    /// The next x after G has been evaluated at x.
    pub(super) fn next(&mut self, x: &DVector<f64>, image: &DVector<f64>) -> DVector<f64> {
        let residual = image - x;
        if let Some((last_residual, last_image)) = self.last.take() {
            let smaller = residual.norm() <= last_residual.norm(); // not of a residual that is not a number
            if !self.differences.is_empty() && !smaller {
                self.differences.clear();
                return last_image;
            }
            self.differences.push_front((&residual - last_residual, image - last_image));
            self.differences.truncate(self.memory);
        }
        let next = self.extrapolate(&residual, image);
        self.last = Some((residual, image.clone()));
        next
    }

    /// Least squares by orthogonalising the ΔF, newest first; dependent ones are left out.
    fn extrapolate(&self, residual: &DVector<f64>, image: &DVector<f64>) -> DVector<f64> {
        let (mut rest, mut next) = (residual.clone(), image.clone());
        let mut basis: Vec<(DVector<f64>, DVector<f64>)> = Vec::with_capacity(self.differences.len());
        for (difference, moved) in &self.differences {
            let (mut difference, mut moved) = (difference.clone(), moved.clone());
            let size = difference.norm();
            for (known, known_moved) in &basis {
                let part = known.dot(&difference);
                difference.axpy(-part, known, 1.0);
                moved.axpy(-part, known_moved, 1.0);
            }
            let left = difference.norm();
            if left > DEPENDENT * size {
                difference /= left;
                moved /= left;
                let part = difference.dot(&rest);
                rest.axpy(-part, &difference, 1.0);
                next.axpy(-part, &moved, 1.0);
                basis.push((difference, moved));
            }
        }
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    /// x ← x − ½ A x / ‖A‖ for the chain Laplacian of ten links: plain sweeps need thousands of steps.
    fn chain(x: &DVector<f64>) -> DVector<f64> {
        let at = |k: isize| if (0..10).contains(&k) { x[k as usize] } else { 0.0 };
        DVector::from_fn(10, |k, _| x[k] - 0.25 * (2.0 * x[k] - at(k as isize - 1) - at(k as isize + 1)))
    }

    fn steps(memory: usize, limit: usize) -> usize {
        let mut x = DVector::from_fn(10, |k, _| (k as f64 + 1.0).sqrt());
        let mut anderson = Anderson::new(memory);
        for step in 0..limit {
            if x.norm() <= rounding(1000, 1.0) {
                return step;
            }
            let image = chain(&x);
            x = if memory == 0 { image } else { anderson.next(&x, &image) };
        }
        limit
    }

    #[test]
    fn an_affine_iteration_in_ten_unknowns_ends_after_about_ten_steps() {
        let (accelerated, plain) = (steps(10, 5000), steps(0, 5000));
        assert!(accelerated <= 20 && plain > 500, "{accelerated} against {plain}");
    }

    #[test]
    fn a_step_that_makes_matters_worse_is_taken_back() {
        let mut anderson = Anderson::new(4);
        let vector = |x: f64| DVector::from_element(1, x);
        anderson.next(&vector(0.0), &vector(1.0));
        let second = anderson.next(&vector(1.0), &vector(1.5));
        assert_eq!(second, vector(2.0), "the secant step");
        // G(2) = 9 is a surprise: back to the last plain value, and no memory of it
        assert_eq!(anderson.next(&second, &vector(9.0)), vector(1.5));
        assert_eq!(anderson.next(&vector(1.5), &vector(1.7)), vector(1.7));
    }

    #[test]
    fn what_is_not_a_number_is_taken_back_too() {
        let mut anderson = Anderson::new(4);
        let vector = |x: f64| DVector::from_element(1, x);
        anderson.next(&vector(0.0), &vector(1.0));
        let second = anderson.next(&vector(1.0), &vector(1.5));
        assert_eq!(anderson.next(&second, &vector(f64::NAN)), vector(1.5));
    }
}
