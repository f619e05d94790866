//! Residuals in a file: a map of `{"value": …, "unit": …}`, with relative size, scale, rounding and contact where they decide.

use super::judge::Worst;
use super::residuals::Residuals;
use serde::{Serialize, Serializer, ser::SerializeMap};

/// A residual in a file; what is not a number or infinite is null.
#[derive(Serialize)]
struct Entry {
    value: f64,
    unit: &'static str,
    relative: f64,
    scale: f64,
    rounding: f64,
    contact: usize,
}

impl Entry {
    fn new(Worst { part, contact, .. }: Worst, unit: &'static str) -> Self {
        Entry { value: part.value, unit, relative: part.relative(), scale: part.scale, rounding: part.floor, contact }
    }
}

/// As a map of `{"value": …, "unit": …}`, with relative size, scale, rounding and contact where they decide.
impl Serialize for Residuals {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Quantity {
            value: f64,
            unit: &'static str,
        }
        let mut map = serializer.serialize_map(Some(12))?;
        for (name, worst, unit) in self.judged.entries() {
            map.serialize_entry(name, &Entry::new(worst, unit))?;
        }
        for (name, value, unit) in self.norms() {
            map.serialize_entry(name, &Quantity { value, unit })?;
        }
        map.end()
    }
}
