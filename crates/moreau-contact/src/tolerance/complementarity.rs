//! Sizes up to which linear complementarity problems are decided, and limits of their pivoting.

use moreau_exact::scalar::Scalar;

/// Sets of complementary cones that are looked at before a search ends undecided, 2¹⁶. On problems of thirty unknowns a set costs about a
/// millisecond, so that the search ends in minutes.
/// Set.
pub const CONES: usize = 1 << 16;

/// Rows of a problem up to which its solutions are decided in fractions; above it signs are decided by enclosures.
/// Required: of every proved answer to a linear complementarity problem, by the users of `moreau certify --prove`.
pub const EXACT_ROWS: usize = 100;

/// Rows of a problem up to which a sign that an enclosure leaves open is decided in fractions: hundreds of rows take seconds.
/// Set.
pub const OPEN_ROWS: usize = 400;

/// Rows that may change sides before an answer is given up as one that points to no exact solution: a handful of contacts that barely
/// touch.
/// Set.
pub const EXCHANGES: usize = 8;

/// Least trace of a matrix that is shown to be definite: 2⁻⁵⁰⁰, far above what underflow loses.
/// Set.
pub const LEAST_TRACE: f64 =
    1.0 / ((1u128 << 100) as f64 * (1u128 << 100) as f64 * (1u128 << 100) as f64 * (1u128 << 100) as f64 * (1u128 << 100) as f64);

/// Rows of a problem up to which it is decided in whole numbers whether any z ≥ 0 has M z + q ≥ 0.
/// Set.
pub const FEASIBLE_ROWS: usize = 60;

/// Rows of a problem up to which a solution is searched for among all complementary cones, as long as [`CONES`] sets of them suffice.
/// Set.
pub const SEARCHED_ROWS: usize = 40;

/// Pivots after which principal pivoting ends. On usual problems there are a small multiple of n; on Murty's and Fathi's examples 2ⁿ, so
/// that n = 16 is the largest of these that is solved.
/// Set.
pub const PRINCIPAL_PIVOTS: usize = 1 << 16;

/// Steps of Newton-min in a row without fewer negative numbers than ever, before one row at a time changes sides: ten, as Júdice and Pires
/// choose. Only the number of steps depends on it.
/// Set.
pub const FULL_STEPS: usize = 10;

/// Most steps of Newton-min. It takes some ten in full steps; one row at a time, it may take as many as there are supports.
/// Set.
pub const NEWTON_MIN_STEPS: usize = 1000;

/// What is rounding in a tableau of n rows whose data are of order one, after pivots: √n times half of the digits are kept apart from zero,
/// 2⁻⁴⁰ √n. Zero for exact rationals. What it decides wrongly is seen by the certificate.
/// Set.
pub fn negligible<T: Scalar>(rows: usize) -> T {
    if T::spacing().is_zero() { T::zero() } else { T::ratio(rows.isqrt() as i64 + 1, 1 << 40) }
}
