//! Residuals in a file: a map of `{"value": …, "unit": …}`, with relative size, scale, rounding and contact where they decide.

use super::joints::JointedResiduals;
use super::judged::Worst;
use super::residuals::Residuals;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// A residual where it is worst; what is not a number or infinite is null.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Residual")]
struct Entry {
    /// Its value.
    #[schemars(with = "Option<f64>")]
    value: f64,
    /// Its unit.
    unit: &'static str,
    /// Its value over its scale, 0 where it is rounding: what is held against the tolerance.
    #[schemars(with = "Option<f64>")]
    relative: f64,
    /// The size of what it is made of, at its contact; in its unit.
    #[schemars(with = "Option<f64>")]
    scale: f64,
    /// The rounding of its evaluation; in its unit.
    #[schemars(with = "Option<f64>")]
    rounding: f64,
    /// The contact.
    contact: usize,
}

/// A number with its unit; null where it is none.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Quantity")]
struct Measure {
    /// Its value.
    #[schemars(with = "Option<f64>")]
    value: f64,
    /// Its unit.
    unit: &'static str,
}

/// The residuals of an answer: those that decide, and norms that do not.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Residuals")]
struct Written {
    /// dist(r, K) \[N·s\].
    primal: Entry,
    /// dist(ŷ, K*) \[m/s\].
    dual: Entry,
    /// |r·ŷ| \[J\].
    complementarity: Entry,
    /// min(r_n, ρ_n y_n) \[N·s\].
    normal: Entry,
    /// ‖r_t − P(r_t − ρ_t y_t)‖ \[N·s\].
    tangential: Entry,
    /// |u − (W r + u_free)| of the stored u \[m/s\].
    velocity: Entry,
    /// ‖y_k‖ of the bilateral constraint that moves most \[m/s\]; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    bilateral: Option<Entry>,
    /// ‖r − P_K(r − ρŷ)‖ over all contacts \[N·s\]; decides nothing.
    natural_map: Measure,
    /// The natural map with ρ = 1 kg by Siconos's size; decides nothing.
    siconos: Measure,
    /// The natural map with ρ = 1 kg by FCLIB's size; decides nothing.
    fclib: Measure,
    /// ‖r‖ \[N·s\].
    impulse_scale: Measure,
    /// ‖u_free + shift‖ \[m/s\].
    velocity_scale: Measure,
    /// The size of the natural map \[N·s\].
    natural_map_scale: Measure,
}

impl Entry {
    fn new((_, Worst { part, contact, .. }, unit): (&str, Worst, &'static str)) -> Self {
        Entry { value: part.value, unit, relative: part.relative(), scale: part.scale, rounding: part.floor, contact }
    }
}

impl Measure {
    fn new((_, value, unit): (&str, f64, &'static str)) -> Self {
        Measure { value, unit }
    }
}

impl From<&Residuals> for Written {
    fn from(residuals: &Residuals) -> Self {
        let [primal, dual, complementarity, normal, tangential, velocity] = residuals.judged.entries().map(Entry::new);
        let [natural_map, siconos, fclib, impulse_scale, velocity_scale, natural_map_scale] = residuals.norms().map(Measure::new);
        Written {
            primal,
            dual,
            complementarity,
            normal,
            tangential,
            velocity,
            bilateral: None,
            natural_map,
            siconos,
            fclib,
            impulse_scale,
            velocity_scale,
            natural_map_scale,
        }
    }
}

/// As a map of `{"value": …, "unit": …}`, with relative size, scale, rounding and contact where they decide.
impl Serialize for Residuals {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        Written::from(self).serialize(serializer)
    }
}

/// The same with the residual of bilateral constraints, where there are some.
impl Serialize for JointedResiduals {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let bilateral = self.bilateral.map(|worst| Entry::new(("bilateral", worst, "m/s")));
        Written { bilateral, ..Written::from(&self.contacts) }.serialize(serializer)
    }
}

impl JsonSchema for JointedResiduals {
    fn schema_name() -> Cow<'static, str> {
        Written::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Written::json_schema(generator)
    }
}

impl JsonSchema for Residuals {
    fn schema_name() -> Cow<'static, str> {
        Written::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Written::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    use super::super::residuals::residuals;
    use crate::problem::{ContactProblem, Solution};
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn each_residual_and_norm_is_written_under_its_own_name() {
        let block =
            ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        let found = residuals(&block, &Solution::new("", dvector![0.75, -0.5], dvector![0.0, 1.0], 0)).unwrap();
        let written = serde_json::to_value(found).unwrap();
        for (name, worst, unit) in found.judged.entries() {
            assert_eq!((&written[name]["value"], &written[name]["unit"]), (&worst.part.value.into(), &unit.into()), "{name}");
        }
        for (name, value, unit) in found.norms() {
            assert_eq!((&written[name]["value"], &written[name]["unit"]), (&value.into(), &unit.into()), "{name}");
        }
        assert_eq!(written.as_object().unwrap().len(), found.judged.entries().len() + found.norms().len());
    }
}
