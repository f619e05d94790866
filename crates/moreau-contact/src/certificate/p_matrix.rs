//! P-matrix: every principal minor is positive; then the LCP has exactly one solution for every q.
//!
//! With a₁₁ > 0 and the Schur complement M/a₁₁ = M₂₂ − M₂₁ a₁₁⁻¹ M₁₂, det M_{α∪1} = a₁₁ det (M/a₁₁)_α; so M is a
//! P-matrix iff a₁₁ > 0 and both M₂₂ and M/a₁₁ are.

use super::Decision;
use super::copositivity::LARGEST;
use dashu_ratio::RBig;
use moreau_exact::scalar::Rational;
use moreau_exact::witness::{Part, Witness, decided};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// A principal minor that is not positive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Minor {
    /// Rows and columns of the minor.
    pub indices: Vec<usize>,
    /// Its value.
    pub value: Rational,
}

/// Whether all principal minors of M are positive; the witness is one that is not.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`LARGEST`] rows.
/// ```
/// use moreau_contact::certificate::p_matrix::p_matrix;
/// use moreau_contact::nalgebra::dmatrix;
/// use moreau_contact::scalar::ratio;
///
/// let matrix = |beside: i64| dmatrix![ratio(1, 1), ratio(beside, 1); ratio(1, 1), ratio(1, 1)];
/// assert!(p_matrix(&matrix(0))?.holds());
/// assert_eq!(p_matrix(&matrix(1))?.witness().expect("a minor").indices, [0, 1]); // 1 − 1 = 0
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn p_matrix(matrix: &DMatrix<Rational>) -> Result<Decision<Minor>> {
    if matrix.nrows() > LARGEST {
        let message = format!("principal minors are decided up to size {LARGEST}, this matrix has {} rows", matrix.nrows());
        return Err(Error::Unsupported(message));
    }
    let pivots = Minor { indices: Vec::new(), value: RBig::ONE };
    let bad = decided(
        || first_bad_minor(matrix, 0, &pivots),
        |found| {
            let mut parts = vec![("matrix", Part::from(matrix))];
            match found {
                None => parts.push(("answer", Part::Word("holds"))),
                Some(minor) => {
                    let value = Part::Number(minor.value.clone());
                    parts.extend([("answer", Part::Word("fails")), ("indices", Part::Counts(minor.indices.clone())), ("value", value)]);
                }
            }
            Some(Witness { kind: "p-matrix", parts })
        },
    );
    Ok(bad.map_or(Decision::Holds, Decision::Fails))
}

/// Searches the minors that contain the `pivots`, none of the other indices below `next`, and any from there on; the
/// matrix is the Schur complement of the pivots on the indices from `next`.
fn first_bad_minor(complement: &DMatrix<Rational>, next: usize, pivots: &Minor) -> Option<Minor> {
    if complement.nrows() == 0 {
        return None;
    }
    let mut extended = pivots.clone();
    extended.indices.push(next);
    extended.value *= &complement[(0, 0)];
    if extended.value <= RBig::ZERO {
        return Some(extended);
    }
    let size = complement.nrows() - 1;
    let without = complement.view((1, 1), (size, size)).into_owned();
    let with =
        DMatrix::from_fn(size, size, |i, j| &without[(i, j)] - &complement[(i + 1, 0)] * &complement[(0, j + 1)] / &complement[(0, 0)]);
    first_bad_minor(&without, next + 1, pivots).or_else(|| first_bad_minor(&with, next + 1, &extended))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    fn square(size: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(size, size, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
    }

    #[test]
    fn a_dominant_asymmetric_matrix_is_p() {
        assert!(p_matrix(&square(3, &[4, -1, 2, 3, 5, -1, -2, 1, 6])).unwrap().holds());
    }

    #[test]
    fn the_bad_minor_is_named_with_its_value() {
        let minor = p_matrix(&square(3, &[1, 0, 2, 0, 1, 0, 3, 0, 1])).unwrap().witness().unwrap();
        assert_eq!(minor, Minor { indices: vec![0, 2], value: ratio(-5, 1) });
        let zero = p_matrix(&square(2, &[1, 1, 1, 1])).unwrap().witness().unwrap();
        assert_eq!(zero, Minor { indices: vec![0, 1], value: ratio(0, 1) });
    }
}
