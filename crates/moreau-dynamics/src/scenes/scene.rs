//! The file format `scene/1`: what every simulator is told, in SI units and world coordinates.
//!
//! ```json
//! { "schema": "scene/1", "name": "drop", "gravity": [0, 0, -9.81],
//!   "ground": { "normal": [0, 0, 1], "offset": 0 },
//!   "bodies": [ { "name": "ball", "sphere": { "radius": 0.1 }, "mass": 1, "position": [0, 0, 1.1] } ],
//!   "material": { "friction": 0.5, "restitution": 0 }, "duration": 2 }
//! ```

use crate::mechanics::spatial::Shape;
use moreau_contact::files::{read_json, read_schema};
use moreau_exact::{Error, Result};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// The name and version of the format.
pub const SCHEMA: &str = "scene/1";

/// Bodies under gravity over an optional ground plane, their material and the time to simulate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Always `scene/1`.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: String,
    /// A short name.
    pub name: String,
    /// What the scene shows, for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Acceleration of free fall \[m/s²\].
    pub gravity: [f64; 3],
    /// The half-space n·x ≥ c, or none.
    #[serde(default)]
    pub ground: Option<Ground>,
    /// At least one body.
    #[schemars(length(min = 1))]
    pub bodies: Vec<Body>,
    /// Pair values of friction and restitution.
    pub material: Material,
    /// Simulated time \[s\].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub duration: f64,
    /// Parameters some engines need beyond the scene, by engine; opaque here.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub engines: BTreeMap<String, serde_json::Value>,
}

/// The ground plane n·x = c; bodies stay on the side n points to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// Unit normal n.
    pub normal: [f64; 3],
    /// c \[m\].
    pub offset: f64,
}

/// A rigid body; exactly one of `sphere`, `box`, `capsule` and `cylinder` gives its shape. It moves by forces and has a
/// `mass`, or it is `static`, or its motion is `prescribed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "oneOf" = [{"required": ["sphere"]}, {"required": ["box"]}, {"required": ["capsule"]}, {"required": ["cylinder"]}],
    "anyOf" = [
        {"required": ["mass"], "properties": {"static": {"const": false}}, "not": {"required": ["prescribed"]}},
        {"required": ["static"], "properties": {"static": {"const": true}}, "not": {"required": ["prescribed"]}},
        {"required": ["prescribed"], "properties": {"static": {"const": false}}}
    ]
))]
pub struct Body {
    /// Unique; `ground` is reserved for the plane.
    pub name: String,
    /// The shape, if a sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// The shape, if a box.
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<Cuboid>,
    /// The shape, if a capsule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capsule: Option<Capsule>,
    /// The shape, if a cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<Cylinder>,
    /// m \[kg\]; not given, and infinite, if the body is static or its motion is prescribed.
    #[serde(default = "unmoved", skip_serializing_if = "is_infinite")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Principal moments \[kg·m²\] about the body axes through the centre of mass; those of the solid if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[f64; 3]>,
    /// Centre of mass \[m\].
    pub position: [f64; 3],
    /// Unit quaternion \[w, x, y, z\], body to world.
    #[serde(default = "upright")]
    pub orientation: [f64; 4],
    /// Velocity of the centre of mass \[m/s\].
    #[serde(default)]
    pub linear_velocity: [f64; 3],
    /// \[rad/s\], world frame.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// Whether nothing moves the body: it takes any impulse and stays where it is.
    #[serde(rename = "static", default, skip_serializing_if = "is_false")]
    pub is_static: bool,
    /// The motion of a body that takes any impulse and keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prescribed: Option<Prescribed>,
}

/// Velocities that a body keeps for the whole scene, whatever touches it: x(t) = x₀ + V t, R(t) = exp(t ω) R₀.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Prescribed {
    /// V of the body's centre \[m/s\].
    pub velocity: [f64; 3],
    /// ω \[rad/s\], world frame.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
}

/// A sphere about the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Radius of the sphere \[m\].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
}

/// A box about the centre of mass, its edges along the body axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    /// Half the edge lengths \[m\].
    pub half_extents: [f64; 3],
}

/// The points within `radius` of a segment along the body's z axis, about the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// Radius of the ends and of the cylinder between them \[m\].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Half the length of the segment \[m\], without the ends.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_height: f64,
}

/// A cylinder about the body's z axis, its centre the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Radius of the cylinder \[m\].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Half its height \[m\].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_height: f64,
}

/// Friction and restitution of every pair, with exceptions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// μ ≥ 0.
    #[schemars(range(min = 0))]
    pub friction: f64,
    /// e ∈ \[0, 1\].
    #[schemars(range(min = 0, max = 1))]
    #[serde(default)]
    pub restitution: f64,
    /// Pairs that differ.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<PairOverride>,
}

/// One pair with its own friction or restitution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairOverride {
    /// Two names; `ground` is the plane.
    pub bodies: [String; 2],
    /// μ, or the common one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// e, or the common one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
}

/// What to do about a body without one shape.
pub(super) const ONE_SHAPE: &str = "give one of `sphere`, `box`, `capsule` and `cylinder`";

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

/// The mass of a body that no impulse moves.
fn unmoved() -> f64 {
    f64::INFINITY
}

fn is_infinite(mass: &f64) -> bool {
    mass.is_infinite()
}

fn is_false(flag: &bool) -> bool {
    !flag
}

impl Body {
    /// A solid sphere at rest.
    ///
    /// ```
    /// use moreau_dynamics::scenes::Body;
    ///
    /// let ball = Body::sphere("ball", 1.0, 0.1, [0.0, 0.0, 2.0]); // m, R, where
    /// assert!(ball.is_free() && !ball.clone().fixed().is_free());
    /// assert_eq!(ball.driven([0.0, 0.0, 1.0]).velocities()[0], [0.0, 0.0, 1.0]); // a lift, whatever stands on it
    /// ```
    pub fn sphere(name: impl Into<String>, mass: f64, radius: f64, position: [f64; 3]) -> Self {
        Body {
            name: name.into(),
            sphere: Some(Sphere { radius }),
            cuboid: None,
            capsule: None,
            cylinder: None,
            mass,
            inertia: None,
            position,
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            is_static: false,
            prescribed: None,
        }
    }

    /// A solid box at rest, its edges along the axes.
    pub fn cuboid(name: impl Into<String>, mass: f64, half_extents: [f64; 3], position: [f64; 3]) -> Self {
        Body { sphere: None, cuboid: Some(Cuboid { half_extents }), ..Body::sphere(name, mass, 1.0, position) }
    }

    /// A solid capsule at rest, its axis upright.
    pub fn capsule(name: impl Into<String>, mass: f64, radius: f64, half_height: f64, position: [f64; 3]) -> Self {
        Body { sphere: None, capsule: Some(Capsule { radius, half_height }), ..Body::sphere(name, mass, radius, position) }
    }

    /// A solid cylinder at rest, its axis upright.
    pub fn cylinder(name: impl Into<String>, mass: f64, radius: f64, half_height: f64, position: [f64; 3]) -> Self {
        Body { sphere: None, cylinder: Some(Cylinder { radius, half_height }), ..Body::sphere(name, mass, radius, position) }
    }

    /// The same body where nothing moves it.
    pub fn fixed(self) -> Self {
        Body { mass: unmoved(), inertia: None, is_static: true, ..self }
    }

    /// The same body with a velocity \[m/s\] that it keeps, whatever touches it.
    pub fn driven(self, velocity: [f64; 3]) -> Self {
        Body { mass: unmoved(), inertia: None, prescribed: Some(Prescribed { velocity, angular_velocity: [0.0; 3] }), ..self }
    }

    /// The shape; a valid body has exactly one.
    ///
    /// # Errors
    /// [`Error::Invalid`](moreau_exact::Error::Invalid) if it has none or several.
    pub fn shape(&self) -> Result<Shape> {
        self.only_shape().map_err(|problem| Error::invalid(&self.name, problem, ONE_SHAPE))
    }

    /// The shape, or what is wrong with it.
    pub(super) fn only_shape(&self) -> std::result::Result<Shape, &'static str> {
        let sphere = self.sphere.map(|Sphere { radius }| Shape::Sphere { radius });
        let cuboid = self.cuboid.map(|Cuboid { half_extents }| Shape::Box { half_extents });
        let capsule = self.capsule.map(|Capsule { radius, half_height }| Shape::Capsule { radius, half_height });
        let cylinder = self.cylinder.map(|Cylinder { radius, half_height }| Shape::Cylinder { radius, half_height });
        let mut shapes = [sphere, cuboid, capsule, cylinder].into_iter().flatten();
        let shape = shapes.next().ok_or("has no shape")?;
        if shapes.next().is_some() { Err("has two shapes") } else { Ok(shape) }
    }

    /// Whether forces and impulses move the body.
    pub fn is_free(&self) -> bool {
        !self.is_static && self.prescribed.is_none()
    }

    /// Velocity of the centre \[m/s\] and angular velocity \[rad/s\] at the start.
    pub fn velocities(&self) -> [[f64; 3]; 2] {
        match &self.prescribed {
            Some(Prescribed { velocity, angular_velocity }) => [*velocity, *angular_velocity],
            None => [self.linear_velocity, self.angular_velocity],
        }
    }
}

impl Scene {
    /// Parses and validates the text of a `scene/1` file.
    ///
    /// # Errors
    /// [`Error::Json`](moreau_exact::Error::Json) if the text is not JSON, otherwise [`Error::Invalid`](moreau_exact::Error::Invalid)
    /// naming the field and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        let scene: Scene = read_schema(text, SCHEMA)?;
        scene.validate()?;
        Ok(scene)
    }

    /// Reads a `scene/1` file.
    ///
    /// # Errors
    /// [`Error::Read`](moreau_exact::Error::Read), or those of [`Scene::from_json`] with the file's name.
    pub fn read(file: &Path) -> Result<Self> {
        let text = read_json(file)?;
        Scene::from_json(&text).map_err(|error| error.in_file(file))
    }

    /// The text of the scene's file.
    ///
    /// # Errors
    /// [`Error::Invalid`](moreau_exact::Error::Invalid) if the scene is not valid: what is written can be read.
    pub fn to_json(&self) -> Result<String> {
        self.validate()?;
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}
