//! The file format `scene/1` as Rapier needs it. What is not known here is refused, never ignored.

use crate::protocol::{Outcome, Refusal};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The name of the plane in pairs and contacts.
pub const GROUND: &str = "ground";

/// Largest | ‖n‖ − 1 | of a unit vector: nine written digits per component are off by at most 5e-10 each.
const WRITTEN_UNIT_VECTOR: f64 = 1e-8;

type Unknown = BTreeMap<String, Value>;

/// Bodies under gravity over an optional plane.
#[derive(Debug, Deserialize)]
pub struct Scene {
    schema: String,
    #[serde(rename = "name")]
    _name: String,
    #[serde(rename = "description", default)]
    _description: String,
    /// \[m/s²\].
    pub gravity: [f64; 3],
    /// The half-space n·x ≥ c.
    #[serde(default)]
    pub ground: Option<Ground>,
    pub bodies: Vec<Body>,
    pub material: Material,
    /// \[s\].
    pub duration: f64,
    /// Options for engines, by engine.
    #[serde(default)]
    pub engines: BTreeMap<String, Map<String, Value>>,
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Ground {
    pub normal: [f64; 3],
    /// \[m\].
    pub offset: f64,
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Body {
    pub name: String,
    #[serde(default)]
    pub sphere: Option<Sphere>,
    #[serde(rename = "box", default)]
    pub cuboid: Option<Cuboid>,
    /// Along the body's z axis.
    #[serde(default)]
    pub capsule: Option<Rod>,
    /// Along the body's z axis.
    #[serde(default)]
    pub cylinder: Option<Rod>,
    /// \[kg\]; none if the body is not free.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Principal moments \[kg·m²\].
    #[serde(default)]
    pub inertia: Option<[f64; 3]>,
    /// \[m\].
    pub position: [f64; 3],
    /// \[w, x, y, z\].
    #[serde(default = "upright")]
    pub orientation: [f64; 4],
    /// \[m/s\].
    #[serde(default)]
    pub linear_velocity: [f64; 3],
    /// \[rad/s\], world frame.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// Whether nothing moves it.
    #[serde(rename = "static", default)]
    pub is_static: bool,
    /// The velocities it keeps.
    #[serde(default)]
    pub prescribed: Option<Prescribed>,
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Prescribed {
    /// \[m/s\].
    pub velocity: [f64; 3],
    /// \[rad/s\], world frame.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Sphere {
    pub radius: f64,
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Cuboid {
    pub half_extents: [f64; 3],
    #[serde(flatten)]
    unknown: Unknown,
}

/// A cylinder of the height 2l, with or without a half ball at each end.
#[derive(Debug, Deserialize)]
pub struct Rod {
    /// \[m\].
    pub radius: f64,
    /// l \[m\].
    pub half_height: f64,
    #[serde(flatten)]
    unknown: Unknown,
}

/// The one shape of a body.
#[derive(Debug)]
pub enum Shape<'a> {
    Sphere(&'a Sphere),
    Cuboid(&'a Cuboid),
    Capsule(&'a Rod),
    Cylinder(&'a Rod),
}

/// Coefficients of every pair, with exceptions.
#[derive(Debug, Deserialize)]
pub struct Material {
    pub friction: f64,
    #[serde(default)]
    pub restitution: f64,
    #[serde(default)]
    pub pairs: Vec<Pair>,
    #[serde(flatten)]
    unknown: Unknown,
}

#[derive(Debug, Deserialize)]
pub struct Pair {
    pub bodies: [String; 2],
    #[serde(default)]
    pub friction: Option<f64>,
    #[serde(default)]
    pub restitution: Option<f64>,
    #[serde(flatten)]
    unknown: Unknown,
}

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

impl Scene {
    /// Reads and checks a scene; refuses what this adapter does not know.
    pub fn read(value: &Value) -> Outcome<Self> {
        let scene: Scene = Scene::deserialize(value).map_err(|problem| Refusal::error(format!("scene: {problem}")))?;
        if scene.schema != "scene/1" {
            return Err(Refusal::error(format!("scene.schema is `{}`; this adapter reads `scene/1`", scene.schema)));
        }
        scene.refuse_unknown_fields()?;
        scene.check()?;
        Ok(scene)
    }

    fn refuse_unknown_fields(&self) -> Outcome<()> {
        let parts = [("scene", &self.unknown), ("scene.material", &self.material.unknown)]
            .into_iter()
            .chain(self.ground.iter().map(|ground| ("scene.ground", &ground.unknown)))
            .chain(self.material.pairs.iter().map(|pair| ("scene.material.pairs", &pair.unknown)))
            .chain(self.bodies.iter().map(|body| ("scene.bodies", &body.unknown)))
            .chain(self.bodies.iter().flat_map(|body| &body.prescribed).map(|moved| ("scene.bodies.prescribed", &moved.unknown)))
            .chain(self.bodies.iter().flat_map(|body| &body.sphere).map(|sphere| ("scene.bodies.sphere", &sphere.unknown)))
            .chain(self.bodies.iter().flat_map(|body| &body.cuboid).map(|cuboid| ("scene.bodies.box", &cuboid.unknown)))
            .chain(self.bodies.iter().flat_map(|body| &body.capsule).map(|rod| ("scene.bodies.capsule", &rod.unknown)))
            .chain(self.bodies.iter().flat_map(|body| &body.cylinder).map(|rod| ("scene.bodies.cylinder", &rod.unknown)));
        for (place, unknown) in parts {
            if let Some(field) = unknown.keys().next() {
                return Err(Refusal::unsupported(format!("the field `{field}` of {place}")));
            }
        }
        Ok(())
    }

    fn check(&self) -> Outcome<()> {
        if self.bodies.is_empty() {
            return Err(Refusal::error("scene.bodies is empty"));
        }
        for (index, body) in self.bodies.iter().enumerate() {
            body.check(&format!("scene.bodies[{index}]"))?;
            if body.name == GROUND || self.bodies[..index].iter().any(|other| other.name == body.name) {
                return Err(Refusal::error(format!("scene.bodies[{index}].name: `{}` is taken", body.name)));
            }
        }
        if let Some(ground) = &self.ground {
            unit("scene.ground.normal", &ground.normal)?;
        }
        self.material.check(&self.bodies)
    }

    /// Friction and restitution of a pair of bodies, by name.
    pub fn pair_coefficients(&self, a: &str, b: &str) -> (f64, f64) {
        let pair = |pair: &&Pair| (pair.bodies[0] == a && pair.bodies[1] == b) || (pair.bodies[0] == b && pair.bodies[1] == a);
        let mut pairs = self.material.pairs.iter().filter(pair);
        let friction = pairs.clone().find_map(|pair| pair.friction).unwrap_or(self.material.friction);
        (friction, pairs.find_map(|pair| pair.restitution).unwrap_or(self.material.restitution))
    }
}

impl Body {
    fn check(&self, place: &str) -> Outcome<()> {
        let (field, lengths) = match self.shape(place)? {
            Shape::Sphere(sphere) => ("sphere.radius", vec![sphere.radius]),
            Shape::Cuboid(cuboid) => ("box.half_extents", cuboid.half_extents.to_vec()),
            Shape::Capsule(rod) => ("capsule", vec![rod.radius, rod.half_height]),
            Shape::Cylinder(rod) => ("cylinder", vec![rod.radius, rod.half_height]),
        };
        positive(&format!("{place}.{field}"), &lengths)?;
        match (self.is_free(), self.mass) {
            (true, Some(mass)) => {
                positive(&format!("{place}.mass"), &[mass])?;
                positive(&format!("{place}.inertia"), &self.principal_moments(mass))?;
            }
            (false, None) => {}
            (true, None) => return Err(Refusal::error(format!("{place}.mass is missing"))),
            (false, Some(_)) => return Err(Refusal::error(format!("{place}.mass is that of a body which nothing moves"))),
        }
        unit(&format!("{place}.orientation"), &self.orientation)
    }

    /// Whether forces and impulses move it.
    pub fn is_free(&self) -> bool {
        !self.is_static && self.prescribed.is_none()
    }

    /// The one shape of the body.
    pub fn shape(&self, place: &str) -> Outcome<Shape<'_>> {
        let sphere = self.sphere.iter().map(Shape::Sphere);
        let cuboid = self.cuboid.iter().map(Shape::Cuboid);
        let capsule = self.capsule.iter().map(Shape::Capsule);
        let cylinder = self.cylinder.iter().map(Shape::Cylinder);
        let mut shapes = sphere.chain(cuboid).chain(capsule).chain(cylinder);
        match (shapes.next(), shapes.next()) {
            (Some(shape), None) => Ok(shape),
            (None, _) => Err(Refusal::unsupported(format!("{place} is neither a sphere, a box, a capsule nor a cylinder"))),
            (Some(_), Some(_)) => Err(Refusal::error(format!("{place} has two shapes"))),
        }
    }

    /// The given moments, else those of the solid: sphere ⅖ m r², box m/3 (b² + c², a² + c², a² + b²), cylinder of the height 2l
    /// m (r²/4 + l²/3, the same, r²/2), capsule a cylinder and two half balls of one density, their centres of mass 3r/8 beyond its ends.
    pub fn principal_moments(&self, mass: f64) -> [f64; 3] {
        match (&self.inertia, self.shape("a body")) {
            (Some(inertia), _) => *inertia,
            (None, Ok(Shape::Sphere(sphere))) => [0.4 * mass * sphere.radius * sphere.radius; 3],
            (None, Ok(Shape::Cuboid(Cuboid { half_extents: [a, b, c], .. }))) => {
                [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| mass / 3.0 * sum)
            }
            (None, Ok(Shape::Cylinder(rod))) => rod.moments([mass, 0.0]),
            (None, Ok(Shape::Capsule(rod))) => {
                let balls = mass * 2.0 * rod.radius / (3.0 * rod.half_height + 2.0 * rod.radius);
                rod.moments([mass - balls, balls])
            }
            (None, Err(_)) => [0.0; 3],
        }
    }
}

impl Rod {
    /// Of a cylinder and of the two half balls at its ends, by their masses.
    fn moments(&self, [middle, balls]: [f64; 2]) -> [f64; 3] {
        let (r, l) = (self.radius, self.half_height);
        let across = middle * (r * r / 4.0 + l * l / 3.0) + balls * (0.4 * r * r + l * l + 0.75 * l * r);
        [across, across, 0.5 * middle * r * r + 0.4 * balls * r * r]
    }
}

impl Material {
    fn check(&self, bodies: &[Body]) -> Outcome<()> {
        coefficients("scene.material", Some(self.friction), Some(self.restitution))?;
        for (index, pair) in self.pairs.iter().enumerate() {
            let place = format!("scene.material.pairs[{index}]");
            if let Some(name) = pair.bodies.iter().find(|name| *name != GROUND && bodies.iter().all(|body| body.name != **name)) {
                return Err(Refusal::error(format!("{place} names `{name}`, which is no body")));
            }
            coefficients(&place, pair.friction, pair.restitution)?;
        }
        Ok(())
    }
}

fn coefficients(place: &str, friction: Option<f64>, restitution: Option<f64>) -> Outcome<()> {
    match (friction, restitution) {
        (Some(friction), _) if friction < 0.0 => Err(Refusal::error(format!("{place}.friction is {friction}"))),
        (_, Some(e)) if !(0.0..=1.0).contains(&e) => Err(Refusal::error(format!("{place}.restitution is {e}"))),
        _ => Ok(()),
    }
}

fn positive(place: &str, values: &[f64]) -> Outcome<()> {
    match values.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
        None => Ok(()),
        Some(value) => Err(Refusal::error(format!("{place} holds {value}; it must be positive"))),
    }
}

fn unit(place: &str, vector: &[f64]) -> Outcome<()> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length - 1.0).abs() <= WRITTEN_UNIT_VECTOR {
        return Ok(());
    }
    Err(Refusal::error(format!("{place} has length {length}; it must be 1")))
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use serde_json::json;

    /// A unit ball of mass 2 at height 2 over the plane z = 0.
    pub fn ball() -> Value {
        json!({"schema": "scene/1", "name": "ball", "gravity": [0, 0, -10], "ground": {"normal": [0, 0, 1], "offset": 0},
               "bodies": [{"name": "ball", "sphere": {"radius": 1}, "mass": 2, "position": [0, 0, 2]}],
               "material": {"friction": 0.5, "restitution": 0.25}, "duration": 0.5})
    }

    /// The outcome for the ball with one field changed, found by its JSON pointer.
    fn changed(pointer: &str, value: Value) -> Outcome<Scene> {
        let mut scene = ball();
        let (parent, field) = pointer.rsplit_once('/').expect("a pointer");
        scene.pointer_mut(parent).expect("a field")[field] = value;
        Scene::read(&scene)
    }

    #[test]
    fn defaults_are_filled_in() {
        let scene = Scene::read(&ball()).expect("valid");
        assert_eq!(scene.bodies[0].orientation, [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(scene.bodies[0].principal_moments(2.0), [0.8; 3]);
        let mut body = Scene::read(&ball()).expect("valid").bodies.remove(0);
        (body.sphere, body.cuboid) = (None, Some(Cuboid { half_extents: [1.0, 2.0, 3.0], unknown: Unknown::new() }));
        assert_eq!(body.principal_moments(3.0), [13.0, 10.0, 5.0]);
    }

    #[test]
    fn a_rod_has_the_moments_of_its_solid() {
        let moments = |shape: &str| {
            let mut scene = ball();
            scene["bodies"][0]["sphere"].take();
            scene["bodies"][0][shape] = json!({"radius": 2.0, "half_height": 3.0});
            Scene::read(&scene).expect("valid").bodies[0].principal_moments(12.0)
        };
        assert_eq!(moments("cylinder"), [48.0, 48.0, 24.0]);
        // 4/13 of the mass in the balls: the half balls' own ∫ x² + (z + l)² dm by hand
        let (middle, balls) = (12.0 * 9.0 / 13.0, 12.0 * 4.0 / 13.0);
        let across = middle * (1.0 + 3.0) + balls * (1.6 + 9.0 + 4.5);
        let expected = [across, across, 2.0 * middle + 1.6 * balls];
        for (found, expected) in moments("capsule").iter().zip(expected) {
            assert!((found - expected).abs() <= 8.0 * f64::EPSILON * expected, "{found} {expected}");
        }
    }

    #[test]
    fn a_body_has_one_shape() {
        let two = changed("/bodies/0/capsule", json!({"radius": 1, "half_height": 1}));
        assert!(matches!(two, Err(Refusal::Error(_))));
        let flat = changed("/bodies/0/sphere", json!(null));
        assert!(matches!(flat, Err(Refusal::Unsupported(_))));
    }

    #[test]
    fn what_rapier_or_this_adapter_cannot_express_is_unsupported() {
        for (pointer, value) in [
            ("/bodies/0/cone", json!({"radius": 1})),
            ("/bodies/0/sphere", json!(null)),
            ("/material/rolling_friction", json!(0.1)),
            ("/ground/height_field", json!([])),
            ("/joints", json!([])),
        ] {
            assert!(matches!(changed(pointer, value), Err(Refusal::Unsupported(_))), "{pointer}");
        }
    }

    #[test]
    fn what_cannot_be_meant_is_an_error_that_names_the_field() {
        for (pointer, value) in [
            ("/bodies/0/mass", json!(0)),
            ("/bodies/0/mass", json!("heavy")),
            ("/bodies/0/mass", json!(null)),
            ("/bodies/0/static", json!(true)),
            ("/bodies/0/prescribed", json!({"velocity": [1, 0, 0]})),
            ("/bodies/0/inertia", json!([1, 1, 0])),
            ("/bodies/0/sphere/radius", json!(-1)),
            ("/bodies/0/orientation", json!([1, 1, 0, 0])),
            ("/bodies/0/name", json!("ground")),
            ("/bodies/0/position", json!([0, 0])),
            ("/ground/normal", json!([0, 0, 2])),
            ("/material/friction", json!(-0.1)),
            ("/material/restitution", json!(1.5)),
            ("/material/pairs", json!([{"bodies": ["ball", "nobody"]}])),
            ("/schema", json!("scene/2")),
        ] {
            assert!(matches!(changed(pointer, value), Err(Refusal::Error(_))), "{pointer}");
        }
    }

    #[test]
    fn a_pair_has_its_own_values_whatever_the_order_of_its_names() {
        let scene = changed("/material/pairs", json!([{"bodies": ["ground", "ball"], "friction": 0.1}])).expect("valid");
        assert_eq!(scene.pair_coefficients("ball", "ground"), (0.1, 0.25));
        assert_eq!(scene.pair_coefficients("ground", "ball"), (0.1, 0.25));
        assert_eq!(scene.pair_coefficients("ball", "other"), (0.5, 0.25));
    }
}
