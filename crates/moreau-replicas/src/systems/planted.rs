//! What agreements plant, to show that they can fail: a measurement of the same thing with a mistake in it.

use super::Measured;
use crate::stored::StoredRuns;
use moreau_checks::defects::schemes::{AHEAD, Alteration, HALF_FRICTION, HEAVY};
pub use moreau_checks::planted::{Kind, Planted};
use moreau_exact::Result;

/// Measures an agreement; with a planted mistake it must exceed its tolerance.
///
/// # Errors
/// Those of the agreement: a mistake changes numbers only.
pub type Measure = fn(&dyn StoredRuns) -> Result<Measured>;

/// A measurement with a planted mistake of this name.
pub const fn mistake(kind: Kind, name: &'static str, mistake: &'static str, subject: Measure) -> Planted<Measure> {
    Planted { name, mistake, kind, subject }
}

/// A measurement under one of the mistakes that every scheme through the waist can have.
pub const fn altered(mistake: Planted<Alteration>, subject: Measure) -> Planted<Measure> {
    Planted { name: mistake.name, mistake: mistake.mistake, kind: mistake.kind, subject }
}

/// Forces 10 % too strong.
pub const fn heavy(subject: Measure) -> Planted<Measure> {
    altered(HEAVY, subject)
}

/// Half of every μ.
pub const fn half_friction(subject: Measure) -> Planted<Measure> {
    altered(HALF_FRICTION, subject)
}

/// Positions moved on by half the change of velocity as well.
pub const fn ahead(subject: Measure) -> Planted<Measure> {
    altered(AHEAD, subject)
}
