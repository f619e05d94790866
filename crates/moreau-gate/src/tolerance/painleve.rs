//! Errors of a first-order scheme around the impact of a sliding edge ([`crate::checks::painleve`]).

/// Error \[m/s\] of the velocity change by the impact, measured after at most `steps` further steps. In each of them a reaction carries the
/// body, at most m (g + ω²ℓ) with the distance ℓ from the edge to the centre. The approach speed is off by g h in the step in which the
/// edge arrives, with the gain `gain` = max |m⁻¹ ∂P/∂w|.
/// Derived.
pub fn velocity_change(gravity: f64, spin: f64, arm: f64, gain: f64, steps: usize, h: f64) -> f64 {
    steps as f64 * h * (gravity + spin * spin * arm) + gain * gravity * h
}

/// Slip \[m/s\] of the edge `steps` steps after it was stopped. The contact may open again, and the edge then accelerates by at most g +
/// ω²ℓ.
/// Derived.
pub fn slip(gravity: f64, spin: f64, arm: f64, steps: usize, h: f64) -> f64 {
    steps as f64 * h * (gravity + spin * spin * arm)
}

/// Relative gain of energy that a first-order scheme may show, from m g v h: the height changes by v h before the velocity follows.
/// Derived.
pub fn energy(gravity: f64, speed: f64, h: f64, energy: f64) -> f64 {
    2.0 * gravity * speed * h / energy
}
