//! Tolerances of [`crate::impact_laws`].

/// Rounds after which a sequence of single impacts is given up: it may be infinite, and exact rationals grow by some bits a round. The
/// chains of balls in use end after at most four.
pub const SEQUENCE_LIMIT: usize = 64;
