//! Who an engine is and which contact model it declares: the result of `describe`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Overrides of an engine's options and contact parameters, by name.
pub type Options = serde_json::Map<String, serde_json::Value>;

/// What a check asks of an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// The motion of scenes.
    Simulate,
    /// Solutions of contact problems.
    Solve,
    /// Projections on friction cones.
    Project,
    /// The engine's own step problems; the gate does not ask for them.
    Dump,
}

/// What an engine says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// Its name.
    pub name: String,
    /// Its version, as it reports it.
    pub version: String,
    /// The precision of the engine's arithmetic; it decides how much rounding a verdict allows.
    pub precision: Precision,
    /// The declared contact model.
    pub contact_model: ContactModel,
    /// Whether `material.restitution` is honoured.
    pub restitution: bool,
    /// The friction cone of this configuration.
    pub friction: Friction,
    /// Whether trajectories carry contact impulses.
    pub reports_contacts: bool,
    /// Which kinds of request are answered.
    pub levels: Vec<Level>,
    /// At level `solve`: the laws the solver takes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub laws: Vec<String>,
    /// Every other setting that can be chosen, with the value that the engine uses.
    #[serde(default)]
    pub options: Options,
}

/// Floating-point precision of the engine's arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// 53 bits.
    Double,
    /// 24 bits.
    Single,
}

impl Precision {
    /// ε, the distance from 1 to the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::Double => f64::EPSILON,
            Precision::Single => f64::from(f32::EPSILON),
        }
    }
}

/// The shape of an engine's friction cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Friction {
    /// ‖r_t‖ ≤ μ r_n.
    Cone,
    /// A pyramid inside or around the cone.
    Pyramid,
    /// No friction.
    None,
}

/// Whether bodies may overlap by design.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Bodies do not overlap but for errors.
    Rigid,
    /// Contact is a force law with a rest depth.
    Compliant,
}

/// The declared contact model: kind, documented law and its physical numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactModel {
    /// Rigid or compliant.
    pub kind: Kind,
    /// A law the gate can predict, or none.
    #[serde(default)]
    pub law: Option<String>,
    /// Physical numbers with their units.
    #[serde(default)]
    pub parameters: BTreeMap<String, Parameter>,
}

/// A physical number, or several, with unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// The value that the engine uses.
    pub value: OneOrMany<f64>,
    /// Its unit, or one unit per entry.
    pub unit: OneOrMany<String>,
}

/// A single entry or a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum OneOrMany<T> {
    /// A single entry.
    One(T),
    /// A list of entries.
    Many(Vec<T>),
}

impl ContactModel {
    /// The single number with this name, if it is listed.
    pub fn number(&self, name: &str) -> Option<f64> {
        match &self.parameters.get(name)?.value {
            OneOrMany::One(value) => Some(*value),
            OneOrMany::Many(_) => None,
        }
    }

    /// The numbers with this name, if they are listed.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        match &self.parameters.get(name)?.value {
            OneOrMany::One(value) => Some(std::slice::from_ref(value)),
            OneOrMany::Many(values) => Some(values),
        }
    }
}
