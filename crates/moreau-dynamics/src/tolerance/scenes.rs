//! Tolerances of [`crate::scenes`].

/// How far a unit vector or quaternion in a file may be from length 1: up to four components written with nine
/// decimals are off by at most 5·10⁻¹⁰ each, so the length by √4 · 5·10⁻¹⁰.
/// Derived.
pub const WRITTEN_UNIT_VECTOR: f64 = 1e-9;
