//! Anderson's acceleration of a fixed-point iteration x ← G(x), f(x) = G(x) − x.
//!
//! ```text
//!     x⁺ = G(x) − Σ γ_i ΔG_i ,   γ = argmin ‖f(x) − Σ γ_i ΔF_i‖ ,       s(x⁺) = s(G(x)) − Σ γ_i Δs(G)_i
//! ```
//! with the differences ΔG_i, ΔF_i of the last few steps. Where G is affine this is GMRES in disguise; the sweeps of a contact solver are
//! affine as long as no contact changes between open, sticking and sliding, and are slow there exactly when many sweeps carry
//! information through a pile. A state s that is an affine function of x, such as y = W r + q, is extrapolated with the same γ: it costs no
//! product with W.
//!
//! A step that made ‖f‖ larger is taken back: the iteration goes on from the last plain G(x), without memory. So every second
//! evaluation at least is a plain one where the acceleration does not help.
//!
//! # Source
//! Walker and Ni, *Anderson acceleration for fixed-point iterations*, SIAM J. Numer. Anal. 49 (2011).

use crate::tolerance::solvers::DEPENDENT;
use nalgebra::DVector;
use std::collections::VecDeque;

/// A point and its state.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point {
    pub x: DVector<f64>,
    pub state: DVector<f64>,
}

impl Point {
    fn minus(&self, other: &Point) -> Point {
        Point { x: &self.x - &other.x, state: &self.state - &other.state }
    }
}

/// The memory of the acceleration.
pub(super) struct Anderson {
    memory: usize,
    /// (ΔF, ΔG), the newest first.
    differences: VecDeque<(DVector<f64>, Point)>,
    /// f and G(x) of the last step.
    last: Option<(DVector<f64>, Point)>,
}

impl Anderson {
    pub(super) fn new(memory: usize) -> Self {
        Anderson { memory, differences: VecDeque::new(), last: None }
    }

    /// Forgets all steps.
    pub(super) fn forget(&mut self) {
        self.differences.clear();
        self.last = None;
    }

    /// The next point after G has been evaluated at x.
    pub(super) fn next(&mut self, x: &DVector<f64>, image: &Point) -> Point {
        let residual = &image.x - x;
        if let Some((last_residual, last_image)) = self.last.take() {
            let smaller = residual.norm() <= last_residual.norm(); // not of a residual that is not a number
            if !self.differences.is_empty() && !smaller {
                self.differences.clear();
                return last_image;
            }
            self.differences.push_front((&residual - last_residual, image.minus(&last_image)));
            self.differences.truncate(self.memory);
        }
        let mut next = image.clone();
        for ((_, moved), weight) in self.differences.iter().zip(self.weights(&residual)).filter(|(_, weight)| *weight != 0.0) {
            next.x.axpy(-weight, &moved.x, 1.0);
            next.state.axpy(-weight, &moved.state, 1.0);
        }
        self.last = Some((residual, image.clone()));
        next
    }

    /// γ by orthogonalising the ΔF, newest first, ΔF = E T with T upper triangular, T γ = Eᵀf; dependent ones have no weight.
    fn weights(&self, residual: &DVector<f64>) -> Vec<f64> {
        let mut rest = residual.clone();
        // of every difference that is kept: its number, its unit vector, its column of T and its part of f
        let mut kept: Vec<(usize, DVector<f64>, Vec<f64>, f64)> = Vec::with_capacity(self.differences.len());
        for (number, (difference, _)) in self.differences.iter().enumerate() {
            let (mut left, size) = (difference.clone(), difference.norm());
            let mut column = Vec::with_capacity(kept.len() + 1);
            for (_, unit, ..) in &kept {
                let part = unit.dot(&left);
                left.axpy(-part, unit, 1.0);
                column.push(part);
            }
            let length = left.norm();
            if length > DEPENDENT * size {
                left /= length;
                column.push(length);
                let part = left.dot(&rest);
                rest.axpy(-part, &left, 1.0);
                kept.push((number, left, column, part));
            }
        }
        let mut weights = vec![0.0; self.differences.len()];
        for place in (0..kept.len()).rev() {
            let known: f64 = kept[place + 1..].iter().map(|(number, _, column, _)| column[place] * weights[*number]).sum();
            let (number, _, column, part) = &kept[place];
            weights[*number] = (part - known) / column[place];
        }
        weights
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

    /// The state 3 x + 1 of a point.
    fn point(x: DVector<f64>) -> Point {
        let state = x.map(|x| 3.0 * x + 1.0);
        Point { x, state }
    }

    fn steps(memory: usize, limit: usize) -> usize {
        let mut x = DVector::from_fn(10, |k, _| (k as f64 + 1.0).sqrt());
        let mut anderson = Anderson::new(memory);
        for step in 0..limit {
            if x.norm() <= rounding(1000, 1.0) {
                return step;
            }
            let image = chain(&x);
            x = if memory == 0 {
                image
            } else {
                let next = anderson.next(&x, &point(image));
                assert!((&next.state - point(next.x.clone()).state).amax() <= rounding(1000, 16.0), "an affine state follows");
                next.x
            };
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
        let at = |x: f64| point(vector(x));
        anderson.next(&vector(0.0), &at(1.0));
        let second = anderson.next(&vector(1.0), &at(1.5));
        assert_eq!(second, at(2.0), "the secant step");
        // G(2) = 9 is a surprise: back to the last plain value, and no memory of it
        assert_eq!(anderson.next(&second.x, &at(9.0)), at(1.5));
        assert_eq!(anderson.next(&vector(1.5), &at(1.7)), at(1.7));
    }

    #[test]
    fn what_is_not_a_number_is_taken_back_too() {
        let mut anderson = Anderson::new(4);
        let vector = |x: f64| DVector::from_element(1, x);
        let at = |x: f64| point(vector(x));
        anderson.next(&vector(0.0), &at(1.0));
        let second = anderson.next(&vector(1.0), &at(1.5));
        assert_eq!(anderson.next(&second.x, &at(f64::NAN)), at(1.5));
    }
}
