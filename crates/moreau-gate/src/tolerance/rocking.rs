//! Errors of a first-order scheme on a block that rocks on its edges ([`crate::checks::rocking`]).

/// Error of the energy regained after a landing over the energy before it, `energy` = ½ω²/p² (lifts, in units of m g R).
///
/// Per unit of h ω, with ω the landing speed:
/// - the landing is found up to 3/2 steps early or late (a step, and half a step of forecast), at tilts of up to 3/2 h ω. There the
///   height differs by sin α · 3/2 h ω, before and after: 3 sin α;
/// - the angular speed of an explicit step lags by h/2: energy ½ h ω sin α on each side: sin α;
/// - the edge leaves its circle by ½(hω)²R a step and falls back: it lifts the centre by ½ h ω times the angle turned.
///
/// Derived.
pub fn regained(sine: f64, angle: f64, landing_speed: f64, h: f64, energy: f64) -> f64 {
    h * landing_speed * (4.0 * sine + 0.5 * angle) / energy
}

/// How far \[m\] an edge that does not slide may travel. It travels ½(hω)²R per step while the block turns through the angle. If the
/// landing is found 3/2 steps late, the base is below the ground by 2b · 3/2 h ω and its edge is R (3/2 h ω)² aside.
/// Derived.
pub fn travel(radius: f64, angle: f64, landing_speed: f64, h: f64) -> f64 {
    let turn = h * landing_speed;
    0.5 * turn * radius * angle + radius * (1.5 * turn).powi(2)
}

/// How far \[m\] an edge may seem to travel where a step moves the centre by (½ + σ) v⁺ + (½ − σ) v⁻ and turns the block with another σ,
/// both within ±½: the steps' differences h (σ − σ') (v⁺ − v⁻) add up to the change of the speed along the floor \[m/s\] from start to end.
/// Half of that is the greatest of schemes which use the mean of both velocities for one of them.
/// Derived.
pub fn unlike_means(mut speeds: impl Iterator<Item = f64>, h: f64) -> f64 {
    let start = speeds.next().unwrap_or(0.0);
    0.5 * h * (speeds.last().unwrap_or(start) - start).abs()
}

/// Part of the speed of a landing that a push out of its depth returns at most: the declared part r of 3/2 h v over h, see
/// [`super::ball::depth`].
/// Derived.
pub fn returned(reduction: f64) -> f64 {
    1.5 * reduction
}

/// Error of the time of a landing \[s\]: one step until the edge carries, half a step by which explicit speeds lag, one step in which the
/// edge falls back onto its circle, and one sample.
/// Derived.
pub fn fall_time(h: f64) -> f64 {
    3.5 * h
}
