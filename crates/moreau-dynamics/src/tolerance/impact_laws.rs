//! Tolerances of [`crate::impact_laws`].

/// Rounds after which a sequence of single impacts is given up. The sequence may be infinite, and exact rationals grow by some bits per
/// round. The chains of balls in use end after at most four rounds.
/// Set.
pub const SEQUENCE_LIMIT: usize = 64;
