//! Claims on impact laws (§7).

/// Half a unit in the last of six printed decimals.
/// Derived.
pub const SIX_DECIMALS: f64 = 0.5e-6;
