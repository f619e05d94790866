//! Tolerances of [`crate::integrators`].

use moreau_exact::tolerance::EPSILON;

/// Entries of DᵀJD − J of a step with an impact, of size 10 and computed from fewer than 1024 operations of relative error ε.
/// Derived.
pub const VARIATIONAL_STEP: f64 = 2.0 * 1024.0 * 10.0 * EPSILON;

/// Error of a condition of order of Dormand–Prince's continuous extension: its published coefficients are fractions accurate to ten
/// digits, at most 12 in size, summed over seven stages.
/// Derived.
pub const PUBLISHED_EXTENSION: f64 = 7.0 * 12.0 * 0.5e-10;

/// Relative distance at which a step is tried on either side of a bound that is known to rounding, 2⁻⁴⁰ = 4096 ε: the closed forms have
/// fewer than 32 operations of relative error ε, so the true bound lies between the two.
/// Derived.
pub const BESIDE: f64 = 1.0 / (1u64 << 40) as f64;
