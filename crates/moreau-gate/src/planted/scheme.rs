//! Mistakes of schemes in what they pose and in how they move.

use crate::planted::{Faulty, Planted};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    scheme!(HEAVY, &["flight/projectile"]),
    scheme!(HALF_FRICTION, &["incline/slide", "incline/stick-threshold"]),
    scheme!(RESTITUTION_FORGOTTEN, &["ball/restitution"]),
    scheme!(MASS_FOR_INVERSE, &["rest/depth"]),
    scheme!(BLIND_TO_FORCES, &["rest/depth"]),
    scheme!(ROWS_APART, &["rest/depth", "stack/five"]),
    scheme!(FIRST_CONTACT, &["stack/five"]),
    scheme!(FRICTION_REVERSED, &["incline/slide"]),
    scheme!(IMPULSE_AS_FORCE, &["rest/depth"]),
    scheme!(THROUGH_CONTACT, &["rest/depth"]),
];
