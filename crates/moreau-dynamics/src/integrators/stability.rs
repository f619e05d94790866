//! Whether the powers of a real 2×2 matrix stay bounded, decided by its trace T and determinant D (Jury's conditions).
//!
//! ```text
//!     ρ < 1  iff  |D| < 1 and |T| < 1 + D                     ρ ≤ 1  iff  |D| ≤ 1 and |T| ≤ 1 + D
//!     ρ = 1:  ‖Aⁿ‖ is bounded unless T² = 4D and A ≠ (T/2) I  (a Jordan block at ±1), when it grows like n
//! ```
//! Over rationals nothing is rounded, so that both sides of a boundary, and the boundary itself, are told apart.

use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};
use nalgebra::DMatrix;

/// What becomes of ‖Aⁿ‖ as n grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Powers {
    /// It tends to zero, ρ < 1.
    Decay,
    /// It stays bounded and does not tend to zero.
    Bounded,
    /// It grows like n: a Jordan block on the unit circle.
    GrowLinearly,
    /// It grows like ρⁿ, ρ > 1.
    GrowExponentially,
}

impl Powers {
    fn word(self) -> &'static str {
        match self {
            Powers::Decay => "decay",
            Powers::Bounded => "bounded",
            Powers::GrowLinearly => "grow-linearly",
            Powers::GrowExponentially => "grow-exponentially",
        }
    }
}

/// Trace and determinant.
pub fn invariants<T: Scalar>(matrix: &DMatrix<T>) -> [T; 2] {
    assert_eq!(matrix.shape(), (2, 2), "trace and determinant decide for 2×2 matrices only");
    let entry = |i: usize, j: usize| matrix[(i, j)].clone();
    [entry(0, 0) + entry(1, 1), entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0)]
}

/// What becomes of the powers of a 2×2 matrix.
///
/// # Panics
/// If the matrix is not 2×2.
///
/// ```
/// use moreau_dynamics::integrators::stability::{Powers, powers};
/// use moreau_exact::scalar::ratio;
/// use nalgebra::dmatrix;
///
/// // semi-implicit Euler on q̈ = −q, in s = h: stable below 2, and 2 itself grows
/// let step = |s| dmatrix![ratio(1, 1) - ratio(s, 10) * ratio(s, 10), ratio(s, 10); -ratio(s, 10), ratio(1, 1)];
/// assert_eq!([19, 20, 21].map(|s| powers(&step(s))), [Powers::Bounded, Powers::GrowLinearly, Powers::GrowExponentially]);
/// ```
pub fn powers<T: Scalar>(matrix: &DMatrix<T>) -> Powers {
    decided(
        || by_jury(matrix),
        |found| {
            let matrix: &DMatrix<Rational> = rational(matrix)?;
            Some(Witness::new("powers", vec![("matrix", matrix.into()), ("answer", Part::Word(found.word()))]))
        },
    )
}

fn by_jury<T: Scalar>(matrix: &DMatrix<T>) -> Powers {
    let [trace, determinant] = invariants(matrix);
    let (size, room) = (trace.magnitude(), T::one() + determinant.clone());
    if determinant.magnitude() > T::one() || size > room {
        Powers::GrowExponentially
    } else if determinant.magnitude() < T::one() && size < room {
        Powers::Decay
    } else {
        let double = trace.clone() * trace.clone() == T::ratio(4, 1) * determinant;
        let scalar = matrix[(0, 1)].is_zero() && matrix[(1, 0)].is_zero();
        if double && !scalar { Powers::GrowLinearly } else { Powers::Bounded }
    }
}

/// ρ, the largest modulus of an eigenvalue of a 2×2 matrix.
///
/// # Panics
/// If the matrix is not 2×2.
pub fn spectral_radius(matrix: &DMatrix<f64>) -> f64 {
    let [trace, determinant] = invariants(matrix);
    let half = 0.5 * trace;
    let square = half * half - determinant;
    if square < 0.0 { determinant.sqrt() } else { half.abs() + square.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    fn judged(entries: [i64; 4], denominator: i64) -> Powers {
        powers(&DMatrix::from_row_slice(2, 2, &entries.map(|x| ratio(x, denominator))))
    }

    #[test]
    fn powers_of_matrices_with_known_eigenvalues() {
        assert_eq!(judged([0, -1, 1, 0], 1), Powers::Bounded); // ±i
        assert_eq!(judged([1, 0, 0, 1], 1), Powers::Bounded); // 1, 1, no block
        assert_eq!(judged([1, 1, 0, 1], 1), Powers::GrowLinearly); // 1, 1, a block
        assert_eq!(judged([-1, 0, 7, -1], 1), Powers::GrowLinearly); // −1, −1, a block
        assert_eq!(judged([1, 5, 0, -1], 1), Powers::Bounded); // 1, −1
        assert_eq!(judged([1, 5, 0, 0], 2), Powers::Decay); // ½, 0
        assert_eq!(judged([-3, 0, 0, 1], 2), Powers::GrowExponentially); // −3/2, ½
        assert_eq!(judged([0, -5, 4, 0], 4), Powers::GrowExponentially); // ±i √(5/4)
        assert_eq!(judged([2, 0, 0, 1], 2), Powers::Bounded); // 1, ½
    }

    #[test]
    fn the_spectral_radius_is_that_of_real_and_of_complex_pairs() {
        assert_eq!(spectral_radius(&DMatrix::from_row_slice(2, 2, &[-3.0, 1.0, 0.0, 2.0])), 3.0);
        assert_eq!(spectral_radius(&DMatrix::from_row_slice(2, 2, &[0.0, -4.0, 1.0, 0.0])), 2.0);
    }
}
