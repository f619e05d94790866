//! A x = b by Gaussian elimination with partial pivoting that passes over zeros.
//!
//! ```text
//!     A ← P A ,   A_ij ← A_ij − (A_ik/A_kk) A_kj ,   i > k , only where A_ik ≠ 0 and A_kj ≠ 0
//! ```
//! A Jacobian over contacts is mostly zeros: the rows of an open contact are those of the identity, and bodies that do not touch do not
//! couple. What is passed over would subtract zero, so that of finite entries every number is the one that elimination without this gives:
//! [`nalgebra`]'s LU. `moreau_exact::elimination`, over any ordered field, divides by the pivot where this multiplies by its inverse, as
//! `nalgebra` does, and rounds otherwise.

use super::watch;
use crate::tolerance::limits::WATCHED;
use nalgebra::{DMatrix, DVector};

/// The x with A x = b; `None` if a pivot is exactly zero, or the caller ends it.
///
/// # Panics
/// If A is not square or b has another size.
pub(super) fn solve(matrix: &DMatrix<f64>, right_side: &DVector<f64>) -> Option<DVector<f64>> {
    let size = right_side.len();
    assert!(matrix.is_square() && matrix.nrows() == size, "elimination needs a square matrix and a right side of its size");
    // the rows of A lie in memory one after the other in its transpose
    let mut rows = matrix.transpose();
    let rows = rows.as_mut_slice();
    let mut x = right_side.clone();
    for k in 0..size {
        if size >= WATCHED && watch::is_over() {
            return None;
        }
        let pivot = largest_below(rows, size, k);
        if pivot != k {
            let (upper, lower) = rows.split_at_mut(pivot * size);
            upper[k * size + k..(k + 1) * size].swap_with_slice(&mut lower[k..size]);
            x.swap_rows(k, pivot);
        }
        eliminate(rows, &mut x, k);
    }
    substitute_back(rows, x)
}

/// The row from k on with the largest entry in column k, the first of several.
fn largest_below(rows: &[f64], size: usize, k: usize) -> usize {
    let entry = |i: usize| rows[i * size + k].abs();
    (k + 1..size).fold(k, |best, i| if entry(i) > entry(best) { i } else { best })
}

/// Subtracts multiples of row k from the rows below it, in the columns between its first and its last entry that is not zero.
fn eliminate(rows: &mut [f64], x: &mut DVector<f64>, k: usize) {
    let size = x.len();
    let (above, below) = rows.split_at_mut((k + 1) * size);
    let pivot_row = &above[k * size..];
    let pivot = pivot_row[k];
    if pivot == 0.0 {
        return;
    }
    let inverse = 1.0 / pivot;
    let is_entry = |j: &usize| pivot_row[*j] != 0.0;
    let first = (k + 1..size).find(is_entry).unwrap_or(size);
    let end = (first..size).rev().find(is_entry).map_or(first, |last| last + 1);
    let shared = &pivot_row[first..end];
    let top = x[k];
    for (i, row) in below.chunks_exact_mut(size).enumerate().filter(|(_, row)| row[k] != 0.0) {
        let factor = row[k] * inverse;
        row[first..end].iter_mut().zip(shared).for_each(|(entry, above)| *entry -= above * factor);
        x[k + 1 + i] -= top * factor;
    }
}

/// The x of an upper triangle.
fn substitute_back(rows: &[f64], mut x: DVector<f64>) -> Option<DVector<f64>> {
    let size = x.len();
    for k in (0..size).rev() {
        let pivot = rows[k * size + k];
        if pivot == 0.0 {
            return None;
        }
        x[k] /= pivot;
        for i in 0..k {
            x[i] -= x[k] * rows[i * size + k];
        }
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries in [−1, 1] from a linear congruence, a share of them zero, and some rows of the identity.
    fn matrix(size: usize, seed: u64, zeros: u64) -> DMatrix<f64> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 33
        };
        let mut matrix = DMatrix::from_fn(size, size, |_, _| if next() % 8 < zeros { 0.0 } else { (next() % 2001) as f64 / 1000.0 - 1.0 });
        for i in (0..size).filter(|i| i % 3 == seed as usize % 3) {
            matrix.row_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        matrix
    }

    #[test]
    fn every_number_is_the_one_of_nalgebra() {
        let mut solved = 0;
        for seed in 0..200 {
            let size = 1 + seed as usize % 40;
            let matrix = matrix(size, seed, seed % 8);
            let right = DVector::from_fn(size, |i, _| (i as f64 - 3.0) / 7.0);
            let expected = matrix.clone().lu().solve(&right);
            let found = solve(&matrix, &right);
            assert_eq!(found.is_some(), expected.is_some(), "seed {seed}");
            if let (Some(found), Some(expected)) = (found, expected) {
                solved += 1;
                assert!(found.iter().zip(&expected).all(|(a, b)| a == b), "seed {seed}: {found} {expected}");
            }
        }
        assert!(solved > 100, "{solved} are regular");
    }

    #[test]
    fn a_large_system_is_left_at_the_next_pivot_where_the_word_is_given() {
        let right = DVector::from_element(WATCHED, 1.0);
        for (asks, solved) in [(0, false), (WATCHED - 1, false), (WATCHED, true)] {
            let (found, _) = watch::watched_until(asks, || solve(&DMatrix::identity(WATCHED, WATCHED), &right));
            assert_eq!(found.is_some(), solved, "{asks}");
        }
    }

    #[test]
    fn a_singular_matrix_has_no_answer_and_an_exchange_of_rows_is_followed() {
        assert_eq!(solve(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]), &DVector::from_vec(vec![1.0, 1.0])), None);
        let exchanged = solve(&DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 0.0]), &DVector::from_vec(vec![1.0, 1.0]));
        assert_eq!(exchanged, Some(DVector::from_vec(vec![0.25, 0.5])));
    }
}
