//! Claims on penetration, drift, energy and jitter (§9, §10 and the troubleshooting manual).

use super::super::{rounding, solvers::STOP};

/// Rounding of |q| after n steps along the unit circle at unit speed \[m\]: 32 operations of size 1 a step, and no step makes the
/// errors of the ones before grow (both maps are projections followed by a shift along the circle).
/// Derived.
pub fn bead_rounding(steps: usize) -> f64 {
    rounding(32 * steps, 1.0)
}

/// Rounding of the height \[m\] of a tower of n bodies that fall by at most h g per sweep: each of the k sweeps of each step does 4
/// operations per contact on velocities below 1 m/s, and the sweeps contract.
/// Derived.
pub fn tower_rounding(bodies: usize, sweeps: usize, steps: usize) -> f64 {
    rounding(4 * bodies * bodies * sweeps * steps, 1.0)
}

/// Speed \[m/s\] that n bodies under at most 10 m/s² may have after N steps h with a solver that stops at the relative natural map
/// [`STOP`]: impulses have a norm of at most 10 n² h, each contact approaches with at most W_kk = 2 times the map, n contacts add up, and
/// what one step leaves is part of the next.
/// Derived.
pub fn solved_speed(bodies: usize, h: f64, steps: usize) -> f64 {
    let impulses = 10.0 * h * (bodies * bodies) as f64;
    2.0 * STOP * impulses * (bodies * steps) as f64
}

/// Height \[m\] that these bodies may lose in N steps.
/// Derived.
pub fn solved_tower(bodies: usize, h: f64, steps: usize) -> f64 {
    solved_speed(bodies, h, steps) * h * steps as f64
}

/// Rounding of E/E₀ after n steps of an elastic ball: 16 operations a step on energies of size E₀, with condition number two.
/// Derived.
pub fn elastic_drop(steps: usize) -> f64 {
    rounding(32 * steps, 1.0)
}

/// Rounding of the ratio of two velocities of size `left` \[m/s\] that k sweeps over n contacts leave of 1 m/s or less.
/// Derived.
pub fn sweep_ratio(bodies: usize, sweeps: usize, left: f64) -> f64 {
    tower_rounding(bodies, sweeps, 1) / left
}

/// Relative rounding of the depth or creep at which a contact comes to rest: some 64 operations, each of condition number of order one, and
/// what a contraction by at most ¾ leaves after 200 steps is far below.
/// Derived.
pub const AT_REST: f64 = 256.0 * f64::EPSILON;

/// Speed \[m/s\] of a contact at rest: velocities are differences of numbers of size g h.
/// Derived.
pub fn rest_speed(gravity: f64, h: f64) -> f64 {
    rounding(64, gravity * h)
}

/// Half a unit in the last of four printed digits, relative.
/// Derived.
pub const FOUR_DIGITS: f64 = 5e-5;

/// Sweeps by which a predicted count may be off: the stopping rule is met one sweep earlier or later by rounding, and is tested with the
/// current impulses, not with the final ones that the prediction uses.
/// Derived.
pub const SWEEP_COUNT: f64 = 2.0;

/// Creep \[m/s\] against its closed form: relative rounding, and that of a velocity of size g h ≤ 0.1 m/s that a block at rest has lost.
/// Derived.
pub fn creep(expected: f64) -> f64 {
    AT_REST * expected + rounding(64, 0.1) + STOP * 0.1
}

/// Half a unit in the last of five printed decimals.
/// Derived.
pub const FIVE_DECIMALS: f64 = 0.5e-5;

/// By how many the number of events that fit into ε of T∞ may be off: the prediction counts to one, and below ε T∞ the sum of times has
/// an error of the number of its terms times ε, that is log₂ 64 = 6 events more or fewer at e = ½.
/// Derived.
pub const LAST_EVENTS: f64 = 7.0;

/// Error of the condition number of a symmetric 2×2 matrix with entries of size up to 1 + κ: the smallest eigenvalue, 2, is the difference
/// of two numbers of that size.
/// Derived.
pub fn condition(condition: f64) -> f64 {
    rounding(16, (1.0 + condition) * (1.0 + condition))
}
