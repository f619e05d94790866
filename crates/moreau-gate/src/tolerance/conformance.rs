//! Tolerances of [`crate::conformance`]: a probe tells a mistake of an adapter, which is off by a whole quantity, from the
//! errors of a sound engine, which vanish with h or are rounding.

/// The time step of the probes \[s\]: 1/256, so that times and durations are exact.
/// Set.
pub const STEP: f64 = 1.0 / 256.0;

/// Relative rounding of a state that passes through an engine of precision ε. The state is converted to the engine's coordinates and back.
/// Each conversion turns it by a quaternion, in fewer than 32 operations.
/// Derived.
pub fn same_state(epsilon: f64) -> f64 {
    2.0 * 32.0 * epsilon
}

/// How far \[m\] a body with a prescribed velocity \[m/s\] may be from its place after so many steps of [`STEP`]: its way is rounded in
/// each, and it is converted, see [`same_state`]; a place of 1 m more.
/// Derived.
pub fn kept_velocity(epsilon: f64, speed: f64, steps: usize) -> f64 {
    same_state(epsilon) * (1.0 + steps as f64 * speed * STEP) + epsilon * steps as f64
}

/// How far the mean angular velocity of an interval may be from the mean of its ends: Δt |ω|². Euler's equations give |ω̇| ≤ |ω|², because
/// the moments of a rigid body satisfy |I₁ − I₂| ≤ I₃. A first-order scheme turns by the velocity of one end, which is off by ½ Δt |ω̇|.
/// The scheme's own error in ω gets as much again.
/// Derived.
pub fn mean_angular_velocity(interval: f64, angular_speed: f64) -> f64 {
    interval * angular_speed * angular_speed
}

/// How far a velocity in free fall may be from v₀ + g t, in units of g t: half of one step of the probe's 12. So a missing step is found.
/// Derived.
pub const FREE_FALL: f64 = 1.0 / 24.0;

/// How far the balance m Δv = m g Δt + Σ r of an interval may be off, relative to the largest term of the whole motion's intervals. The
/// mistakes looked for (a force for an impulse, another interval, another sign, one step of several) are off by the term itself, or at
/// rest by the weight's impulse; engines in single precision by 2⁻²⁴ and those that report forces at the start of a step by O(h).
/// Required: of every adapter, by `moreau protocol-check`.
pub const MOMENTUM: f64 = 1.0 / 8.0;

/// How far the coefficient of restitution ½ of one impact may be off. The ball has 1/16 of a step's way left, and an engine that uses up
/// the gap in the step of the impact loses 1/16. An engine that pushes out a depth may be off by as much again, and by the part of the
/// speed that it declares. The mistakes looked for are
/// no restitution and the product e² of two materials, which are off by ½ and ¼.
/// Derived.
pub const RESTITUTION: f64 = 1.0 / 8.0;

/// How far u may be from W r + u_free, relative to the larger of the two. A mistake is off by a whole term (`shift`). A solver of any
/// accuracy is off by the rounding of the product only.
/// Required: of every adapter, by `moreau protocol-check`.
pub const SOLUTION: f64 = 1.0 / 1024.0;

/// How far a projection of a point of size 1 may be off: single precision with 32 operations, far below the unit the mistakes are off by.
/// Derived.
pub const PROJECTION: f64 = 32.0 * f32::EPSILON as f64;
