//! The points of {x ≥ 0 : w − M z = q} from one basis to the next, in whole numbers.
//!
//! ```text
//!     d x_B + T x_N = b ,   d > 0 ,   b ≥ 0 at a vertex x_N = 0, x_B = b/d
//!     pivot p = T_rc:   T_ij ← (T_ij p − T_ic T_rj)/d ,   d ← p
//! ```
//! All entries are minors of the data, so that every quotient is whole (Edmonds). A variable is made as small as it can be by the simplex
//! method with Bland's rule, which ends.

use crate::problem::Lcp;
use crate::tolerance::complementarity::words_of_work;
use dashu_int::IBig;
use dashu_int::ops::BitTest;
use moreau_exact::lifting::whole_rows;
use moreau_exact::scalar::Rational;
use nalgebra::DVector;

/// A basis with its numbers. Variables are w = 0..n, z = n..2n, and 2n, which lifts all of w together, while a first vertex is looked for.
#[derive(Clone)]
pub(super) struct Dictionary {
    /// Rows (T, b), each of the basic variable in the same place.
    rows: Vec<Vec<IBig>>,
    basic: Vec<usize>,
    /// The variable of each column of T.
    free: Vec<usize>,
    denominator: IBig,
    /// Products of machine words so far, about.
    work: u64,
}

/// A first vertex, or why there is none.
pub(super) enum First {
    Vertex(Dictionary),
    /// y ≥ 0 with Mᵀy ≤ 0 and qᵀy < 0.
    Empty(DVector<Rational>),
}

impl Dictionary {
    /// A vertex of {z ≥ 0 : M z + q ≥ 0}.
    pub(super) fn first(lcp: &Lcp<Rational>) -> First {
        let size = lcp.size();
        let (matrix, vector) = whole_rows(&lcp.matrix, &lcp.vector);
        let row = |i: usize| (0..size).map(|j| -&matrix[(i, j)]).chain([IBig::NEG_ONE, vector[i].clone()]).collect();
        let free = (size..=2 * size).collect();
        let mut start =
            Dictionary { rows: (0..size).map(row).collect(), basic: (0..size).collect(), free, denominator: IBig::ONE, work: 0 };
        let lowest = (0..size).min_by(|&i, &k| vector[i].cmp(&vector[k])).filter(|&i| vector[i] < IBig::ZERO);
        if let Some(lowest) = lowest {
            start.pivot(lowest, size);
        }
        if start.fix(2 * size) {
            return First::Vertex(start);
        }
        // the row of the lift, Σ yᵢ (rowᵢ) with y read off the columns of w, has no positive entry and a positive right side
        let row = start.row_of(2 * size).expect("it stayed in the basis");
        let of_w = |i: usize| start.free.iter().position(|&v| v == i).map_or(IBig::ZERO, |c| -&start.rows[row][c]);
        First::Empty(DVector::from_fn(size, |i, _| {
            // rows were multiplied by what makes them whole
            let entry = |j| if j < size { (&lcp.matrix[(i, j)], &matrix[(i, j)]) } else { (&lcp.vector[i], &vector[i]) };
            let stored = (0..=size).map(entry).find(|(_, whole)| !whole.is_zero());
            Rational::from(of_w(i)) * stored.map_or(Rational::ONE, |(data, whole)| Rational::from(whole.clone()) / data)
        }))
    }

    fn row_of(&self, variable: usize) -> Option<usize> {
        self.basic.iter().position(|&v| v == variable)
    }

    /// Keeps to x_v = 0; false if x_v > 0 everywhere.
    pub(super) fn fix(&mut self, variable: usize) -> bool {
        self.lower(variable);
        if let Some(row) = self.row_of(variable) {
            if self.right(row) > &IBig::ZERO {
                return false;
            }
            // zero at this vertex: any entry of its row is a pivot that moves nothing
            match (0..self.free.len()).find(|&c| !self.rows[row][c].is_zero()) {
                Some(column) => self.pivot(row, column),
                None => {
                    self.rows.remove(row);
                    self.basic.remove(row);
                    return true;
                }
            }
        }
        let column = self.free.iter().position(|&v| v == variable).expect("it left the basis");
        self.free.remove(column);
        self.rows.iter_mut().for_each(|row| drop(row.remove(column)));
        true
    }

    /// Makes a basic variable as small as it can be, until it leaves the basis or cannot fall.
    fn lower(&mut self, variable: usize) {
        while let Some(row) = self.row_of(variable) {
            let falls = |c: &usize| self.rows[row][*c] > IBig::ZERO;
            let Some(column) = (0..self.free.len()).filter(falls).min_by_key(|&c| self.free[c]) else { return };
            let leaving = self.leaving(Some(row), column).expect("the row itself is one");
            self.pivot(leaving, column);
        }
    }

    /// Makes a variable larger until it is positive; false if it is zero everywhere.
    pub(super) fn raise(&mut self, variable: usize) -> bool {
        while !self.is_positive(variable) {
            let column = match self.row_of(variable) {
                Some(row) => (0..self.free.len()).filter(|&c| self.rows[row][c] < IBig::ZERO).min_by_key(|&c| self.free[c]),
                None => self.free.iter().position(|&v| v == variable),
            };
            let Some(column) = column else { return false };
            // without a row that ends it, it grows for ever
            let Some(leaving) = self.leaving(None, column) else { return true };
            self.pivot(leaving, column);
        }
        true
    }

    /// The row of the smallest ratio b/T with T > 0, if there is one; of several the preferred one, then that of the first variable.
    fn leaving(&self, preferred: Option<usize>, column: usize) -> Option<usize> {
        let entry = |i: usize| &self.rows[i][column];
        let candidates = (0..self.rows.len()).filter(|&i| *entry(i) > IBig::ZERO);
        let order = |&i: &usize, &k: &usize| {
            let ratios = (self.right(i) * entry(k)).cmp(&(self.right(k) * entry(i)));
            ratios.then_with(|| (Some(i) != preferred, self.basic[i]).cmp(&(Some(k) != preferred, self.basic[k])))
        };
        candidates.min_by(order)
    }

    fn right(&self, row: usize) -> &IBig {
        self.rows[row].last().expect("every row ends with its right side")
    }

    /// Exchanges a basic variable and a free one.
    fn pivot(&mut self, row: usize, column: usize) {
        self.work += words_of_work(self.rows.len() * (self.free.len() + 1), self.denominator.bit_len());
        let top = std::mem::take(&mut self.rows[row]);
        let pivot = top[column].clone();
        for other in self.rows.iter_mut().filter(|other| !other.is_empty()) {
            let factor = std::mem::replace(&mut other[column], IBig::ZERO);
            for (j, (entry, above)) in other.iter_mut().zip(&top).enumerate() {
                if j == column {
                    continue;
                }
                let through = !factor.is_zero() && !above.is_zero();
                if through {
                    *entry = (&*entry * &pivot - &factor * above) / &self.denominator;
                } else if !entry.is_zero() {
                    *entry = &*entry * &pivot / &self.denominator;
                }
            }
            other[column] = -factor;
        }
        let mut top = top;
        top[column] = std::mem::replace(&mut self.denominator, pivot);
        self.rows[row] = top;
        std::mem::swap(&mut self.basic[row], &mut self.free[column]);
        if self.denominator < IBig::ZERO {
            self.denominator = -std::mem::take(&mut self.denominator);
            self.rows.iter_mut().flatten().for_each(|entry| *entry = -std::mem::take(entry));
        }
    }

    /// Whether a variable is positive at this vertex.
    pub(super) fn is_positive(&self, variable: usize) -> bool {
        self.row_of(variable).is_some_and(|row| *self.right(row) > IBig::ZERO)
    }

    /// Products of machine words that led here, about.
    pub(super) fn work(&self) -> u64 {
        self.work
    }

    /// What a linear program of so many pivots costs from here, about.
    pub(super) fn work_of_pivots(&self, pivots: usize) -> u64 {
        pivots as u64 * words_of_work(self.rows.len() * (self.free.len() + 1), self.denominator.bit_len())
    }

    /// Whether the polyhedron may be more than this vertex.
    pub(super) fn has_free(&self) -> bool {
        !self.free.is_empty()
    }

    /// x_v at this vertex.
    pub(super) fn value(&self, variable: usize) -> Rational {
        self.row_of(variable).map_or(Rational::ZERO, |row| Rational::from_parts_signed(self.right(row).clone(), self.denominator.clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;
    use nalgebra::DMatrix;

    fn lcp(size: usize, matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
        let numbers = |slice: &[i64], below: i64| slice.iter().map(|&x| ratio(x, below)).collect::<Vec<_>>();
        Lcp::new(DMatrix::from_row_slice(size, size, &numbers(matrix, 6)), DVector::from_vec(numbers(vector, 10)))
    }

    #[test]
    fn a_first_vertex_is_feasible_and_an_empty_set_has_a_witness() {
        for (matrix, vector, feasible) in [
            ([2, -1, 1, 1], [-1, -1], true),
            ([1, -2, -2, 1], [-1, -1], false),
            ([0, 0, 0, 0], [-1, 0], false),
            ([0, 3, -3, 0], [-1, -1], false),
            ([0, 3, -3, 0], [-1, 1], true),
            ([0, 0, 0, 0], [0, 0], true),
        ] {
            let lcp = lcp(2, &matrix, &vector);
            match Dictionary::first(&lcp) {
                First::Vertex(dictionary) => {
                    let z = DVector::from_fn(2, |j, _| dictionary.value(2 + j));
                    let w = lcp.slack(&z);
                    assert!(feasible && z.iter().chain(w.iter()).all(|x| *x >= Rational::ZERO), "{matrix:?} {z} {w}");
                }
                First::Empty(y) => {
                    assert!(!feasible && y.iter().all(|y| *y >= Rational::ZERO) && lcp.vector.dot(&y) < Rational::ZERO, "{matrix:?} {y}");
                    assert!(lcp.matrix.tr_mul(&y).iter().all(|x| *x <= Rational::ZERO), "{matrix:?} {y}");
                }
            }
        }
    }

    #[test]
    fn a_variable_that_cannot_vanish_is_not_fixed() {
        // z ≥ ½ in every point of 2 z − 1 ≥ 0
        let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(2, 1)), DVector::from_element(1, ratio(-1, 1)));
        let First::Vertex(vertex) = Dictionary::first(&lcp) else { panic!("feasible") };
        assert!(!vertex.clone().fix(1));
        let mut other = vertex;
        assert!(other.fix(0));
        assert_eq!(other.value(1), ratio(1, 2));
    }

    #[test]
    fn a_variable_is_raised_unless_it_is_zero_everywhere() {
        let first = |matrix: [i64; 4], vector: [i64; 2]| match Dictionary::first(&lcp(2, &matrix, &vector)) {
            First::Vertex(vertex) => vertex,
            First::Empty(_) => panic!("feasible"),
        };
        // w = −z₁ − z₂ and z₁ + z₂: all but nothing is zero
        let pinned = first([-1, -1, 1, 1], [0, 0]);
        assert!((0..4).all(|v| !pinned.clone().raise(v)));
        // w₁ = 1 − z₁ and w₂ = z₁ − z₁: only w₂ is zero, and z₂ has no bound
        let open = first([-1, 0, 0, 0], [1, 0]);
        assert_eq!([0, 1, 2, 3].map(|v| open.clone().raise(v)), [true, false, true, true]);
        // from a vertex where nothing moves at once: w₁ = z₁ − z₂ ≥ 0, w₂ = z₂ − z₁/2 ≥ 0
        let cone = first([6, -6, -3, 6], [0, 0]);
        assert!((0..4).all(|v| cone.clone().raise(v)));
    }
}
