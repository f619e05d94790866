//! Tolerances of the engines' own iterations.

/// Relative gradient, √ε, from which on a smooth convex step is in the phase in which Newton's method squares its error: the next
/// gradient is at
/// the rounding floor, and one that does not fall has met it.
/// Set.
pub const NEAR_MINIMUM: f64 = 1.0 / 67_108_864.0;

/// Steps of its line search: bisection alone halves a bracket 53 times until its ends are neighbours.
/// Set.
pub const LINE_STEPS: usize = 2 * 53;

/// Steps of conjugate gradients: on a quadratic with condition κ ≤ 10⁶ an error falls by e⁻²⁸ =
/// [`STOP`](moreau_contact::tolerance::solvers::STOP) in 14 √κ = 14 000.
/// Set.
pub const CONJUGATE_STEPS: usize = 14_000;

/// Steps in a row without progress after which conjugate gradients end. Their gradient does not fall in every step: nv directions make one
/// round, and nv is about 100 at most here.
/// Set.
pub const CONJUGATE_STALLED: usize = 100;

/// PyBullet's default `solverResidualThreshold` \[m²/s²\].
/// Set.
pub const BULLET_RESIDUAL: f64 = 1e-7;
