//! How far two motions may differ that the laws of mechanics map to each other ([`crate::checks::metamorphic`]).
//!
//! A covariant scheme gives the same numbers up to rounding, and up to what its solver leaves, a part [`SOLVED`] of every change of
//! velocity, whichever solver is used:
//! ```text
//!     changes of velocity     ≤ 2 (speed + g T)     fall, landing and friction without restitution
//!     velocity                SOLVED · 2 (speed + g T)
//!     position                T · velocity ,      orientation   T · velocity/arm
//! ```
//! Errors add up without growth: a step with contacts is a projection in the norm of the kinetic energy, hence non-expansive, where the
//! friction bounds do not depend on the answer, as in these scenes. Compliant bodies rebound, and a turn of 1e-3 rad/s can decide in which
//! step a corner lands again: such growth is not allowed for, because an engine whose law is covariant differs by rounding and has nothing
//! to grow.

use super::SOLVED;

/// Difference of velocities \[m/s\] from speeds up to `speed` \[m/s\], gravity g \[m/s²\] and the duration T \[s\].
/// Derived.
pub fn velocity(speed: f64, gravity: f64, duration: f64) -> f64 {
    SOLVED * 2.0 * (speed + gravity * duration)
}

/// Whether a depth of which every step takes back a part r falls below what solvers leave, [`SOLVED`], within n steps: (1 − r)ⁿ ≤ s.
/// Derived.
pub fn vanishes(reduction: f64, steps: f64) -> bool {
    reduction > 0.0 && steps * (1.0 - reduction.min(1.0 - f64::EPSILON)).ln() <= SOLVED.ln()
}

/// Error of a velocity \[m/s\] because of a distance L \[m\] from the origin. Positions are spaced ε L apart. A scheme that computes
/// velocities from gaps is off by ε L/h in each of T/h steps. A scheme that does not is not off.
/// Derived.
pub fn far_velocity(epsilon: f64, distance: f64, duration: f64, h: f64) -> f64 {
    epsilon * distance / h * (duration / h)
}

/// Error of a position \[m\] because of a distance L \[m\] from the origin: T/h roundings of ε L, and the error of the velocity times T.
/// Derived.
pub fn far_position(epsilon: f64, distance: f64, duration: f64, h: f64) -> f64 {
    epsilon * distance * (duration / h) + duration * far_velocity(epsilon, distance, duration, h)
}

/// Difference of velocities \[m/s\] that friction without symmetry about the normal may cause, with the friction coefficient μ and the
/// normal impulse per mass J \[m/s\] of the whole motion.
///
/// Each of two motions gets at most `strength` μ J of friction impulse per mass, in directions that are at most twice the direction error
/// apart: with d directions on the circle the forces differ by the chord 2 sin(π/d) at the same slip, and friction being monotone the
/// motions differ by no more; a pyramid around the cone has forces up to √2 μ and any direction, 2√2.
/// Derived.
pub fn anisotropy(directions: Option<usize>, friction: f64, normal_impulse: f64) -> f64 {
    let chord = directions.map_or(2.0 * std::f64::consts::SQRT_2, |d| 2.0 * (std::f64::consts::PI / d as f64).sin());
    chord * friction * normal_impulse
}

/// Where a linear damping c \[1/s\] of every velocity leaves a frame that moves with V \[m/s\], after T \[s\]: V(1 − e^(−cT)) in velocity
/// and V(T − (1 − e^(−cT))/c) in position; and how far a first-order damping, v⁺ = (1 − c h) v or v/(1 + c h), may be from it: relative
/// error c²h T/2 in velocity, T times that and c h T (the rectangle rule of the path) in position.
/// Derived.
pub fn damped_frame(speed: f64, damping: f64, duration: f64, h: f64) -> [(f64, f64); 2] {
    let lost = -(-damping * duration).exp_m1();
    let velocity_error = 0.5 * damping * damping * h * duration * speed;
    let position = if damping > 0.0 { speed * (duration - lost / damping) } else { 0.0 };
    [(speed * lost, velocity_error), (position, duration * velocity_error + damping * h * duration * speed)]
}

/// Difference \[m/s\] of the horizontal velocity of a landed, sliding block at steps h and h/2: μ g (h + h/2). Both motions have friction μ
/// per normal impulse, and both normal impulses bring the same body to rest. So only a step of gravity may be counted late, once in each
/// motion.
/// Derived.
pub fn halved_velocity(friction: f64, gravity: f64, h: f64) -> f64 {
    1.5 * friction * gravity * h
}

/// Difference \[m\] of positions at steps h and h/2 of bodies that land without restitution at speeds up to v. Each motion is off by at
/// most 2 h v vertically, because the contact is found up to a step late and acts in the next step. Along the floor it is off by h times
/// the variation of its velocity.
/// Derived.
pub fn halved_position(landing_speed: f64, friction: f64, normal_impulse: f64, h: f64) -> f64 {
    1.5 * h * (2.0 * landing_speed + 3.0 * friction * normal_impulse)
}
