//! The section's matrices, exactly.

use crate::Result;
use crate::checks::stewart_trinkle::{chapter_example, reference};
use crate::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// The chapter's 4×4 matrix: unit point mass, d = ±x, μ = 1/2, unknowns (λ, β₁, β₂, σ).
pub(super) fn chapter_matrix() -> Result<DMatrix<Rational>> {
    Ok(reference(&chapter_example(ratio(0, 1), [ratio(0, 1), ratio(0, 1)]))?.matrix)
}

/// These numbers.
pub(super) fn integers(numbers: &[i64]) -> DVector<Rational> {
    DVector::from_iterator(numbers.len(), numbers.iter().map(|&x| ratio(x, 1)))
}

/// The LCP matrix of n = 3/5, d = ±4/5 and μ = 1: one velocity, one contact whose friction can undo its push.
pub(super) fn jamming_matrix() -> DMatrix<Rational> {
    let [n, d, one, none] = [ratio(3, 5), ratio(4, 5), ratio(1, 1), ratio(0, 1)];
    let push = [n, d.clone(), -d];
    DMatrix::from_fn(4, 4, |i, j| match (i, j) {
        (3, 3) | (0, 3) => none.clone(),
        (3, 0) | (1 | 2, 3) => one.clone(),
        (3, _) => -one.clone(),
        _ => &push[i] * &push[j],
    })
}

/// The matrix with the sign of the rows of the friction cone wrong, (−μ, Eᵀ).
pub(super) fn reversed(mut matrix: DMatrix<Rational>, contacts: usize) -> DMatrix<Rational> {
    let sigma = matrix.nrows() - contacts;
    matrix.rows_mut(sigma, contacts).neg_mut();
    matrix
}
