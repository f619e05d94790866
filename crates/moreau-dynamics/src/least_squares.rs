//! The least x with the least ‖A x − b‖, by the singular values of A.
//!
//! ```text
//!     A = U Σ Vᵀ ,    x = V Σ⁺ Uᵀ b ,    Σ⁺ inverts the singular values above a limit and takes the others for zero
//! ```
//! An iteration for singular values needs numbers: with one that is not finite it never ends, and without any rows there is nothing to
//! iterate on. Both are decided before it begins.

use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Iterations per row or column of A: the QR iteration needs about two, and thirty is LAPACK's own limit.
const ITERATIONS: usize = 30;

/// x, with singular values up to `negligible(σ_max)` taken for zero; zero where A has no rows.
///
/// # Errors
/// [`Error::Solver`] in the name of `method` if A or b holds a number that is not finite, or the iteration does not end.
///
/// # Source
/// Golub and Van Loan, *Matrix Computations*, §5.5.
pub fn least_squares(method: &str, matrix: DMatrix<f64>, right: &DVector<f64>, negligible: impl Fn(f64) -> f64) -> Result<DVector<f64>> {
    if matrix.is_empty() {
        return Ok(DVector::zeros(matrix.ncols()));
    }
    if matrix.iter().chain(right).any(|x| !x.is_finite()) {
        return Err(Error::breakdown(method, "a contact's row or gap is not finite; use a smaller step"));
    }
    let limit = ITERATIONS * matrix.nrows().max(matrix.ncols());
    let decomposed = matrix.try_svd(true, true, 5.0 * f64::EPSILON, limit);
    let decomposed = decomposed.ok_or_else(|| Error::limit(method, format!("singular values were not found in {limit} iterations")))?;
    let smallest = negligible(decomposed.singular_values.amax());
    decomposed.solve(right, smallest).map_err(|reason| Error::breakdown(method, reason))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn dependent_rows_share_what_they_ask_for() {
        // twice the same row: x₁ + x₂ = 1 and x₁ + x₂ = 3, of which (1, 1) is the least of the least squares
        let found =
            least_squares("test", dmatrix![1.0, 1.0; 1.0, 1.0], &dvector![1.0, 3.0], |largest| rounding(4, largest)).expect("finite");
        assert!((found - dvector![1.0, 1.0]).amax() <= rounding(32, 4.0));
    }

    #[test]
    fn no_rows_ask_for_nothing() {
        assert_eq!(least_squares("test", DMatrix::zeros(0, 0), &DVector::zeros(0), |x| x).expect("nothing").len(), 0);
        assert_eq!(least_squares("test", DMatrix::zeros(0, 3), &DVector::zeros(0), |x| x).expect("nothing"), DVector::zeros(3));
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused_and_huge_ones_end() {
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(least_squares("test", dmatrix![1.0, bad; bad, 1.0], &dvector![1.0, 1.0], |x| x).is_err());
            assert!(least_squares("test", dmatrix![1.0, 0.0; 0.0, 1.0], &dvector![1.0, bad], |x| x).is_err());
        }
        // squares overflow: whatever comes out, it comes
        let _ = least_squares("test", dmatrix![1e300, -1e300; 1e300, 1e308], &dvector![1.0, 1.0], |x| x);
    }
}
