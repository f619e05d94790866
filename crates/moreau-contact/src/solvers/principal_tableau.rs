//! An LCP after exchanges of w and z.
//!
//! ```text
//!     x = C + T y ,    x and y together are w and z;   at first x = w, y = z, C = q, T = M
//!     exchange of x_r and y_s:   y_s = (x_r − C_r − Σ_{j≠s} T_rj yⱼ)/T_rs
//! ```

use crate::problem::Lcp;
use moreau_exact::scalar::Scalar;
use nalgebra::{DMatrix, DVector};

/// x = C + T y, with a column of C for every right side. Variables are w = 0..n and z = n..2n.
#[derive(Clone, Debug)]
pub(super) struct PrincipalTableau<T: Scalar> {
    pub(super) matrix: DMatrix<T>,
    pub(super) constants: DMatrix<T>,
    /// The variables x.
    pub(super) basic: Vec<usize>,
    /// The variables y.
    pub(super) free: Vec<usize>,
}

impl<T: Scalar> PrincipalTableau<T> {
    /// x = w, with q and other right sides.
    pub(super) fn new(lcp: &Lcp<T>, more: &[DVector<T>]) -> Self {
        let size = lcp.size();
        let columns: Vec<_> = std::iter::once(&lcp.vector).chain(more).cloned().collect();
        PrincipalTableau {
            matrix: lcp.matrix.clone(),
            constants: DMatrix::from_columns(&columns),
            basic: (0..size).collect(),
            free: (size..2 * size).collect(),
        }
    }

    /// Exchanges x_r and y_s; T_rs must not be zero.
    pub(super) fn exchange(&mut self, r: usize, s: usize) {
        let pivot = self.matrix[(r, s)].clone();
        let top = self.matrix.row(r).map(|entry| -entry / pivot.clone());
        let constants = self.constants.row(r).map(|constant| -constant / pivot.clone());
        for j in (0..self.basic.len()).filter(|&j| j != s) {
            let factor = top[j].clone();
            if factor.is_zero() {
                continue;
            }
            for i in (0..self.basic.len()).filter(|&i| i != r) {
                let change = self.matrix[(i, s)].clone() * factor.clone();
                self.matrix[(i, j)] += change;
            }
        }
        for i in (0..self.basic.len()).filter(|&i| i != r) {
            let entry = self.matrix[(i, s)].clone();
            for (k, constant) in constants.iter().enumerate() {
                self.constants[(i, k)] += entry.clone() * constant.clone();
            }
            self.matrix[(i, s)] = entry / pivot.clone();
        }
        for j in 0..self.basic.len() {
            self.matrix[(r, j)] = if j == s { T::one() / pivot.clone() } else { top[j].clone() };
        }
        self.constants.set_row(r, &constants);
        std::mem::swap(&mut self.basic[r], &mut self.free[s]);
    }

    /// The rows with z among x.
    pub(super) fn support(&self) -> Vec<bool> {
        let size = self.basic.len();
        (0..size).map(|row| self.basic.contains(&(row + size))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    /// Whether x = C + T y for the z and w = M z + q of the problem.
    fn describes(tableau: &PrincipalTableau<Rational>, lcp: &Lcp<Rational>, z: &DVector<Rational>) -> bool {
        let (w, size) = (lcp.slack(z), z.len());
        let of = |variable: &usize| if *variable < size { w[*variable].clone() } else { z[variable - size].clone() };
        let [x, y] = [&tableau.basic, &tableau.free].map(|list| DVector::from_iterator(size, list.iter().map(of)));
        x == tableau.constants.column(0) + &tableau.matrix * y
    }

    #[test]
    fn exchanges_change_the_description_and_not_what_is_described() {
        let numbers = [3, -1, 2, 0, 0, 5, -2, -7, 1].map(|x| ratio(x, 1));
        let lcp = Lcp::new(DMatrix::from_row_slice(3, 3, &numbers), DVector::from_row_slice(&[-1, 2, -3].map(|x| ratio(x, 2))));
        let z = DVector::from_row_slice(&[1, 5, 2].map(|x| ratio(x, 3)));
        let mut tableau = PrincipalTableau::new(&lcp, &[]);
        assert!(describes(&tableau, &lcp, &z));
        for (r, s) in [(1, 2), (2, 1), (0, 0)] {
            tableau.exchange(r, s);
            assert!(describes(&tableau, &lcp, &z), "{r} {s}");
        }
        assert_eq!((tableau.support(), &tableau.basic[..]), (vec![true; 3], &[3, 5, 4][..]));
        tableau.constants[(0, 0)] += ratio(1, 9);
        assert!(!describes(&tableau, &lcp, &z), "a planted mistake is seen");
    }
}
