//! Cholesky's factor of a dense matrix, which ends where the caller ends it: of some thousand rows it takes minutes.

use super::watch;
use crate::tolerance::limits::WATCHED;
use nalgebra::{Cholesky, DMatrix, Dyn};

/// L with A = L Lᵀ, number for number as nalgebra has it; none where A is not definite, or is large and the caller ends it.
pub(super) fn factor(mut matrix: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    for j in 0..matrix.nrows() {
        if matrix.nrows() >= WATCHED && watch::is_over() {
            return None;
        }
        for k in 0..j {
            let factor = -matrix[(j, k)];
            let (mut own, other) = matrix.columns_range_pair_mut(j, k);
            own.rows_range_mut(j..).axpy(factor, &other.rows_range(j..), 1.0);
        }
        let pivot = matrix[(j, j)].sqrt();
        // a root of a negative number is none
        if pivot.is_nan() || pivot == 0.0 {
            return None;
        }
        matrix[(j, j)] = pivot;
        let mut below = matrix.view_range_mut(j + 1.., j);
        below /= pivot;
    }
    Some(Cholesky::pack_dirty(matrix))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gᵀ G + s I of an n × n matrix of small whole numbers.
    fn matrix(n: usize, shift: f64) -> DMatrix<f64> {
        let g = DMatrix::from_fn(n, n, |i, j| ((7 * i + 13 * j + i * j) % 11) as f64 - 5.0);
        g.tr_mul(&g) + DMatrix::identity(n, n) * shift
    }

    #[test]
    fn every_number_is_the_one_of_nalgebra() {
        for (n, shift) in [(1, 0.5), (2, 0.25), (7, 0.1), (40, 1.0), (12, -1e3), (5, f64::NAN)] {
            let [own, theirs] = [factor(matrix(n, shift)), Cholesky::new(matrix(n, shift))].map(|found| found.map(|found| found.l()));
            assert_eq!(own, theirs, "{n} {shift}");
            assert_eq!(own.is_some(), shift > 0.0, "{n} {shift}");
        }
    }

    #[test]
    fn it_ends_at_the_next_column_where_the_word_is_given() {
        let ended = |asks, rows| watch::watched_until(asks, || factor(matrix(rows, 1.0))).0.is_none();
        assert!([0, 1, WATCHED - 1].iter().all(|asks| ended(*asks, WATCHED)));
        assert!(!ended(WATCHED, WATCHED) && !ended(0, WATCHED - 1), "a small one is factored before anybody looks");
    }
}
