//! When a row of a joint depends on others.

use moreau_exact::tolerance::EPSILON;

/// Part of W_ii that may be left of a diagonal entry once the rows are eliminated that it depends on: sums of up to 1000 products, each
/// rounded twice, behind pivots of at least a half, as of joints that repeat each other: 4000 ε, 9e-13.
/// Derived.
pub const DEPENDENT: f64 = 4000.0 * EPSILON;

/// Part of W_ii that a pivot must have kept for its row to count as independent, 2⁻²⁴: what is divided by it is right to seven digits at
/// least. A row between the two is left to fractions or refused, for nothing tells whether it is independent.
/// Set.
pub const INDEPENDENT: f64 = 1.0 / (1u64 << 24) as f64;

/// Part of its terms up to which the velocity that is left of a dependent row is rounding; above it the rows contradict each other. What is
/// below is left to the certificate. A witness that contacts have no solution is held against the same, and so is what an answer misses by.
/// Required: of every joint that is taken, by the users of the certificate.
pub const AGREES: f64 = 1e-9;

/// Rows up to which joints are eliminated in fractions, to see whether a problem has a solution where rounded numbers say that it has none:
/// less than a second.
/// Set.
pub const EXACT_ROWS: usize = 60;
