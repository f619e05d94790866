//! A square linear system with intervals in it: whether it is regular, and all its solutions.
//!
//! ```text
//!     C ≈ mid(M)⁻¹ ,   |I − C M| v ≤ κ v ,  κ < 1 ,  v > 0        ⟹        every matrix in M is regular
//!     M x = b   ⟹   |x − x̃| ≤ g + τ |I − C M| v ,   g = |C (b − M x̃)| ,   τ = max_i g_i/v_i / (1 − κ)
//! ```
//! because x − x̃ = C (b − M x̃) + (I − C M)(x − x̃), whose size in the norm max |x_i|/v_i is at most τ.

use crate::certificate::interval::Interval;
use crate::tolerance::proof::{CONTRACTION, SHARE, WEIGHT_STEPS, enlarged};
use nalgebra::{DMatrix, DVector};

/// A matrix all of whose members are regular.
pub(super) struct Regular<'a> {
    matrix: &'a DMatrix<Interval>,
    inverse: DMatrix<f64>,
    /// |I − C M|, at least.
    off: DMatrix<f64>,
    weights: Vec<f64>,
    /// 1 − κ, at most.
    room: f64,
}

impl<'a> Regular<'a> {
    /// The matrix, if it is seen to be regular.
    pub fn new(matrix: &'a DMatrix<Interval>) -> Option<Self> {
        let n = matrix.nrows();
        let inverse = if n == 0 { DMatrix::zeros(0, 0) } else { matrix.map(Interval::middle).try_inverse()? };
        let entry = |i: usize, j: usize| {
            let product = (0..n).fold(Interval::ZERO, |sum, k| sum + Interval::point(inverse[(i, k)]) * matrix[(k, j)]);
            product.reach(f64::from(u8::from(i == j)))
        };
        let off = DMatrix::from_fn(n, n, entry);
        if off.iter().any(|size| !size.is_finite()) {
            return None;
        }
        // in the units of the unknowns, and then towards the positive eigenvector, which makes κ smallest
        let largest = |j: usize| matrix.column(j).iter().fold(f64::MIN_POSITIVE, |most, entry| most.max(entry.magnitude()));
        let mut weights: Vec<f64> = (0..n).map(|j| 1.0 / largest(j)).collect();
        let part = |weights: &[f64]| {
            let moved = times(&off, weights);
            let kappa = moved.iter().zip(weights).map(|(moved, weight)| enlarged(moved / weight, 1)).fold(0.0, f64::max);
            (moved, kappa)
        };
        for _ in 0..WEIGHT_STEPS {
            let (moved, kappa) = part(&weights);
            if kappa < CONTRACTION {
                break;
            }
            weights = moved.iter().zip(&weights).map(|(moved, weight)| moved + SHARE * kappa * weight).collect();
        }
        let (_, kappa) = part(&weights);
        (kappa < CONTRACTION).then(|| Regular { matrix, inverse, off, weights, room: (Interval::ONE - Interval::point(kappa)).low })
    }

    /// A box around the solutions of M x = b, for every M and b in theirs.
    pub fn solutions(&self, right: &[Interval]) -> Vec<Interval> {
        let n = right.len();
        let middle = &self.inverse * DVector::from_iterator(n, right.iter().map(|b| b.middle()));
        let residual: Vec<Interval> =
            (0..n).map(|i| (0..n).fold(right[i], |sum, j| sum - self.matrix[(i, j)] * Interval::point(middle[j]))).collect();
        let first: Vec<f64> = (0..n)
            .map(|i| (0..n).fold(Interval::ZERO, |sum, j| sum + Interval::point(self.inverse[(i, j)]) * residual[j]).magnitude())
            .collect();
        let tau = first.iter().zip(&self.weights).map(|(g, v)| enlarged(enlarged(g / v, 1) / self.room, 1)).fold(0.0, f64::max);
        let rest = times(&self.off, &self.weights);
        (0..n).map(|i| Interval::ball(middle[i], enlarged(first[i] + enlarged(tau * rest[i], 1), 2))).collect()
    }
}

/// The product of matrices with entries that are not negative, rounded up.
fn times(matrix: &DMatrix<f64>, x: &[f64]) -> Vec<f64> {
    (0..matrix.nrows()).map(|i| enlarged((0..x.len()).map(|j| matrix[(i, j)] * x[j]).sum(), x.len())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [f64; 4], radius: f64) -> DMatrix<Interval> {
        DMatrix::from_row_slice(2, 2, &entries.map(|entry| Interval::ball(entry, radius)))
    }

    #[test]
    fn every_member_s_solution_is_in_the_box_and_a_set_with_a_singular_member_is_not_regular() {
        let intervals = matrix([2.0, 1.0, -1.0, 4.0], 0.25);
        let regular = Regular::new(&intervals).expect("its determinant is 9 ± 2.1");
        let right = [Interval::ball(1.0, 0.125), Interval::ball(-3.0, 0.125)];
        let found = regular.solutions(&right);
        for corner in 0..64_usize {
            let end = |bit: usize, x: Interval| if corner >> bit & 1 == 0 { x.low } else { x.high };
            let [a, b, c, d] = std::array::from_fn(|bit| end(bit, intervals[(bit / 2, bit % 2)]));
            let [p, q] = [end(4, right[0]), end(5, right[1])];
            let determinant = a * d - b * c;
            let x = [(p * d - b * q) / determinant, (a * q - p * c) / determinant];
            assert!((0..2).all(|i| found[i].low <= x[i] && x[i] <= found[i].high), "{x:?} {found:?}");
        }
        assert!(Regular::new(&matrix([1.0, 1.0, 1.0, 1.25], 0.125)).is_none() && Regular::new(&matrix([f64::NAN; 4], 0.0)).is_none());
    }

    #[test]
    fn units_of_the_unknowns_do_not_matter() {
        let scaled = DMatrix::from_row_slice(2, 2, &[2e9, 1.0, -1e9, 4.0].map(|entry| Interval::ball(entry, entry.abs() * 0.1)));
        let found = Regular::new(&scaled).expect("regular in any units").solutions(&[Interval::ONE, Interval::ONE]);
        assert!(found[0].magnitude() < 1e-8 && found[1].low > 0.0);
    }
}
