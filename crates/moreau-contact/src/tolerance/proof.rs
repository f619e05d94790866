//! Bounds of rounding in proofs: what is added to a rounded number so that it is a bound.

use moreau_exact::tolerance::EPSILON;

/// A bound from above of a sum of so many non-negative terms, each the rounded result of at most four operations, from the rounded sum:
/// γ_{n+4} ≤ 2 (n + 4) ε, a last rounding, and n times the smallest normal number for products that underflow.
/// Derived.
pub fn enlarged(sum: f64, terms: usize) -> f64 {
    let terms = (terms + 4) as f64;
    (sum * (1.0 + 2.0 * terms * EPSILON) + terms * f64::MIN_POSITIVE).next_up()
}

/// The error of a sum of n products whose absolute values sum to `magnitude`, when the errors of all products and sums are summed
/// apart and added at the end: with the unit roundoff u = ε/2 they sum to at most (n + 2) u times the magnitude, 2n sums of them err by at
/// most 2.1 n u times that, and the rounded magnitude is too small by at most γ_n; 4 n (n + 2) u² bounds it for n < 2²⁰. Each product may
/// lose a number below the smallest normal one besides.
///
/// Source: T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005), §5, with larger constants.
/// Derived.
pub fn compensated(terms: usize, magnitude: f64) -> f64 {
    let n = terms as f64;
    enlarged(n * (n + 2.0) * EPSILON * EPSILON * magnitude, terms)
}

/// |fl(C J) − C J| ≤ γ_n |C| |J| entry by entry, in whatever order and with or without fused operations (Higham, §3.5): this γ_n, n the
/// inner size, with ε in place of u = ε/2.
/// Derived.
pub fn product(inner: usize) -> f64 {
    super::certificate::gamma(inner + 2)
}

/// An entry of the Jacobian D_r + D_y A is a sum of four products of rounded numbers: 8 u relative to the sum of their sizes.
/// Derived.
pub const ENTRY: f64 = 4.0 * EPSILON;

/// How much larger than what is needed a box begins, and how much it grows when it was too small: a box that is twice as large needs a
/// contraction of one half.
/// Set.
pub const INFLATION: f64 = 2.0;

/// Part of an impulse that a box is never smaller than, 2⁻⁵⁰: four times the spacing of its numbers.
/// Set.
pub const SMALLEST_BOX: f64 = 4.0 * EPSILON;

/// Boxes that are tried. Their size doubles at most, so that the last is 2¹² times the first.
/// Set.
pub const BOXES: usize = 12;

/// Corrections by Newton's method from the answer. It doubles the digits of an answer; a stored one has eight or more.
/// Set.
pub const CORRECTIONS: usize = 6;

/// How often the pattern of open, sticking and sliding contacts is read off again.
/// Set.
pub const PATTERNS: usize = 4;

/// Most rows with an impulse: their matrices are dense, three of 3000² take 216 MB and a second or two.
/// Set.
pub const ROWS: usize = 3000;

/// ε times the rows: below this part of the largest a pivot is rounding.
/// Derived.
pub fn dependent_pivot(rows: usize) -> f64 {
    (rows as f64 + 8.0) * EPSILON
}

/// Most multiplications for deciding a rank, a few seconds.
/// Set.
pub const RANK_STEPS: f64 = 2e9;

/// Most rows of a matrix whose definiteness is decided in fractions: a second at most.
/// Set.
pub const EXACT_ROWS: usize = 40;

/// Weights α of the condition for uniqueness, relative to √(W_nn W_tt) of the contact. They only decide which of the problems that have one
/// solution are seen to.
/// Set.
pub const WEIGHTS: [f64; 7] = [1.0, 0.5, 2.0, 0.25, 4.0, 0.125, 8.0];

/// Most contacts of a problem for which a witness is searched by a linear program in fractions: seconds at most.
/// Set.
pub const WITNESS_CONTACTS: usize = 12;

/// Most contacts in the plane all of whose patterns are tried, 4⁶ = 4 096 linear systems in fractions.
/// Set.
pub const PATTERN_CONTACTS: usize = 6;

/// Difference of two velocities, relative to the largest one, up to which an answer is not tried a second time. An answer that could be
/// proved to be another one all the same is missed.
/// Set.
pub const AGAIN: f64 = 1e-9;
