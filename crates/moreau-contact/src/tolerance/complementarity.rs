//! Sizes up to which linear complementarity problems are decided, and limits of their pivoting.

use moreau_exact::scalar::Scalar;

/// Products of machine words after which a search among complementary cones ends undecided, 2³¹: ten seconds or so. It is counted, not
/// timed, so that the same problem ends in the same way everywhere.
/// Set.
pub const CONE_WORK: u64 = 1 << 31;

/// Solutions after which such a search ends undecided: they are kept, all together some hundred megabytes at most.
/// Set.
pub const CONE_SOLUTIONS: usize = 1 << 16;

/// Complementary cones with more than one solution each of which it is asked whether velocities move on them: a linear program in fractions
/// for every row, milliseconds each.
/// Set.
pub const WIDE_CONES: usize = 1 << 12;

/// Products of machine words of a pivot over so many entries of so many bits, about: a product of numbers of w words takes w² of them, and
/// what does not grow with w as much as four more words.
/// Set.
pub fn words_of_work(entries: usize, bits: usize) -> u64 {
    let words = (bits / 64 + 5) as u64;
    entries as u64 * words * words
}

/// Principal minors that are computed in fractions, because intervals leave their sign open, before it is left undecided whether a matrix
/// is a P-matrix: all of eight rows, and a few seconds of twenty.
/// Set.
pub const EXACT_MINORS: usize = 1 << 8;

/// Powers of two by which the largest entries of two rows differ, or of two columns, up to which they are of one size: what pivots take
/// for rounding is 2⁻⁴⁰ of the largest entry, and 2⁻³² of a row that is smaller by so much.
/// Set.
pub const ONE_SIZE: i32 = 8;

/// Rounds in which rows and columns are brought to one size, one after the other: after four nothing changes on drawn problems.
/// Set.
pub const BALANCING_ROUNDS: usize = 8;

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

/// Rows of a problem up to which a solution is searched for among all complementary cones by a solver, as long as
/// [`CONE_WORK`] suffices.
/// Set.
pub const SEARCHED_ROWS: usize = 40;

/// Pivots after which principal pivoting ends. On usual problems there are a small multiple of n; on Murty's and Fathi's examples 2ⁿ, so
/// that n = 16 is the largest of these that is solved.
/// Set.
pub const PRINCIPAL_PIVOTS: usize = 1 << 16;

/// Pivots for each row at which the parameter of parametric pivoting does not fall, after which they count as going round in a circle.
/// Set.
pub const PIVOTS_AT_ONE_PARAMETER: usize = 4;

/// A prime: i² k modulo it, for i up to half of it, are different numbers without a pattern.
/// Set.
pub const COVERING_MODULUS: i64 = 10_007;

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
