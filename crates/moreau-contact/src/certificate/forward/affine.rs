//! y = A r + b with every rounding bounded: A = W + R, b = u_free + shift.
//!
//! ```text
//!     y ∈ (ỹ_hi + ỹ_lo) ± e ,       e of the size ε² Σ|A r| + Σ E |r| ,       |y(X) − y(x)| ≤ (|A| + E) η  for  |X − x| ≤ η
//! ```
//! E bounds, entry by entry, how far the exact operator may be from the stored one: zero where the numbers of the problem are the problem,
//! `mechanism` where it is M̂ and H.

use crate::certificate::interval::{Interval, SMALLEST_EXACT, two_product, two_sum};
use crate::problem::ContactProblem;
use crate::tolerance::proof::{compensated, enlarged};
use nalgebra::DMatrix;

/// A and b at the rows of all contacts, and at the columns of those that press.
pub(super) struct Affine<'a> {
    problem: &'a ContactProblem,
    /// The rows that have an impulse: the columns of `matrix`.
    pub columns: Vec<usize>,
    /// A, all rows × columns, rounded.
    pub matrix: DMatrix<f64>,
    /// E, of the same shape.
    radius: Option<DMatrix<f64>>,
}

impl<'a> Affine<'a> {
    /// A at these columns; E is asked for one entry at a time.
    pub fn new(problem: &'a ContactProblem, columns: Vec<usize>, radius: Option<&DMatrix<f64>>) -> Self {
        let mut matrix = DMatrix::zeros(problem.rows(), columns.len());
        for (place, &column) in columns.iter().enumerate() {
            problem.delassus().for_each_in_column(column, |row, w| matrix[(row, place)] = w);
            matrix[(column, place)] += problem.row_compliance(column);
        }
        let radius = radius.map(|all| DMatrix::from_fn(problem.rows(), columns.len(), |row, place| all[(row, columns[place])]));
        Affine { problem, columns, matrix, radius }
    }

    /// y of these impulses, one per column.
    pub fn at(&self, impulse: &[f64]) -> Vec<Interval> {
        let (problem, n) = (self.problem, self.columns.len() + 3);
        let mut sums: Vec<Sum> = problem.free_velocity().iter().zip(problem.shift()).map(|(free, shift)| Sum::of(*free, *shift)).collect();
        for (&column, &r) in self.columns.iter().zip(impulse).filter(|(_, r)| **r != 0.0) {
            problem.delassus().for_each_in_column(column, |row, w| sums[row].add_product(w, r));
            sums[column].add_product(problem.row_compliance(column), r);
        }
        let sizes: Vec<f64> = impulse.iter().map(|r| r.abs()).collect();
        let unknown = self.uncertain(&sizes);
        sums.iter().zip(unknown).map(|(sum, unknown)| sum.enclosed(n) + Interval::ball(0.0, unknown)).collect()
    }

    /// (|A| + E) η, at least.
    pub fn spread(&self, radius: &[f64]) -> Vec<f64> {
        let certain = times(&self.matrix, radius);
        certain.iter().zip(self.uncertain(radius)).map(|(a, e)| if e == 0.0 { *a } else { enlarged(a + e, 2) }).collect()
    }

    /// E η, at least.
    pub fn uncertain(&self, radius: &[f64]) -> Vec<f64> {
        self.radius.as_ref().map_or_else(|| vec![0.0; self.problem.rows()], |matrix| times(matrix, radius))
    }
}

/// |matrix| x for x ≥ 0, rounded up.
pub(in crate::certificate) fn times(matrix: &DMatrix<f64>, x: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; matrix.nrows()];
    for (column, x) in matrix.column_iter().zip(x).filter(|(_, x)| **x != 0.0) {
        sums.iter_mut().zip(column.iter()).for_each(|(sum, entry)| *sum += entry.abs() * x);
    }
    sums.into_iter().map(|sum| if sum == 0.0 { 0.0 } else { enlarged(sum, matrix.ncols()) }).collect()
}

/// A sum of products with the errors of all its operations.
struct Sum {
    high: f64,
    low: f64,
    magnitude: f64,
    /// Whether some operation was rounded.
    rounded: bool,
}

impl Sum {
    fn of(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Sum { high, low, magnitude: a.abs() + b.abs(), rounded: false }
    }

    fn add_product(&mut self, a: f64, b: f64) {
        if a == 0.0 || b == 0.0 {
            return;
        }
        let (product, error) = two_product(a, b);
        let (sum, rounded) = two_sum(self.high, product);
        self.high = sum;
        self.low += error + rounded;
        self.magnitude += product.abs();
        self.rounded |= error != 0.0 || rounded != 0.0 || product.abs() < SMALLEST_EXACT;
    }

    fn enclosed(&self, terms: usize) -> Interval {
        let sum = Interval::point(self.high) + Interval::point(self.low);
        if self.rounded { sum + Interval::ball(0.0, compensated(terms, self.magnitude)) } else { sum }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, exact};
    use nalgebra::DVector;

    #[test]
    fn the_velocities_are_around_those_in_fractions_and_narrower_than_rounding() {
        let w = DMatrix::from_fn(6, 6, |i, j| 1.0 / (1.0 + i as f64 + j as f64));
        let free = DVector::from_fn(6, |i, _| -0.1 * i as f64);
        let problem = ContactProblem::new(w.clone(), free.clone()).friction(vec![0.3, 0.4]).build().unwrap();
        let impulse = [1.0 / 3.0, -0.7, 11.0, 1e-9, -3.0, 0.1];
        let affine = Affine::new(&problem, (0..6).collect(), None);
        for (row, y) in affine.at(&impulse).into_iter().enumerate() {
            let terms = impulse.iter().enumerate().map(|(j, r)| exact(w[(row, j)]) * exact(*r));
            let value = terms.fold(exact(free[row]), |sum: Rational, term| sum + term);
            assert!(exact(y.low) <= value && value <= exact(y.high), "{row}");
            assert!(y.high - y.low <= 4.0 * f64::EPSILON * y.magnitude(), "{row} {y:?}");
        }
        let moved: Vec<f64> = affine.spread(&[1e-3; 6]);
        assert!((0..6).all(|row| exact(moved[row]) >= (0..6).map(|j| exact(w[(row, j)]) * exact(1e-3)).fold(exact(0.0), |a, b| a + b)));
    }
}
