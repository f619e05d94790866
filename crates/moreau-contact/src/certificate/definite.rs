//! Whether a symmetric matrix is positive definite, proved on rounded numbers.
//!
//! ```text
//!     X ≈ L⁻¹ ,  S̃ ≈ L Lᵀ :      ‖I − X S̃ Xᵀ‖∞ + ‖|X| |S − S̃| |Xᵀ|‖∞ < 1      ⟹      S ≻ 0
//! ```
//! because then the symmetric X S Xᵀ has its eigenvalues between 0 and 2, so that X is regular and S congruent to a definite matrix.

use super::forward::times;
use crate::tolerance::proof::{enlarged, product};
use nalgebra::DMatrix;

/// Whether every symmetric S with |S − S̃| v ≤ `unsure`(v) for v ≥ 0 is positive definite; `false` decides nothing.
pub(crate) fn surely_definite(near: &DMatrix<f64>, unsure: impl Fn(&[f64]) -> Vec<f64>) -> bool {
    let n = near.nrows();
    let Some(factor) = near.clone().cholesky() else { return false };
    let Some(inverse) = factor.l().solve_lower_triangular(&DMatrix::identity(n, n)) else { return false };
    let (left, transposed) = (&inverse * near, inverse.transpose());
    let found = &left * &transposed;
    let ones = vec![1.0; n];
    let right = times(&transposed, &ones);
    // fl(X S̃) errs by γ |X| |S̃|, and fl(fl(X S̃) Xᵀ) by γ |fl(X S̃)| |Xᵀ| besides
    let first = times(&inverse, &times(near, &right));
    let second = times(&left, &right);
    let given = times(&inverse, &unsure(&right));
    (0..n).all(|i| {
        let off: f64 = (0..n).map(|j| (f64::from(u8::from(i == j)) - found[(i, j)]).abs()).sum();
        enlarged(off + product(n) * (first[i] + second[i]) + given[i], n) < 1.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::definiteness::{Definiteness, definiteness};
    use moreau_exact::scalar::exact;

    #[test]
    fn what_is_said_to_be_definite_is_so_in_fractions_and_most_that_is_is_said() {
        let mut state = 11_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let (mut said, mut definite) = (0, 0);
        for case in 0..120 {
            let n = 1 + case % 7;
            let half = DMatrix::from_fn(n, n, |_, _| draw());
            let shift = draw() * 0.3;
            let matrix = DMatrix::from_fn(n, n, |i, j| (0..n).map(|k| half[(i.min(j), k)] * half[(i.max(j), k)]).sum::<f64>());
            let matrix = &matrix + DMatrix::identity(n, n) * shift;
            let exactly = definiteness(&matrix.map(exact)) == Definiteness::Definite;
            let proved = surely_definite(&matrix, |v| vec![0.0; v.len()]);
            assert!(!proved || exactly, "{matrix}");
            said += usize::from(proved);
            definite += usize::from(exactly);
        }
        assert!(definite > 40 && said >= definite - 2, "{said} of {definite}");
    }

    #[test]
    fn what_is_not_known_of_the_matrix_counts() {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 1.0]);
        let within = |size: f64| surely_definite(&matrix, |v| vec![size * v.iter().sum::<f64>(); 2]);
        assert!(within(0.0) && within(0.1) && !within(0.26), "its smallest eigenvalue is a half");
        assert!(!surely_definite(&DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0]), |v| vec![0.0; v.len()]), "semidefinite");
    }
}
