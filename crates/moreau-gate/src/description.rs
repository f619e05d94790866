//! Who an engine is and which contact model it declares: the result of `describe`.

use moreau_dynamics::scenes::{Body, Scene};
use moreau_exact::{Error, Result};
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
    /// The shapes that scenes may have; spheres and boxes where it is not said.
    #[serde(default = "ShapeKind::basic", skip_serializing_if = "is_basic")]
    pub shapes: Vec<ShapeKind>,
    /// The kinds of bodies that scenes may have; free ones where it is not said.
    #[serde(default = "BodyKind::free", skip_serializing_if = "are_free")]
    pub bodies: Vec<BodyKind>,
    /// The option that lets bodies sleep which have come to rest; the engine has no such thing where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sleeping: Option<String>,
    /// Every other setting that can be chosen, with the value that the engine uses.
    #[serde(default)]
    pub options: Options,
}

/// A shape of `scene/1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ShapeKind {
    /// `sphere`.
    Sphere,
    /// `box`.
    Box,
    /// `capsule`.
    Capsule,
    /// `cylinder`.
    Cylinder,
}

impl ShapeKind {
    /// Every shape of the format.
    pub const ALL: [ShapeKind; 4] = [ShapeKind::Sphere, ShapeKind::Box, ShapeKind::Capsule, ShapeKind::Cylinder];

    /// The shapes of the first engines.
    pub fn basic() -> Vec<ShapeKind> {
        vec![ShapeKind::Sphere, ShapeKind::Box]
    }

    /// The shape of a body; that of a valid scene is unique.
    pub fn of(body: &Body) -> ShapeKind {
        let shapes = [
            (body.sphere.is_some(), ShapeKind::Sphere),
            (body.capsule.is_some(), ShapeKind::Capsule),
            (body.cylinder.is_some(), ShapeKind::Cylinder),
        ];
        shapes.into_iter().find(|(has, _)| *has).map_or(ShapeKind::Box, |(_, shape)| shape)
    }

    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            ShapeKind::Sphere => "sphere",
            ShapeKind::Box => "box",
            ShapeKind::Capsule => "capsule",
            ShapeKind::Cylinder => "cylinder",
        }
    }
}

/// What moves a body of `scene/1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BodyKind {
    /// Forces and impulses.
    Free,
    /// Nothing.
    Static,
    /// Its prescribed velocity, and nothing else.
    Prescribed,
}

impl BodyKind {
    /// Every kind of the format.
    pub const ALL: [BodyKind; 3] = [BodyKind::Free, BodyKind::Static, BodyKind::Prescribed];

    /// The bodies of the first engines.
    pub fn free() -> Vec<BodyKind> {
        vec![BodyKind::Free]
    }

    /// The kind of a body.
    pub fn of(body: &Body) -> BodyKind {
        match (body.is_static, &body.prescribed) {
            (true, _) => BodyKind::Static,
            (false, Some(_)) => BodyKind::Prescribed,
            (false, None) => BodyKind::Free,
        }
    }

    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            BodyKind::Free => "free",
            BodyKind::Static => "static",
            BodyKind::Prescribed => "prescribed",
        }
    }
}

fn is_basic(shapes: &[ShapeKind]) -> bool {
    shapes == ShapeKind::basic()
}

fn are_free(bodies: &[BodyKind]) -> bool {
    bodies == BodyKind::free()
}

impl Description {
    /// Refuses names that a terminal or a page would take for something else than names.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field that has a control character.
    pub fn validate(&self) -> Result<()> {
        let texts = [("name", Some(&self.name)), ("version", Some(&self.version)), ("contact_model.law", self.contact_model.law.as_ref())];
        let named = self.contact_model.parameters.keys().map(|name| ("contact_model.parameters", name));
        let texts = texts.into_iter().filter_map(|(field, text)| Some((field, text?))).chain(named);
        match texts.into_iter().find(|(_, text)| text.chars().any(char::is_control)) {
            Some((field, text)) => {
                let problem = format!("has a control character: {text:?}");
                Err(Error::invalid(field, problem, "leave out what a terminal would take for a command"))
            }
            None => Ok(()),
        }
    }

    /// Why a scene is not sent to this engine: it has what the engine does not declare.
    pub fn lacks(&self, scene: &Scene) -> Option<String> {
        let lacking = |body: &Body| {
            let (shape, kind) = (ShapeKind::of(body), BodyKind::of(body));
            if !self.shapes.contains(&shape) {
                return Some(format!("the engine does not declare the shape `{}` (`shapes` of its description)", shape.word()));
            }
            (!self.bodies.contains(&kind))
                .then(|| format!("the engine does not declare that bodies may be `{}` (`bodies` of its description)", kind.word()))
        };
        scene.bodies.iter().find_map(lacking)
    }
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
    ///
    /// ```
    /// use moreau_gate::ContactModel;
    ///
    /// let model: ContactModel = serde_json::from_str(
    ///     r#"{"kind": "rigid", "law": "coulomb", "parameters": {"penetration_allowance": {"value": 0.001, "unit": "m"}}}"#,
    /// )?;
    /// assert_eq!((model.number("penetration_allowance"), model.number("contact_margin")), (Some(0.001), None));
    /// # Ok::<(), serde_json::Error>(())
    /// ```
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

#[cfg(test)]
mod tests {
    use crate::process::messages::description;

    #[test]
    fn a_name_that_commands_a_terminal_is_refused_by_its_field() {
        let text = |name: &str, law: &str| {
            serde_json::json!({"name": name, "version": "1", "precision": "double", "restitution": true, "friction": "cone",
                "reports_contacts": true, "levels": ["simulate"], "contact_model": {"kind": "rigid", "law": law, "parameters": {}}})
        };
        let read = |name: &str, law: &str| description(&text(name, law).to_string());
        assert!(read("rød 1", "coulomb").is_ok());
        for (name, law, field) in
            [("\u{1b}[31mred", "coulomb", "`name`"), ("x\u{0}", "coulomb", "`name`"), ("x", "a\u{7}", "`contact_model.law`")]
        {
            let message = read(name, law).expect_err("a control character").to_string();
            assert!(message.contains(field) && !message.chars().any(char::is_control), "{message:?}");
        }
    }
}
