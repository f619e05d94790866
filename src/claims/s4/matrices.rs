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
    let entries = [9, 12, -12, 0, 12, 16, -16, 25, -12, -16, 16, 25, 25, -25, -25, 0];
    DMatrix::from_row_slice(4, 4, &entries.map(|x| ratio(x, 25)))
}
