//! Settings of the recovery of W = Y Yᵀ from blocks.

/// Part of the largest diagonal entry of a block below which a pivot is rounding: 2⁻³⁰. Blocks of rigid bodies have entries rounded to
/// 2⁻⁵², and what is left after the rank is used up grows by the square of their condition, some 2²⁰ at most.
/// Set.
pub const RANK: f64 = 1.0 / (1u64 << 30) as f64;

/// Relative difference between Y Yᵀ and W up to which the factor is used, 2⁻²⁴: Newton's directions are then right to seven digits, and
/// residuals are taken with W itself. It decides how many steps are made, never what is a solution.
/// Set.
pub const RECOVERED: f64 = 1.0 / (1u64 << 24) as f64;

/// Part of the rows that the velocities must be, at most, for elimination in them to pay: bodies meet fewer bodies than contacts meet
/// contacts, but adding the contacts to the fronts costs time, too.
/// Set.
pub const PAYS: f64 = 0.8;

/// How often a solution in velocities is solved for again, at most: each time wins the digits back that the first one has.
/// Set.
pub const REFINEMENTS: usize = 3;

/// Part of the right side that may be left over, 2⁻⁴⁰: Newton's method squares an error down to that.
/// Set.
pub const REFINED: f64 = 1.0 / (1u64 << 40) as f64;

/// Part of the right side that may be left over for the solution to be used at all, 2⁻²⁰; where more is left, the system is solved over
/// contacts.
/// Set.
pub const TRUSTED: f64 = 1.0 / (1u64 << 20) as f64;

/// Velocities of two rigid bodies, the largest rank of the contacts between them.
/// Derived.
pub const MOST_VELOCITIES: usize = 12;

/// Rows of the contacts between two bodies up to which their rank is asked for: the work grows with their square.
/// Set.
pub const MOST_ROWS: usize = 192;
