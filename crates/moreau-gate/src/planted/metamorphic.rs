//! Mistakes that single out a direction, a place, a unit, a frame or a time step.

use crate::planted::{Faulty, Planted};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(ALONG_AXES, &["metamorphic/rotation", "metamorphic/tilt"]),
    solver!(ROUNDED_DOWN, &["metamorphic/mirror", "metamorphic/rotation"]),
    scheme!(SINGLE, &["metamorphic/translation"]),
    scheme!(LIMITED, &["metamorphic/units"]),
    scheme!(DAMPED, &["metamorphic/galilean"]),
    scheme!(DAMPED_PER_STEP, &["metamorphic/halving", "metamorphic/galilean"]),
];
