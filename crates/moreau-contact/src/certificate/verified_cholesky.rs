//! Positive definite, shown by Cholesky's factorisation in rounded numbers.
//!
//! ```text
//!     S − c 1 = L Lᵀ runs to its end in f64 ,  c ≥ γ_{n+1} tr S/(1 − γ_{n+1})      ⟹     xᵀS x > 0 for all x ≠ 0
//! ```
//! S. M. Rump, *Verification of positive definiteness*, BIT 46 (2006), theorem 2.3.

use crate::tolerance::certificate::gamma;
use crate::tolerance::complementarity::LEAST_TRACE;
use nalgebra::DMatrix;

/// Whether xᵀA x > 0 for all x ≠ 0 is shown; only the symmetric part of A counts. False says nothing.
///
/// ```
/// use moreau_contact::certificate::verified_cholesky::is_positive_definite;
/// use moreau_contact::nalgebra::dmatrix;
///
/// assert!(is_positive_definite(&dmatrix![2.0, 5.0; -4.0, 1.0])); // the symmetric part is (2, ½; ½, 1)
/// assert!(!is_positive_definite(&dmatrix![1.0, 1.0; 1.0, 1.0]));
/// ```
///
/// # Panics
/// If A is not square.
pub fn is_positive_definite(matrix: &DMatrix<f64>) -> bool {
    let size = matrix.nrows();
    let trace: f64 = matrix.diagonal().iter().sum();
    let diagonal_is_positive = matrix.diagonal().iter().all(|d| d.is_normal() && *d > 0.0);
    if size == 0 || !diagonal_is_positive || !trace.is_finite() || trace < LEAST_TRACE {
        return size == 0;
    }
    // entries of A + Aᵀ are rounded once: by at most ε times √(Aᵢᵢ Aⱼⱼ) where it is definite, an nth part of the trace more
    let shift = 4.0 * gamma(2 * size + 8) * trace;
    let symmetric = DMatrix::from_fn(size, size, |i, j| {
        let half = 0.5 * matrix[(i, j)] + 0.5 * matrix[(j, i)];
        if i == j { half - shift } else { half }
    });
    symmetric.iter().all(|entry| entry.is_finite() && (*entry == 0.0 || entry.is_normal())) && symmetric.cholesky().is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::definiteness::{Definiteness, definiteness};
    use moreau_exact::scalar::exact;

    #[test]
    fn nothing_that_is_not_definite_is_called_so_and_what_is_well_away_is() {
        let mut shown = 0;
        for size in [1, 2, 3, 6] {
            for power in [0, 10, 30, 48, 52, 60] {
                // a Gram matrix of dependent vectors, lifted by 2^−power, whatever rounding left of it
                let vectors = DMatrix::from_fn(size.max(2) - 1, size, |i, j| ((3 * i + 5 * j * j + i * j) % 7) as f64 / 3.0 - 1.0);
                let gram = vectors.tr_mul(&vectors) + DMatrix::from_diagonal_element(size, size, 0.5f64.powi(power));
                let definite = definiteness(&gram.map(exact)) == Definiteness::Definite;
                assert!(definite || !is_positive_definite(&gram), "{size} {power}");
                assert!(power > 30 || is_positive_definite(&gram), "{size} {power}");
                shown += usize::from(is_positive_definite(&gram));
            }
        }
        assert!(shown > 10);
        assert!(!is_positive_definite(&DMatrix::from_element(1, 1, f64::NAN)) && !is_positive_definite(&DMatrix::from_element(1, 1, -1.0)));
    }
}
