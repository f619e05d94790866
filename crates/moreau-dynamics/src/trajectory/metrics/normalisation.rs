//! Reference scales T_ref and V_ref: a distance in the (t, v) plane is one in (t/T_ref, v/V_ref).

use serde::Serialize;

/// The scales a distance was normalised with; stored beside its value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Normalisation {
    /// T_ref \[s\].
    pub time: f64,
    /// V_ref \[m/s\].
    pub speed: f64,
}

impl Normalisation {
    /// T_ref and V_ref of a fall from a height under gravity: t₁ = √(2 q₀/g) and g t₁.
    pub fn of_fall(gravity: f64, height: f64) -> Self {
        let time = (2.0 * height / gravity).sqrt();
        Normalisation { time, speed: gravity * time }
    }
}
