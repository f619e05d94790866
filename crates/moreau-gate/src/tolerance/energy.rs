//! Allowances of [`crate::checks::energy`].

use super::SOLVED;

/// Energy \[J\] that a passive body of 1 kg may gain, a cube of half edge a that falls from a height H for at most a time T:
///
/// - ½ g h times the range of v_z, at most twice the speed v = √(2gH) of the fall, where positions advance with v⁺;
/// - (g h)²/8 in each of T/h steps, the largest ½ p_n u⁻ with p_n = g h − u⁻;
/// - ½ P u, where P = v + g T is the whole normal impulse and u = ½ ω²ρ h pushes out corners that turned below the floor, with the
///   lever ρ = √3 a and the spin ω = v/a of a corner that takes up the speed of the fall.
///
/// Derived.
pub fn rise(gravity: f64, h: f64, height: f64, half: f64, time: f64) -> f64 {
    let speed = (2.0 * gravity * height).sqrt();
    let spin = speed / half;
    let push = 0.5 * spin * spin * 3f64.sqrt() * half * h;
    gravity * h * speed + gravity * gravity * h * time / 8.0 + 0.5 * (speed + gravity * time) * push
}

/// Error of an energy \[J\] by solvers and rounding over n steps.
/// Derived.
pub fn rounding(epsilon: f64, energy: f64, steps: usize) -> f64 {
    (SOLVED + epsilon * steps as f64) * energy
}
