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

use super::parts::copy;
use crate::memory::spare::{self, Lent, spare_entries};
use crate::tolerance::sweeps::DEPENDENT_SQUARE;
use nalgebra::DVector;

/// A point and its state.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Point {
    pub x: Lent<DVector<f64>>,
    pub state: Lent<DVector<f64>>,
}

/// ΔF and ΔG of one step.
#[derive(Clone)]
struct Difference {
    residual: Lent<DVector<f64>>,
    image: Point,
}

spare_entries![Difference];

/// The memory of the acceleration; its vectors are used again and again.
pub(super) struct Anderson {
    memory: usize,
    /// As many as there were steps, at most `memory`, in no order.
    differences: Lent<Vec<Difference>>,
    /// The places in `differences` that are in use, the newest first.
    order: Lent<Vec<usize>>,
    /// ΔF_i · ΔF_j by places.
    gram: Lent<Vec<f64>>,
    /// f and G(x) of the last step.
    last: Option<(Lent<DVector<f64>>, Point)>,
    /// Memory of a last step that is forgotten.
    spare: Option<(Lent<DVector<f64>>, Point)>,
    /// Those of this step.
    residual: Lent<DVector<f64>>,
    /// γ, and what it is found with: rows of T and Eᵀf.
    weights: Lent<Vec<f64>>,
    triangle: Lent<Vec<f64>>,
}

impl Anderson {
    pub(super) fn new(memory: usize) -> Self {
        let (differences, order) = (spare::vector(memory).into(), spare::vector(memory + 1).into());
        let [gram, triangle, weights] = [memory * memory, memory * memory, memory].map(|size| spare::repeated(size, 0.0).into());
        Anderson { memory, differences, order, gram, last: None, spare: None, residual: Lent::default(), weights, triangle }
    }

    /// Forgets all steps.
    pub(super) fn forget(&mut self) {
        self.order.clear();
        self.spare = self.last.take().or(self.spare.take());
    }

    /// Replaces G(x), which has been evaluated at x, by the next point.
    pub(super) fn extrapolate(&mut self, x: &DVector<f64>, image: &mut Point) {
        copy(&image.x, &mut self.residual);
        *self.residual -= x;
        match self.last.take() {
            None => self.begin(image),
            Some((last_residual, last_image)) => {
                let smaller = self.residual.norm() <= last_residual.norm(); // not of a residual that is not a number
                if !self.order.is_empty() && !smaller {
                    self.order.clear();
                    copy(&last_image.x, &mut image.x);
                    copy(&last_image.state, &mut image.state);
                    self.spare = Some((last_residual, last_image));
                    return;
                }
                self.remember(last_residual, last_image, image);
            }
        }
        self.find_weights();
        for (&place, weight) in self.order.iter().zip(&**self.weights).filter(|(_, weight)| **weight != 0.0) {
            let moved = &self.differences[place].image;
            image.x.axpy(-weight, &moved.x, 1.0);
            image.state.axpy(-weight, &moved.state, 1.0);
        }
    }

    /// Keeps f and G(x) of a first step, in the place of what was forgotten.
    fn begin(&mut self, image: &Point) {
        let (mut residual, mut point) = self.spare.take().unwrap_or_default();
        copy(&self.residual, &mut residual);
        copy(&image.x, &mut point.x);
        copy(&image.state, &mut point.state);
        self.last = Some((residual, point));
    }

    /// Puts the differences from the last step in place of the oldest ones, and keeps f and G(x).
    fn remember(&mut self, mut last_residual: Lent<DVector<f64>>, mut last: Point, image: &Point) {
        if self.memory > 0 {
            let place = self.place(image);
            let Difference { residual, image: moved } = &mut self.differences[place];
            difference(residual, &self.residual, &last_residual);
            difference(&mut moved.x, &image.x, &last.x);
            difference(&mut moved.state, &image.state, &last.state);
            self.order.insert(0, place);
            for &other in self.order.iter() {
                let product = self.differences[place].residual.dot(&self.differences[other].residual);
                self.gram[place * self.memory + other] = product;
                self.gram[other * self.memory + place] = product;
            }
        }
        last_residual.copy_from(&self.residual);
        last.x.copy_from(&image.x);
        last.state.copy_from(&image.state);
        self.last = Some((last_residual, last));
    }

    /// A place for a new difference: a free one, or that of the oldest.
    fn place(&mut self, image: &Point) -> usize {
        if self.order.len() == self.memory {
            return self.order.pop().expect("there are as many as the memory, at least one");
        }
        if let Some(free) = (0..self.differences.len()).find(|place| !self.order.contains(place)) {
            return free;
        }
        self.differences.push(Difference { residual: self.residual.clone(), image: image.clone() });
        self.differences.len() - 1
    }

    /// γ from the normal equations ΔFᵀΔF γ = ΔFᵀf by ΔFᵀΔF = TᵀT, newest first; dependent ones have no weight.
    fn find_weights(&mut self) {
        let (n, m) = (self.order.len(), self.memory);
        let Anderson { differences, order, gram, residual, weights, triangle, .. } = self;
        // row i of `triangle` is column i of T; a dependent one has a zero on the diagonal
        for i in 0..n {
            let of = |j: usize| gram[order[i] * m + order[j]];
            let mut square = of(i);
            let mut part = differences[order[i]].residual.dot(residual);
            for j in 0..i {
                let diagonal = triangle[j * m + j];
                let known: f64 = (0..j).map(|l| triangle[i * m + l] * triangle[j * m + l]).sum();
                let entry = if diagonal > 0.0 { (of(j) - known) / diagonal } else { 0.0 };
                triangle[i * m + j] = entry;
                square -= entry * entry;
                part -= entry * weights[j];
            }
            let independent = square > DEPENDENT_SQUARE * of(i);
            triangle[i * m + i] = if independent { square.sqrt() } else { 0.0 };
            weights[i] = if independent { part / triangle[i * m + i] } else { 0.0 };
        }
        for i in (0..n).rev() {
            let diagonal = triangle[i * m + i];
            if diagonal > 0.0 {
                let known: f64 = (i + 1..n).map(|j| triangle[j * m + i] * weights[j]).sum();
                weights[i] = (weights[i] - known) / diagonal;
            }
        }
    }
}

/// into = a − b.
fn difference(into: &mut DVector<f64>, a: &DVector<f64>, b: &DVector<f64>) {
    into.copy_from(a);
    *into -= b;
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
        Point { x: x.into(), state: state.into() }
    }

    /// The next point in place of G(x).
    fn next(anderson: &mut Anderson, x: &DVector<f64>, mut image: Point) -> Point {
        anderson.extrapolate(x, &mut image);
        image
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
                let next = next(&mut anderson, &x, point(image));
                assert!((&*next.state - &*point((*next.x).clone()).state).amax() <= rounding(1000, 16.0), "an affine state follows");
                next.x.into_inner()
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
        next(&mut anderson, &vector(0.0), at(1.0));
        let second = next(&mut anderson, &vector(1.0), at(1.5));
        assert_eq!(second, at(2.0), "the secant step");
        // G(2) = 9 is a surprise: back to the last plain value, and no memory of it
        assert_eq!(next(&mut anderson, &second.x, at(9.0)), at(1.5));
        assert_eq!(next(&mut anderson, &vector(1.5), at(1.7)), at(1.7));
    }

    #[test]
    fn what_is_not_a_number_is_taken_back_too() {
        let mut anderson = Anderson::new(4);
        let vector = |x: f64| DVector::from_element(1, x);
        let at = |x: f64| point(vector(x));
        next(&mut anderson, &vector(0.0), at(1.0));
        let second = next(&mut anderson, &vector(1.0), at(1.5));
        assert_eq!(next(&mut anderson, &second.x, at(f64::NAN)), at(1.5));
    }
}
