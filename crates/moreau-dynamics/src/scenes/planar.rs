//! A scene as a planar mechanism, if all its motion stays in the x–z plane.
//!
//! Spheres become disks with the sphere's inertia ⅖ m r², boxes keep I_y = m (a² + c²)/3; a rotation about ŷ by θ has
//! the quaternion (cos θ/2, 0, sin θ/2, 0).

use super::validation::GROUND;
use super::{Body, PairOverride, Scene};
use crate::mechanics::planar::{PlanarBody, Shape};
use crate::mechanics::{Mechanism, PairMaterial, PlanarBodies, Plane, State, spatial};
use moreau_exact::{Error, Result};
use nalgebra::{DVector, dvector};

impl Scene {
    /// The planar mechanism of the scene and its initial state.
    ///
    /// # Errors
    /// [`Error::Unsupported`] names what leaves the x–z plane; [`Error::Invalid`] as [`Scene::validate`].
    pub fn mechanism(&self) -> Result<(Box<dyn Mechanism>, State)> {
        self.validate()?;
        let [x, y, z] = self.gravity;
        self.in_plane("gravity[1]", y)?;
        let bodies = self.bodies.iter().map(|body| self.planar_body(body)).collect::<Result<Vec<_>>>()?;
        let (friction, restitution) = (self.material.friction, self.material.restitution);
        let mechanism = match &self.ground {
            None => PlanarBodies::without_ground(&self.name, bodies, [x, z], friction, restitution)?,
            Some(ground) => {
                self.in_plane("ground.normal[1]", ground.normal[1])?;
                let normal = dvector![ground.normal[0], ground.normal[2]].normalize();
                PlanarBodies::new(&self.name, bodies, [x, z], Plane::new(normal, ground.offset, friction, restitution)?)?
            }
        };
        let mechanism = mechanism.with_pairs(self.material.pairs.iter().filter_map(|pair| self.pair(pair)).collect())?;
        Ok((Box::new(mechanism), self.initial_state()))
    }

    fn planar_body(&self, body: &Body) -> Result<PlanarBody> {
        if !body.is_free() {
            let reason = format!("`{}` is static or moves as prescribed; the planar mechanisms have free bodies only", body.name);
            return Err(Error::Unsupported(format!("scene `{}`: {reason}", self.name)));
        }
        let outside = [
            ("position[1]", body.position[1]),
            ("orientation[1]", body.orientation[1]),
            ("orientation[3]", body.orientation[3]),
            ("linear_velocity[1]", body.linear_velocity[1]),
            ("angular_velocity[0]", body.angular_velocity[0]),
            ("angular_velocity[2]", body.angular_velocity[2]),
        ];
        for (field, value) in outside {
            self.in_plane(&format!("{}.{field}", body.name), value)?;
        }
        let solid = body.shape()?;
        let shape = match solid {
            spatial::Shape::Sphere { radius } => Shape::Disk { radius },
            spatial::Shape::Box { half_extents: [a, _, c] } => Shape::Box { half_extents: [a, c] },
            spatial::Shape::Capsule { .. } | spatial::Shape::Cylinder { .. } => {
                let reason = format!("`{}` is a {}; the planar mechanisms have spheres and boxes only", body.name, solid.word());
                return Err(Error::Unsupported(format!("scene `{}`: {reason}", self.name)));
            }
        };
        let moment = body.inertia.unwrap_or(solid.solid_moments(body.mass))[1];
        PlanarBody::new(&body.name, shape, body.mass, moment)
    }

    /// The override in terms of body indices; a pair that names the ground where there is none has no contact.
    pub(super) fn pair(&self, pair: &PairOverride) -> Option<PairMaterial> {
        let index = |name: &String| self.bodies.iter().position(|body| body.name == *name);
        let [first, second] = &pair.bodies;
        let bodies = if first == GROUND { (index(second)?, None) } else { (index(first)?, index(second)) };
        let friction = pair.friction.unwrap_or(self.material.friction);
        let restitution = pair.restitution.unwrap_or(self.material.restitution);
        Some(PairMaterial { bodies, friction, restitution })
    }

    fn initial_state(&self) -> State {
        let angle = |[w, _, y, _]: [f64; 4]| 2.0 * y.atan2(w);
        let places = self.bodies.iter().flat_map(|body| [body.position[0], body.position[2], angle(body.orientation)]);
        let rates = self.bodies.iter().flat_map(|body| [body.linear_velocity[0], body.linear_velocity[2], body.angular_velocity[1]]);
        let size = 3 * self.bodies.len();
        State { time: 0.0, position: DVector::from_iterator(size, places), velocity: DVector::from_iterator(size, rates) }
    }

    fn in_plane(&self, what: &str, value: f64) -> Result<()> {
        if value == 0.0 {
            return Ok(());
        }
        let reason = format!("`{what}` is {value}, which leaves the x–z plane; the mechanisms here are planar");
        Err(Error::Unsupported(format!("scene `{}`: {reason}", self.name)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::named;
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_block_lies_flat_on_its_incline() {
        let (mechanism, state) = named("incline-slide").and_then(|scene| scene.mechanism()).expect("planar");
        let contacts = mechanism.contacts(&state.position);
        let touching = contacts.iter().filter(|contact| contact.gap.abs() <= rounding(8, 0.2));
        assert_eq!(touching.count(), 2, "both lower corners");
    }

    #[test]
    fn bodies_come_back_as_they_went_in() {
        for name in ["incline-stick", "box-stack", "two-ball-impact"] {
            let scene = named(name).expect("built in");
            let (mechanism, state) = scene.mechanism().expect("planar");
            for (body, state) in scene.bodies.iter().zip(mechanism.bodies(&state.position, &state.velocity)) {
                assert_eq!((&body.name, body.position, body.linear_velocity), (&state.name, state.position, state.linear_velocity));
                let difference: f64 = body.orientation.iter().zip(state.orientation).map(|(a, b)| (a - b).abs()).sum();
                assert!(difference <= rounding(4, 1.0));
            }
        }
    }

    #[test]
    fn a_sphere_has_two_fifths_m_r_squared() {
        let (mechanism, state) = named("two-ball-impact").and_then(|scene| scene.mechanism()).expect("planar");
        let mass = mechanism.mass_matrix(&state.position);
        assert!((mass[(2, 2)] - 0.4 * 2.0 * 0.01).abs() <= rounding(3, 0.01));
    }

    #[test]
    fn motion_out_of_the_plane_is_refused_by_name() {
        let mut scene = named("two-ball-impact").expect("built in");
        scene.bodies[1].linear_velocity[1] = 0.1;
        let message = scene.mechanism().err().expect("not planar").to_string();
        assert!(message.contains("light.linear_velocity[1]") && message.contains("x–z plane"), "{message}");
    }

    #[test]
    fn the_moment_about_the_plane_of_motions_normal_is_the_second() {
        let mut scene = named("two-ball-impact").expect("built in");
        scene.bodies[0].inertia = Some([0.25, 0.375, 0.5]);
        let (mechanism, state) = scene.mechanism().expect("planar");
        assert_eq!(mechanism.mass_matrix(&state.position)[(2, 2)], 0.375);
    }

    #[test]
    fn every_way_out_of_the_plane_is_refused() {
        type Change = fn(&mut Scene);
        let changes: [(&str, Change); 4] = [
            ("gravity[1]", |scene| scene.gravity[1] = 0.1),
            ("position[1]", |scene| scene.bodies[0].position[1] = 0.1),
            ("angular_velocity[0]", |scene| scene.bodies[0].angular_velocity[0] = 0.1),
            ("angular_velocity[2]", |scene| scene.bodies[0].angular_velocity[2] = 0.1),
        ];
        for (field, change) in changes {
            let mut scene = named("two-ball-impact").expect("built in");
            change(&mut scene);
            let message = scene.mechanism().err().expect("not planar").to_string();
            assert!(message.contains(field), "{message}");
        }
    }

    #[test]
    fn overrides_reach_the_contacts() {
        let mut scene = named("ball-drop").expect("built in");
        let bodies = ["ground", "ball"].map(String::from);
        scene.material.pairs = vec![PairOverride { bodies, friction: None, restitution: Some(0.25) }];
        let (mechanism, state) = scene.mechanism().expect("planar");
        let contact = &mechanism.contacts(&state.position)[0];
        assert_eq!((contact.friction, contact.restitution), (0.5, 0.25));
    }
}
