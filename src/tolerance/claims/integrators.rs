//! Claims on integrators (§8).

/// Relative distance at which a step is tried on either side of a bound that is known to rounding, 2⁻⁴⁰ = 4096 ε: the closed forms have
/// fewer than 32 operations of relative error ε, so the true bound lies between the two.
pub const BESIDE: f64 = 1.0 / (1u64 << 40) as f64;
