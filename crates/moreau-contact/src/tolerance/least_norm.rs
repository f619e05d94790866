//! Tolerances of [`crate::solvers::least_norm`].

use moreau_exact::tolerance::EPSILON;

/// What is added to the diagonal of A J Aᵀ, relative to ‖A‖²: ε, below which its entries are rounding. Dependent rows have a factor so, and
/// the steps only become a little shorter.
/// Derived.
pub const SOFTNESS: f64 = EPSILON;

/// ‖A r* − A r‖/‖A r*‖ at which it ends: 2¹² ε, as the solvers' stop.
/// Set.
pub const ENDED: f64 = 4096.0 * EPSILON;

/// Most steps.
/// Set.
pub const STEPS: usize = 200;

/// Part of the predicted gain that a step must have (Armijo).
/// Set.
pub const SHARE: f64 = 1e-4;

/// Shortest part of a step that is tried: beyond, rounding decides.
/// Set.
pub const SHORTEST: f64 = 1.0 / (1u64 << 30) as f64;
