//! Tolerances of the first-order methods.

/// Relative asymmetry max|W − Wᵀ|/max|W| up to which solvers for a symmetric W try one that is not: a per cent. Files with six digits have
/// 1e-6 to 1e-3. The certificate judges the answer with the W that was given.
/// Set.
pub const SLIGHTLY: f64 = 0.01;

/// Most convex problems of de Saxcé's fixed point. Where it contracts by a half each time, 50 reach the spacing of the numbers.
/// Set.
pub const SUBPROBLEMS: usize = 200;

/// Smallest share θ of a step of de Saxcé's fixed point: 2⁻⁵. With it a map of slope −30 still contracts.
/// Set.
pub const LEAST_SHARE: f64 = 1.0 / 32.0;

/// Part of F(s) − s that may be left where it turned round for a step not to be too long: half. Of a map of slope −L, 1 − θ(1 + L) is left:
/// where that is below −½, half of θ leaves between −¼ and ½ of what was, or is still too long.
/// Derived.
pub const SWINGS: f64 = 0.5;
