//! What a mass that is nearly singular loses when it is factored: how many roundings more a row of W has for it.
//!
//! ```text
//!     A = S M S ,  S = diag(M)^-½              M = L D Lᵀ, or P M = L U where it is not symmetric
//!     |δ(hᵀA⁻¹g)| = |hᵀA⁻¹ δA A⁻¹g| ≤ ‖δA‖ ‖A⁻ᵀh‖ ‖A⁻¹g‖ ,     ‖δA‖ ≤ γ_n ‖S |L||U| S‖ ,   |L|D|Lᵀ| of at most n if symmetric
//!     ‖A⁻¹g‖² ≤ ‖B⁻¹‖ gᵀA⁻¹g ,   ‖A⁻ᵀh‖ ≤ ‖A⁻ᵀA‖ ‖A⁻¹h‖ ,      B = (A + Aᵀ)/2
//! ```
//! so that what is lost of W is at most γ_n times the size of the factors times ‖B⁻¹‖ ‖A⁻ᵀA‖, which for symmetric masses is ‖A⁻¹‖.

use super::mass_block::Factor;
use crate::tolerance::certificate::{KEPT_BY_MASS, gamma, lost_of_pivots};
use moreau_exact::tolerance::EPSILON;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// The terms that factors of this mass add to a row of W: none where it is far from singular.
pub(super) fn terms(mass: &DMatrix<f64>, factor: &Factor) -> usize {
    let lost = match factor {
        Factor::Symmetric(factor) => of_symmetric(mass, factor.pivots()),
        Factor::Any(factor) => of_any(mass, factor),
    };
    // what is not a number is lost
    if lost.is_nan() { usize::MAX } else { lost.min(1.0 / EPSILON) as usize }
}

/// n ‖A⁻¹‖ n.
fn of_symmetric(mass: &DMatrix<f64>, pivots: &[f64]) -> f64 {
    let by_pivots = lost_of_pivots(mass, pivots);
    if by_pivots <= KEPT_BY_MASS {
        return 0.0;
    }
    let of_inverse = Inverse::of(&scaled(mass, mass)).map_or(f64::INFINITY, |inverse| inverse.norm);
    (mass.nrows() as f64).powi(2) * of_inverse.min(by_pivots)
}

/// n ‖S P⁻¹|L||U| S‖ ‖B⁻¹‖ ‖A⁻ᵀA‖.
fn of_any(mass: &DMatrix<f64>, factor: &LU<f64, Dyn, Dyn>) -> f64 {
    let a = scaled(mass, mass);
    let (Some(inverse), Some(symmetric)) = (Inverse::of(&a), Inverse::of(&((&a + a.transpose()) * 0.5))) else {
        return f64::INFINITY;
    };
    let turned = (inverse.matrix.transpose() * &a).norm() + inverse.off * a.norm();
    let condition = symmetric.norm * turned;
    if condition <= KEPT_BY_MASS {
        return 0.0;
    }
    let mut size = factor.l().abs() * factor.u().abs();
    factor.p().inv_permute_rows(&mut size);
    mass.nrows() as f64 * scaled(&size, mass).norm() * condition
}

/// S N S.
fn scaled(matrix: &DMatrix<f64>, mass: &DMatrix<f64>) -> DMatrix<f64> {
    let scale: DVector<f64> = mass.diagonal().map(|m| 1.0 / m.sqrt());
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| scale[i] * matrix[(i, j)] * scale[j])
}

/// X ≈ A⁻¹ with ‖1 − XA‖_∞ = ε ≤ ½, so that ‖A⁻¹‖_∞ ≤ ‖X‖_∞/(1 − ε) and ‖A⁻¹ − X‖ is at most √n ε of it.
struct Inverse {
    matrix: DMatrix<f64>,
    /// A bound of ‖A⁻¹‖_∞.
    norm: f64,
    /// A bound of ‖A⁻¹ − X‖.
    off: f64,
}

impl Inverse {
    fn of(a: &DMatrix<f64>) -> Option<Self> {
        let (n, matrix) = (a.nrows(), a.clone().try_inverse()?);
        let largest = |of: &DMatrix<f64>| of.row_iter().map(|row| row.iter().map(|entry| entry.abs()).sum()).fold(0.0, f64::max);
        let rounded = (DMatrix::identity(n, n) - &matrix * a).abs() + matrix.abs() * a.abs() * gamma(n + 2);
        // not a number is refused, too
        let off = rounded.row_iter().map(|row| row.sum()).fold(0.0, moreau_exact::number::larger);
        let norm = largest(&matrix) / (1.0 - off);
        (off <= 0.5).then(|| Inverse { off: norm * off * (n as f64).sqrt(), matrix, norm })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Scalar, exact};
    use nalgebra::dmatrix;

    fn lost(mass: &DMatrix<f64>) -> f64 {
        terms(mass, &Factor::new(mass).unwrap()) as f64
    }

    #[test]
    fn masses_that_are_far_from_singular_lose_nothing() {
        for mass in [dmatrix![3.0], dmatrix![1e-9, 0.0; 0.0, 1e9], dmatrix![2.0, 0.5; 0.5, 1.0], dmatrix![2.0, 0.5; -0.5, 1.0]] {
            assert_eq!(lost(&mass), 0.0, "{mass}");
        }
    }

    /// A chain of 60 equal links: the product of M_jj/D_j is 2⁶⁰/61, its condition some 1500.
    #[test]
    fn of_many_velocities_the_inverse_counts_and_not_the_product_of_the_pivots() {
        let chain = DMatrix::from_fn(60, 60, |i, j| if i == j { 2.0 } else { -f64::from(u8::from(i.abs_diff(j) == 1)) });
        let lost = lost(&chain);
        assert!((3600.0 * 465.0..3600.0 * 2000.0).contains(&lost), "{lost:e}");
    }

    /// hᵀM⁻¹h in doubles, of h along the nearly free direction, beside fractions: what it is off by is within the terms, in spacings.
    #[test]
    fn what_is_lost_is_within_the_terms_up_to_singular_masses() {
        let (mut most, mut seen) = (0.0_f64, 0);
        for power in 5..=46 {
            for (skew, third) in [(0.0, 0.3), (0.0, 0.7), (0.2, 0.3)] {
                let off = 1.0 - third * 2f64.powi(-power);
                let mass = dmatrix![1.0, off; off, 1.0] + dmatrix![0.0, skew; -skew, 0.0] * 2f64.powi(-power / 2);
                let Ok(factor) = Factor::new(&mass) else { continue };
                let found = factor.halves(&dmatrix![1.0, -1.0]);
                let w: f64 = (0..2).map(|v| found.left[v] * found.right[v] / found.pivots[v]).sum();
                let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|place| exact(mass[place]));
                let determinant = a.clone() * d.clone() - b.clone() * c.clone();
                let true_w = (a + b + c + d) / determinant;
                let wrong = Scalar::to_f64(&((exact(w) - true_w.clone()) / true_w)).abs();
                let allowed = (lost(&mass) + 16.0) * EPSILON;
                assert!(wrong <= allowed, "2^-{power}, {skew}: {wrong:e} of {allowed:e}");
                (most, seen) = (most.max(wrong), seen + 1);
            }
        }
        assert!(seen > 100 && most > 1e-6, "{seen} {most:e}");
    }
}
