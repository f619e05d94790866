//! What a scene must satisfy beyond being JSON of the right shape; every refusal names the field and a cure.

use super::scene::{ONE_SHAPE, SCHEMA};
use super::{Body, Material, PairOverride, Scene};
use crate::mechanics::spatial::Shape;
use crate::tolerance::scenes::WRITTEN_UNIT_VECTOR;
use moreau_contact::files::printable;
use moreau_exact::{Error, Result};
use std::collections::HashSet;

/// The name that stands for the plane in pairs.
pub(super) const GROUND: &str = "ground";

impl Scene {
    /// Checks what the types cannot: signs, finiteness, unit vectors, unique names.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first field that is not valid.
    pub fn validate(&self) -> Result<()> {
        if self.schema != SCHEMA {
            return Err(Error::invalid("schema", format!("is `{}`", self.schema), format!("use `{SCHEMA}`")));
        }
        printable("name", &self.name)?;
        finite("gravity", &self.gravity)?;
        if let Some(ground) = &self.ground {
            unit("ground.normal", &ground.normal)?;
            finite("ground.offset", &[ground.offset])?;
        }
        if self.bodies.is_empty() {
            return Err(Error::invalid("bodies", "is empty", "give at least one body"));
        }
        let mut names = HashSet::with_capacity(self.bodies.len());
        for (index, body) in self.bodies.iter().enumerate() {
            body.validate(&format!("bodies[{index}]"))?;
            body.validate_size(&format!("bodies[{index}]"), &self.gravity)?;
            if !names.insert(&body.name) {
                return Err(Error::invalid(format!("bodies[{index}].name"), format!("`{}` occurs twice", body.name), "use unique names"));
            }
        }
        self.material.validate(&self.bodies)?;
        positive("duration", &[self.duration])
    }
}

impl Body {
    fn validate(&self, path: &str) -> Result<()> {
        let field = |name: &str| format!("{path}.{name}");
        if self.name.is_empty() || self.name == GROUND {
            return Err(Error::invalid(field("name"), format!("is `{}`", self.name), "`ground` is the plane; use another name"));
        }
        printable(&field("name"), &self.name)?;
        match self.only_shape().map_err(|problem| Error::invalid(path, problem, ONE_SHAPE))? {
            Shape::Sphere { radius } => positive(&field("sphere.radius"), &[radius])?,
            Shape::Box { half_extents } => positive(&field("box.half_extents"), &half_extents)?,
            shape @ (Shape::Capsule { radius, half_height } | Shape::Cylinder { radius, half_height }) => {
                positive(&field(&format!("{}.radius", shape.word())), &[radius])?;
                positive(&field(&format!("{}.half_height", shape.word())), &[half_height])?;
            }
        }
        self.validate_motion(&field)?;
        if let Some(inertia) = &self.inertia {
            positive(&field("inertia"), inertia)?;
            let largest = inertia.iter().copied().fold(0.0, f64::max);
            if 2.0 * largest > inertia.iter().sum::<f64>() * (1.0 + WRITTEN_UNIT_VECTOR) {
                let cure = "a rigid body's largest moment is at most the sum of the other two";
                return Err(Error::invalid(field("inertia"), format!("is {inertia:?}"), cure));
            }
        }
        finite(&field("position"), &self.position)?;
        unit(&field("orientation"), &self.orientation)?;
        finite(&field("linear_velocity"), &self.linear_velocity)?;
        finite(&field("angular_velocity"), &self.angular_velocity)
    }

    /// What moves a free body are numbers: the inverses of mass and moments, and the weight.
    fn validate_size(&self, path: &str, gravity: &[f64; 3]) -> Result<()> {
        let Some(shape) = self.only_shape().ok().filter(|_| !self.is_static && self.prescribed.is_none()) else { return Ok(()) };
        let moments = self.inertia.unwrap_or(shape.solid_moments(self.mass));
        let is_of_size = |number: &f64| number.is_finite() && number.recip().is_finite();
        let wrong = if !is_of_size(&self.mass) {
            "has an inverse that is no number"
        } else if !moments.iter().all(is_of_size) {
            "comes with a moment of inertia that is no number, or its inverse is none"
        } else if gravity.iter().any(|g| !(self.mass * g).is_finite()) {
            "makes a weight that is no number"
        } else {
            return self.validate_energy(path, &moments);
        };
        let problem = format!("is {:e}, which {wrong}", self.mass);
        Err(Error::invalid(format!("{path}.mass"), problem, "use other units, in which masses and sizes are nearer to 1"))
    }

    /// ½ m v² and ½ J ω² are numbers.
    fn validate_energy(&self, path: &str, moments: &[f64; 3]) -> Result<()> {
        let largest = |of: &[f64]| of.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (field, inertia, speed) in [
            ("linear_velocity", self.mass, largest(&self.linear_velocity)),
            ("angular_velocity", largest(moments), largest(&self.angular_velocity)),
        ] {
            if !(3.0 * inertia * speed * speed).is_finite() {
                let problem = format!("holds {speed:e}, which makes an energy that is no number");
                return Err(Error::invalid(format!("{path}.{field}"), problem, "use smaller velocities, or other units"));
            }
        }
        Ok(())
    }

    /// A free body has a mass; one that is not has none, no inertia, and no velocity of its own.
    fn validate_motion(&self, field: &impl Fn(&str) -> String) -> Result<()> {
        let cure = match (self.is_static, &self.prescribed) {
            (false, None) if self.mass == f64::INFINITY => {
                let cure = "give the mass of the body in kg, or `static`: true, or its `prescribed` velocity";
                return Err(Error::invalid(field("mass"), "is missing", cure));
            }
            (false, None) => return positive(&field("mass"), &[self.mass]),
            (true, Some(_)) => {
                return Err(Error::invalid(field("prescribed"), "moves a body that is `static`", "leave out one of the two"));
            }
            (true, None) => "leave it out: a static body is not moved by anything",
            (false, Some(prescribed)) => {
                finite(&field("prescribed.velocity"), &prescribed.velocity)?;
                finite(&field("prescribed.angular_velocity"), &prescribed.angular_velocity)?;
                "leave it out: the body moves with its `prescribed` velocities, and nothing changes them"
            }
        };
        let given = [
            ("mass", self.mass != f64::INFINITY),
            ("inertia", self.inertia.is_some()),
            ("linear_velocity", self.linear_velocity != [0.0; 3]),
            ("angular_velocity", self.angular_velocity != [0.0; 3]),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((name, _)) => Err(Error::invalid(field(name), "is given", cure)),
            None => Ok(()),
        }
    }
}

impl Material {
    fn validate(&self, bodies: &[Body]) -> Result<()> {
        coefficients("material", Some(self.friction), Some(self.restitution))?;
        for (index, pair) in self.pairs.iter().enumerate() {
            let path = format!("material.pairs[{index}]");
            for name in &pair.bodies {
                if name != GROUND && !bodies.iter().any(|body| body.name == *name) {
                    return Err(Error::invalid(format!("{path}.bodies"), format!("names `{name}`"), "use names of bodies, or `ground`"));
                }
            }
            if pair.bodies[0] == pair.bodies[1] {
                return Err(Error::invalid(format!("{path}.bodies"), "names one body twice", "name two different ones"));
            }
            let same = |other: &PairOverride| other.bodies.iter().all(|name| pair.bodies.contains(name));
            if let Some(first) = self.pairs[..index].iter().position(same) {
                let problem = format!("names the pair of `material.pairs[{first}]` again");
                return Err(Error::invalid(format!("{path}.bodies"), problem, "give friction and restitution of a pair in one entry"));
            }
            coefficients(&path, pair.friction, pair.restitution)?;
        }
        Ok(())
    }
}

fn coefficients(path: &str, friction: Option<f64>, restitution: Option<f64>) -> Result<()> {
    if let Some(friction) = friction.filter(|friction| !(friction.is_finite() && *friction >= 0.0)) {
        return Err(Error::invalid(format!("{path}.friction"), format!("is {friction}"), "use a number ≥ 0"));
    }
    if let Some(restitution) = restitution.filter(|restitution| !(0.0..=1.0).contains(restitution)) {
        return Err(Error::invalid(format!("{path}.restitution"), format!("is {restitution}"), "use a number between 0 and 1"));
    }
    Ok(())
}

fn finite(field: &str, values: &[f64]) -> Result<()> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(Error::invalid(field, format!("holds {value}"), "use finite numbers")),
    }
}

fn positive(field: &str, values: &[f64]) -> Result<()> {
    match values.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
        None => Ok(()),
        Some(value) => Err(Error::invalid(field, format!("holds {value}"), "use a positive number")),
    }
}

fn unit(field: &str, vector: &[f64]) -> Result<()> {
    finite(field, vector)?;
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length - 1.0).abs() <= WRITTEN_UNIT_VECTOR {
        return Ok(());
    }
    Err(Error::invalid(field, format!("has length {length}"), "use a vector of length 1, written with nine digits or more"))
}

#[cfg(test)]
mod tests {
    use super::super::named;
    use super::*;

    /// The message for the scene `ball-drop` with one piece of its text replaced.
    fn message(from: &str, to: &str) -> String {
        let text = named("ball-drop").and_then(|scene| scene.to_json()).expect("a built-in scene");
        assert!(text.contains(from), "{from} is not in {text}");
        Scene::from_json(&text.replacen(from, to, 1)).expect_err("invalid").to_string()
    }

    #[test]
    fn refusals_name_the_field_and_a_cure() {
        assert!(message("\"mass\": 1.0", "\"mass\": -1.0").contains("`bodies[0].mass`: holds -1"));
        assert!(message("\"radius\": 0.1", "\"radius\": 0").contains("`bodies[0].sphere.radius`"));
        assert!(message("\"friction\": 0.5", "\"friction\": -0.5").contains("`material.friction`"));
        assert!(message("\"restitution\": 0.0", "\"restitution\": 1.5").contains("`material.restitution`"));
        assert!(message("\"duration\": 2.0", "\"duration\": 0").contains("`duration`"));
        assert!(message("\"name\": \"ball\"", "\"name\": \"ground\"").contains("`bodies[0].name`"));
        for (from, field) in [("\"name\": \"ball\"", "`bodies[0].name`"), ("\"name\": \"ball-drop\"", "`name`")] {
            let told = message(from, "\"name\": \"a\\u001b[2Jb\"");
            assert!(told.contains(field) && !told.chars().any(char::is_control), "{told:?}");
        }
        assert!(message("scene/1", "scene/9").contains("`schema`: is \"scene/9\""));
    }

    #[test]
    fn misspelt_fields_and_nan_are_not_json_of_this_shape() {
        assert!(message("\"mass\": 1.0", "\"maas\": 1.0").contains("unknown field `maas`"));
        assert!(message("\"mass\": 1.0", "\"mass\": NaN").contains("not valid JSON"));
        assert!(message("\"duration\": 2.0", "\"duration\": 1e999").contains("number out of range"));
    }

    #[test]
    fn directions_must_be_of_unit_length_on_both_sides() {
        let mut scene = named("ball-drop").expect("a built-in scene");
        for (length, valid) in [(1.0, true), (1.0 + WRITTEN_UNIT_VECTOR / 2.0, true), (1.0 + 2.0 * WRITTEN_UNIT_VECTOR, false)] {
            scene.bodies[0].orientation = [length, 0.0, 0.0, 0.0];
            assert_eq!(scene.validate().is_ok(), valid, "length {length}");
        }
        scene.bodies[0].orientation = [f64::NAN, 0.0, 0.0, 0.0];
        assert!(scene.validate().is_err() && scene.to_json().is_err());
    }

    #[test]
    fn a_mass_whose_inverse_moments_or_weight_are_no_numbers_is_named() {
        for (mass, word) in [("1e308", "a weight that is no number"), ("1e-308", "a moment of inertia"), ("1e-310", "has an inverse")] {
            let told = message("\"mass\": 1.0", &format!("\"mass\": {mass}"));
            assert!(told.contains("`bodies[0].mass`: is 1e") && told.contains(word) && told.contains("use other units"), "{told}");
        }
    }

    #[test]
    fn a_speed_whose_energy_is_no_number_is_named() {
        for (field, place) in [("linear_velocity", 0), ("angular_velocity", 1)] {
            let with = |speed: f64| {
                let mut scene = named("ball-drop").expect("a built-in scene");
                let body = &mut scene.bodies[0];
                [&mut body.linear_velocity, &mut body.angular_velocity][place][1] = speed;
                scene.validate()
            };
            let told = with(1e200).expect_err("no energy").to_string();
            assert!(told.contains(&format!("`bodies[0].{field}`: holds 1e200")) && told.contains("energy"), "{told}");
            assert!(with(1e150).is_ok());
        }
    }

    #[test]
    fn a_body_has_a_mass_or_is_static_or_moves_as_prescribed() {
        let free = "\"mass\": 1.0";
        assert!(message(&format!("{free},"), "").contains("`bodies[0].mass`: is missing"));
        assert!(message(free, "\"mass\": 1.0, \"static\": true").contains("`bodies[0].mass`: is given"));
        assert!(message(free, "\"static\": true, \"prescribed\": {\"velocity\": [1, 0, 0]}").contains("`bodies[0].prescribed`"));
        let moments = "\"inertia\": [1, 1, 1], \"prescribed\": {\"velocity\": [1, 0, 0]}";
        assert!(message(free, moments).contains("`bodies[0].inertia`: is given"));
        assert!(message(free, "\"prescribed\": {\"velocity\": [1, 0, 0], \"spin\": 1}").contains("unknown field `spin`"));
        for body in [Body::sphere("rock", 1.0, 0.1, [0.0; 3]).fixed(), Body::sphere("roller", 1.0, 0.1, [0.0; 3]).driven([1.0, 0.0, 0.0])] {
            let mut scene = named("ball-drop").expect("a built-in scene");
            scene.bodies.push(body);
            let text = scene.to_json().expect("valid");
            assert_eq!(Scene::from_json(&text).expect("what is written can be read"), scene);
            scene.bodies[1].linear_velocity[2] = 1.0;
            assert!(scene.validate().expect_err("not by itself").to_string().contains("`bodies[1].linear_velocity`"));
        }
    }

    #[test]
    fn shapes_pairs_and_moments_are_checked() {
        let scene = named("box-stack").expect("a built-in scene");
        let refused = |change: &dyn Fn(&mut Scene)| {
            let mut changed = scene.clone();
            change(&mut changed);
            changed.validate().expect_err("invalid").to_string()
        };
        assert!(refused(&|scene| scene.bodies[1].cuboid = None).contains("has no shape"));
        assert!(refused(&|scene| scene.bodies[1].sphere = Some(super::super::Sphere { radius: 1.0 })).contains("two shapes"));
        assert!(refused(&|scene| scene.bodies[1].name = scene.bodies[0].name.clone()).contains("occurs twice"));
        assert!(refused(&|scene| scene.bodies[1].inertia = Some([1.0, 1.0, 2.5])).contains("inertia"));
        assert!(refused(&|scene| scene.bodies.clear()).contains("`bodies`"));
        let stray = ["box1", "box99"].map(String::from);
        let pair = |bodies: [String; 2]| super::super::PairOverride { bodies, friction: Some(0.1), restitution: None };
        assert!(refused(&|scene| scene.material.pairs = vec![pair(stray.clone())]).contains("box99"));
        assert!(refused(&|scene| scene.material.pairs = vec![pair(["box1", "box1"].map(String::from))]).contains("twice"));
        let again = [["box1", "ground"], ["ground", "box1"]].map(|names| pair(names.map(String::from)));
        assert!(refused(&|scene| scene.material.pairs = again.to_vec()).contains("`material.pairs[0]` again"));
    }
}
