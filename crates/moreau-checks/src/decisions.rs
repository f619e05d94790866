//! Checks of exact decisions on matrices and of the certificate of an LCP, on cases whose answer is known by hand.

use crate::finding::Finding;
use moreau_contact::problem::Lcp;
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// Whether a matrix has a property.
pub type Decides = fn(&DMatrix<Rational>) -> Result<bool>;

/// A matrix in tenths, by rows, and whether it has the property.
type Case = (&'static [i64], bool);

fn decided(subject: &Decides, cases: &[Case]) -> Result<Vec<Finding>> {
    let of = |(entries, expected): &Case| {
        let size = (1..).find(|n| n * n >= entries.len()).unwrap_or(1);
        let matrix = DMatrix::from_row_slice(size, size, &entries.iter().map(|&x| ratio(x, 10)).collect::<Vec<_>>());
        Ok(Finding::decision(format!("{entries:?} over ten"), subject(&matrix)?, *expected))
    };
    cases.iter().map(of).collect()
}

/// xᵀM x ≥ 0 for all x.
///
/// # Errors
/// Those of the decision.
pub fn semidefinite(subject: &Decides) -> Result<Vec<Finding>> {
    decided(
        subject,
        &[
            (&[0], true),
            (&[10, 10, 10, 10], true),
            // both leading minors are 0, and (0, 1) shows −1
            (&[0, 0, 0, -10], false),
            // the diagonal is positive, and (1, −1) shows −2
            (&[10, 20, 20, 10], false),
            // the determinant is positive, and every x shows a negative number
            (&[-10, 0, 0, -10], false),
            // the symmetric part is the identity
            (&[10, 40, -40, 10], true),
            // the symmetric part is [[1, −2], [−2, 1]]; the matrix has the eigenvalue 1 alone
            (&[10, -40, 0, 10], false),
        ],
    )
}

/// xᵀM x ≥ 0 for all x ≥ 0.
///
/// # Errors
/// Those of the decision.
pub fn copositive(subject: &Decides) -> Result<Vec<Finding>> {
    decided(
        subject,
        &[
            // (x₁ − x₂)²-like: semidefinite, with negative entries
            (&[10, -10, -10, 10], true),
            // no negative entry, and (1, −1) shows −2
            (&[0, 10, 10, 0], true),
            (&[10, -20, -20, 10], false),
            // every pair is copositive, as 6/10 < 1, and (1, 1, 1) shows 3 − 36/10
            (&[10, -6, -6, -6, 10, -6, -6, -6, 10], false),
            (&[-1], false),
            // xᵀM x = 2 x₁x₂ of its symmetric part, with a negative entry
            (&[0, 30, -10, 0], true),
        ],
    )
}

/// Copositive, and xᵀM x = 0 with x ≥ 0 only where (M + Mᵀ) x = 0.
///
/// # Errors
/// Those of the decision.
pub fn copositive_plus(subject: &Decides) -> Result<Vec<Finding>> {
    decided(
        subject,
        &[
            (&[0], true),
            (&[10, -10, -10, 10], true),
            // x = (1, 0) shows 0, and (M + Mᵀ) x = (0, 2)
            (&[0, 10, 10, 0], false),
            // the same x, and (M + Mᵀ) x = 0: a skew matrix
            (&[0, 10, -10, 0], true),
            (&[-1], false),
        ],
    )
}

/// Every principal minor is positive.
///
/// # Errors
/// Those of the decision.
pub fn p_matrix(subject: &Decides) -> Result<Vec<Finding>> {
    decided(
        subject,
        &[
            (&[10, 0, 0, 10], true),
            // minors 1, 1 and 1, and (1, 1) shows −1
            (&[10, -30, 0, 10], true),
            // the leading minors are 1 and 1, and M₂₂ = −1
            (&[10, -20, 10, -10], false),
            (&[0], false),
            // every diagonal entry is positive, and the determinant is −3
            (&[10, 20, 20, 10], false),
            // the determinant is positive, and M₁₁ = −1
            (&[-10, 0, 0, -10], false),
        ],
    )
}

/// Whether z solves an LCP.
pub type Solves = fn(&Lcp<Rational>, &DVector<Rational>) -> bool;

/// 0 ≤ z ⟂ M z + q ≥ 0 with M = [[2, 1], [0, 2]] and q = (−1, 1), and with q = (−1, −1), whose solution has both entries.
///
/// # Errors
/// None.
pub fn lcp(subject: &Solves) -> Result<Vec<Finding>> {
    let numbers = |entries: &[i64]| entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>();
    let lcp = |q: [i64; 2]| Lcp::new(DMatrix::from_row_slice(2, 2, &numbers(&[2, 1, 0, 2])), DVector::from_vec(numbers(&q)));
    let z = |entries: [Rational; 2]| DVector::from_vec(entries.to_vec());
    let cases = [
        ("the solution", [-1, 1], z([ratio(1, 2), ratio(0, 1)]), true),
        ("the solution with both entries", [-1, -1], z([ratio(1, 4), ratio(1, 2)]), true),
        // w = (0, 0)
        ("a negative entry of z", [-1, 1], z([ratio(3, 4), ratio(-1, 2)]), false),
        // w = (−1, 1)
        ("a negative entry of w", [-1, 1], z([ratio(0, 1), ratio(0, 1)]), false),
        // w = (1, 1)
        ("a positive product", [-1, 1], z([ratio(1, 1), ratio(0, 1)]), false),
        ("2⁻⁶⁰ beside the solution", [-1, 1], z([ratio(1, 2) + ratio(1, 1 << 60), ratio(0, 1)]), false),
    ];
    Ok(cases.into_iter().map(|(name, q, z, expected)| Finding::decision(name, subject(&lcp(q), &z), expected)).collect())
}
