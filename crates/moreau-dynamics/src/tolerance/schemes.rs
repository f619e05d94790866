//! Tolerances of [`crate::schemes`].

use moreau_exact::tolerance::rounding;

/// How far M̂ of size `size` with n rows may be from symmetric by rounding: two products and a factorisation.
/// Derived.
pub fn asymmetry(size: f64, rows: usize) -> f64 {
    rounding(16 * rows, size)
}

/// Correction \[m\] below which a projection onto φ = 0 has ended, for coordinates of the given size: the rounding of a gap.
/// Derived.
pub fn projected(size: f64) -> f64 {
    rounding(8, size)
}

/// Part 2⁻⁴⁰ of the first slope H_nᵀ φ that a least move may leave. The move is one step of Newton's method on gaps, which leaves their
/// curvature, far more than that; what it leaves is in the gaps of the next step, and only a step below [`projected`] ends.
/// Set.
pub const SOLVED_MOVE: f64 = 1.0 / 1_099_511_627_776.0;

/// Rounding of one Moreau–Jean step of a ball: v⁺ = v − (m g/m) h + r/m with r = −m (v_free + e v) passes through
/// fewer than eight operations on numbers of at most |v| + g h + e|v|.
/// Derived.
pub fn ball_velocity(speed: f64, fall: f64) -> f64 {
    rounding(8, 2.0 * speed + fall)
}

/// Error of the speed at which (x, ẋ)˙ = (ẋ, −2ẋ − x), integrated from (0, −1) by Runge–Kutta steps h, is released.
///
/// For a linear system a Runge–Kutta step is the Taylor polynomial of degree 4, so the error until T ≤ 2 + h is at
/// most T ‖A‖⁵h⁴/120 · e^{‖A‖(T+h)} with ‖A‖_∞ = 3. The release falls on a step, within 2h of the exact one, where
/// ẍ = 0 and |d³x/dt³| ≤ 1 change ẋ by at most ½(2h)².
/// Derived.
pub fn released_speed(h: f64) -> f64 {
    let (norm, time) = (3.0f64, 2.0 + h);
    time * norm.powi(5) * h.powi(4) / 120.0 * (norm * (time + h)).exp() + 0.5 * (2.0 * h).powi(2)
}

/// Rounding of q + h (θ v⁺ + (1−θ) v): five operations, and the error of v⁺ times h.
/// Derived.
pub fn ball_position(position: f64, speed: f64, fall: f64, h: f64) -> f64 {
    rounding(8, position + h * (2.0 * speed + fall)) + h * ball_velocity(speed, fall)
}

/// Part of the largest impulse, 2⁻²⁰, by which one may differ from the one that steps before kept to count as the same load. What kept
/// impulses leave is below 10⁻¹⁰ of them, and a load that changes differs by more than a millionth.
/// Set.
pub const SAME_LOAD: f64 = 1.0 / 1_048_576.0;
