//! Allowances of [`crate::checks::pair`]: bodies meet without gravity, so that h counts only by the distance at which their contact acts.

use super::{SOLVED, impact};

/// Distance \[m\] from each other at which a step may let surfaces touch that approach with u \[m/s\]: a contact is found a step late and
/// acts where the bodies would be after another one, or it acts a step early so that it does not close. A body's lever ends at its surface
/// or at that of the other one, anywhere between. Under an associated law, u is the approach and μ times the slip.
/// Derived.
pub fn apart(speed: f64, h: f64) -> f64 {
    2.0 * speed * h
}

/// Relative error of a ratio of impulses: the part that solvers may leave, and the rounding of the velocities.
/// Derived.
pub fn ratio(epsilon: f64) -> f64 {
    SOLVED + impact::velocity(epsilon)
}

/// Relative error of the impulse that stops a slip whose levers are off by the part δ of themselves. The slip ω l is off by δ. The response
/// 1/m + l²/J is off by 2 δ times the part that turning has in it, which is 5/7 for solid spheres: 10/7 δ, against the error of the slip.
/// Derived.
pub fn stick(lever: f64, epsilon: f64) -> f64 {
    1.5 * lever + ratio(epsilon)
}

/// Change of a momentum \[kg·m/s\] of this size by an impulse on one body and its reaction: a solver that looks for velocities balances
/// both to the part [`SOLVED`] of the impulse; and the rounding of the velocities.
/// Derived.
pub fn momentum(impulse: f64, size: f64, epsilon: f64) -> f64 {
    SOLVED * impulse + impact::velocity(epsilon) * size
}

/// Change of an angular momentum \[kg·m²/s\] beyond a slack, which is the impulse across the levers times the distance by which they end
/// apart from each other, and also what positions moved with a mean of old and new velocities change; and the rounding of its parts.
/// Derived.
pub fn angular(slack: f64, size: f64, epsilon: f64) -> f64 {
    slack + impact::velocity(epsilon) * size
}

/// Distance \[m\], or angle \[rad\], by which bodies move along their surfaces, or turn about the normal, with this speed in the step of an
/// impact: the impulse may act where the bodies are before it, after it or between, and positions move with a mean of old and new
/// velocities.
/// Derived.
pub fn meanwhile(speed: f64, h: f64) -> f64 {
    speed * h
}

/// What turning may add to the restitution of a plate of half width a and half height c \[m\] whose corners yield. Friction μ · 2 m u at
/// the lever c turns it with ω = 2 c μ m u/J, J = m (a² + c²)/3, and ½ J ω² may come back along the normal: J ω²/(m u²), for any u.
/// Derived.
pub fn tipped(friction: f64, [width, height]: [f64; 2]) -> f64 {
    3.0 * (2.0 * height * friction).powi(2) / (width * width + height * height)
}

/// Angle \[rad\] by which a slip turns whose contact turns by `turned` \[rad\]: surfaces that move with `speed` \[m/s\] by a spin about the
/// first normal move aside with that part of it. At least a quarter of the slip is left at the end.
/// Derived.
pub fn aside(speed: f64, turned: f64, slip: f64) -> f64 {
    4.0 * speed * turned / slip
}

/// Creep \[m/s\] of a body that another one carries, beside what a step's solver leaves of its own: solvers measure their error by the
/// largest impulse of the step, which carries the `whole` mass, and a part [`SOLVED`] of that, (m + M) g sin α h, moves the upper one.
/// Derived.
pub fn carried_creep(pull: f64, h: f64, [upper, whole]: [f64; 2]) -> f64 {
    SOLVED * pull * h * whole / upper
}

/// Angle \[rad\] of friction off the direction of slip, or of an impulse off its normal: parts of the impulses that solvers may leave.
/// Derived.
pub fn direction(epsilon: f64) -> f64 {
    ratio(epsilon)
}

/// Relative change of a component of an impulse p of size `whole` by a turn δ of the normal: the other component times δ, where p itself
/// turns, too; twice that.
/// Derived.
pub fn turned_impulse(turn: f64, whole: f64, component: f64) -> f64 {
    2.0 * turn * whole / component
}

/// Relative change of the ratio μ of two components by a turn δ of the normal, (1 + μ²) δ/μ.
/// Derived.
pub fn turned_ratio(turn: f64, friction: f64) -> f64 {
    (1.0 + friction * friction) * turn / friction
}

/// Angular momentum \[kg·m²/s\] beside that of a lever R n: while the contact lasts n turns by δ, and the normal impulse p
/// turns with it, R n₀ × p n = R p δ. Friction has the lever R all the time.
/// Derived.
pub fn turned_lever(reach: f64, turn: f64, pressed: f64) -> f64 {
    reach * turn * pressed.abs()
}

/// Part of an impulse that comes later in a plastic impact: the surfaces stay in touch and close again with the acceleration `closing`
/// \[m/s²\] of their turning, or of the turn of their normal, for a time, against the speed of approach.
/// Derived.
pub fn later(closing: f64, time: f64, speed: f64) -> f64 {
    closing * time / speed
}

/// Distance \[m\] from the surface of a body that was set down on another one on the floor: both contacts may be found late, the upper one
/// by another step, 2 · 3/2 g h², and may push what falls by up to g h, which rises ½ g h².
/// Derived.
pub fn set_down(gravity: f64, h: f64) -> f64 {
    3.5 * gravity * h * h
}

/// Change of a velocity of size `size` by the depth δ of the contact, whose lever is R − δ. The ratio 1/(1 + I/m(R − δ)²) is off by at most
/// δ/R of itself for a solid sphere, because the slope of its logarithm is 4/7. And v = ω(R − δ) differs from ω R by ω δ ≤ `size` δ/R.
/// Derived.
pub fn lever(size: f64, depth: f64, radius: f64) -> f64 {
    size * depth / radius
}

/// Error of the speed of fall \[m/s\] of a ball whose support leaves under it with the speed V. A ball that lies at a depth δ is free when
/// the edge is √(2 R δ) away, since R − √(R² − s²) ≥ ½ s²/R; a step may see the edge one step early or late, a third one is the
/// push of a step out of δ ≤ 7/2 g h², as in [`set_down`].
/// Derived.
pub fn left_behind(depth: f64, radius: f64, speed: f64, gravity: f64, h: f64) -> f64 {
    gravity * ((2.0 * radius * depth).sqrt() / speed.abs() + 3.0 * h)
}
