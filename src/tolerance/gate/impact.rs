//! Impacts of free spheres: nothing depends on the step but where they meet.

/// Relative error of a velocity after an impact: one contact is one division, but a solver that minimises an energy to rounding gives each of
/// two velocities to √ε, and both are subtracted.
pub fn velocity(epsilon: f64) -> f64 {
    4.0 * epsilon.sqrt()
}

/// Angle \[rad\] by which the line of centres turns while spheres with the sum of radii R move by s = 2 v h, `offset` b beside each other:
/// its rate is b/d² per length with the distance d ≥ R − s.
pub fn turned(offset: f64, reach: f64, speed: f64, h: f64) -> f64 {
    let moved = 2.0 * speed * h;
    offset * moved / (reach - moved).powi(2)
}

/// Relative change of an approach speed v cos φ when the normal turns by δ: |cos(φ ± δ)/cos φ − 1| ≤ δ tan φ + ½ δ².
pub fn approach(tangent: f64, turned: f64) -> f64 {
    turned * tangent + 0.5 * turned * turned
}
