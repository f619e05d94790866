//! Tolerances of [`crate::stabilisation`].

use moreau_exact::tolerance::rounding;

/// How far g may be from 0 when an iteration onto g = 0 ends \[m\], for coordinates of the given size: |q| − ℓ has an error of some ε|q|,
/// and a correction of another few.
/// Derived.
pub fn on_constraint(size: f64) -> f64 {
    rounding(16, size)
}

/// Rounding of relative energies, radii and positions after n steps along a circle: 64 operations a step, the last of which leaves the
/// circle by up to 32 ε. A step does not make the errors of the ones before grow: it is a projection and a shift along the circle.
/// Derived.
pub fn circle_run(steps: usize) -> f64 {
    rounding(128 * steps, 1.0)
}
