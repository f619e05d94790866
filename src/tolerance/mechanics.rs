//! Tolerances of [`crate::contact`] and [`crate::mechanics`].

use super::EPSILON;

/// Step of a central difference \[s\], ε^⅓ rounded to a power of two (2⁻¹⁷): it balances truncation h²/6·f‴
/// against rounding ε f/h.
pub const DIFFERENCE_STEP: f64 = 1.0 / 131_072.0;

/// Error of a central difference of a function of size `size` along a velocity of size `speed`: truncation
/// h²/6·|f‴| with |f‴| ≤ 6·size·(1 + speed)³, and 8 rounding errors of size ε·size over 2h.
///
/// The bound on f‴ covers compositions of distances and rotations at unit length scale, which is what the
/// mechanisms' gaps and potentials are.
pub fn central_difference(speed: f64, size: f64) -> f64 {
    let h = DIFFERENCE_STEP;
    size * (h * h * (1.0 + speed).powi(3) + 4.0 * EPSILON / h)
}

/// The largest energy error of a Runge–Kutta run with half the step of one whose error is `coarse`: of order four it is a sixteenth to
/// leading order, of order three an eighth; the next order of h is left as much again.
pub fn runge_kutta_energy(coarse: f64) -> f64 {
    coarse / 12.0
}

/// Newton steps for the midpoint spin: the contraction constant is at most √½·½ < 0.36, so the first error is below 0.6 of the
/// size, and each step more than squares it; six reach ε from there.
pub const NEWTON_STEPS: usize = 6;

/// Sine of the angle below which crossing edges of two boxes count as parallel: what is left out by it is at most a thousandth of the
/// tilt of the faces, the normal that is kept is good to a thousandth of the digits.
pub const PARALLEL: f64 = 1.0 / 1024.0;

/// How far, relative to its gap, a corner may lie beside the face it is measured against: what faces tilted against each other by up to
/// 1/16 need, and little enough that its gap from the plane is its distance from the face up to 1/512.
pub const BESIDE: f64 = 1.0 / 16.0;

/// Contact points of two boxes nearer than this, relative to their size, are one: √ε, far above the rounding with which
/// clipping finds the same corner twice, far below any lever arm that matters.
pub const SAME_POINT: f64 = 1.0 / 67_108_864.0;
