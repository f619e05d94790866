//! Allowances of [`crate::checks::bounce`].

use super::SOLVED;

pub use super::impact::velocity;

/// Part of an impulse that is missing after a step's solver: [`SOLVED`], and the rounding of [`velocity`].
/// Derived.
pub fn solved(epsilon: f64) -> f64 {
    SOLVED + velocity(epsilon)
}

/// Spin \[rad/s\] that an impulse \[N·s\] gives at the corner of a flat face of a box: its lever is that of the corner at most, its moment
/// acts about an axis of the face.
/// Derived.
pub fn spin(impulse: f64, [a, b, _]: [f64; 3], [about_x, about_y, _]: [f64; 3]) -> f64 {
    impulse * (b / about_x).hypot(a / about_y)
}

/// Part by which the spin \[rad/s\] of a free body with these principal moments changes over a time \[s\]:
/// ‖ω̇‖ = ‖J⁻¹(ω × Jω)‖ ≤ ω² (J_max − J_min)/J_min. And ω² is at most J_max/J_min of what it was, as ω·Jω is kept. An explicit step of it
/// has the same bound.
/// Derived.
pub fn precession(spin: f64, moments: [f64; 3], time: f64) -> f64 {
    let least = moments.into_iter().fold(f64::INFINITY, f64::min);
    let greatest = moments.into_iter().fold(0.0, f64::max);
    spin.abs() * time * greatest / least * (greatest - least) / least
}

/// Part by which ω·Jω of a free body changes that has precessed by this part. The motion keeps it, a spin that is held while the body turns
/// about it keeps it, too, and an explicit step h adds h² τ·J⁻¹τ with τ = ω × Jω: the square of what the spin changes by.
/// Derived.
pub fn turned_energy(precession: f64) -> f64 {
    precession * precession
}

/// How far from the floor \[m\] a contact may be found and act: the way of two steps.
/// Derived.
pub fn away(speed: f64, h: f64) -> f64 {
    2.0 * speed * h
}

/// Error of a velocity after a step over g h: the impulse is at most m g h, and the velocities before it no larger.
/// Derived.
pub fn pressed(epsilon: f64) -> f64 {
    2.0 * solved(epsilon)
}

/// A mistake of e that is told where nothing but rounding is allowed.
/// Required: of the checks of one impact, by their tests.
#[cfg(test)]
pub const WRONG: f64 = 1e-6;

/// A mistake of e that is told of a bar that turns, whose approach may be one with a lever older by two steps \[s\]: the solver's part, and
/// twice the largest of these, 0.2 h for the lever of the ball, ½ · 3/7.5 · 2 ω h at ω = ⅓ rad/s and what both sides of it add.
/// Required: of `bounce/turning-bar`, by its tests.
#[cfg(test)]
pub fn wrong_while_turning(h: f64) -> f64 {
    WRONG_IN_SUM + 0.4 * h
}

/// A mistake of e that is told where the solver may leave a part of the impulse, which acts with the lever of a corner.
/// Required: of the checks of several impulses at once, by their tests.
#[cfg(test)]
pub const WRONG_IN_SUM: f64 = 2e-3;
