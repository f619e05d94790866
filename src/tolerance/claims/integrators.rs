//! Claims on integrators (§8).

use super::super::rounding;

pub use moreau_dynamics::tolerance::integrators::BESIDE;

/// What 40 bisections of (0, 1/64) s leave of an interval \[s\].
/// Derived.
pub const BISECTED: f64 = 1.0 / (1u64 << 46) as f64;

/// What 40 bisections of (0, 16) leave of s = hω, and the rounding of a closed form of s below 9 in fewer than 32 operations.
/// Derived.
pub fn end_of_stable_steps() -> f64 {
    16.0 / (1u64 << 40) as f64 + rounding(32, 9.0)
}

/// How far the loss of energy of implicit Euler at h = 1/32 over that at 1/64 may be from 2 (over a fixed time) or 4 (in a step): with
/// ln(1 + h²)/h = h − h³/2 + … the loss is h − h²/2 + O(h³) over a unit time and h² − h⁴ + … in a step, so that the ratios are
/// 2 − h/2 + O(h²) and 4 − 3h² + …; 2h covers both.
/// Derived.
pub const HALVED: f64 = 2.0 / 32.0;

/// Rounding of q⁺ − q − h v⁺ \[m\] of a stored fall: eight operations of the engine and of ours on coordinates below 2 m.
/// Derived.
pub const FALL: f64 = 2.0 * 8.0 * 2.0 * f64::EPSILON;

/// Rounding of the place of a thrown body \[m\]: 36 steps, each an addition of a rounded product to coordinates below 16 m.
/// Derived.
pub const PROJECTILE: f64 = 2.0 * 40.0 * 16.0 * f64::EPSILON;

/// Relative rounding of the largest |q| in n steps of semi-implicit Euler with s within 1/100 of 2: eight operations a step, and the
/// powers of
/// the step are below 20, those that grow beside their growth; an error of ε in s² turns or grows the motion by 10 ε a step, which this
/// covers.
/// Derived.
pub fn vibrated(steps: usize) -> f64 {
    rounding(8 * steps, 20.0)
}
