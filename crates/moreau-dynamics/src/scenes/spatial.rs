//! A scene as rigid bodies in space: every `scene/1` is one.

use super::{Body, Scene};
use crate::mechanics::spatial::SpatialBody;
use crate::mechanics::{Materials, Mechanism, Plane, SpatialBodies, State};
use moreau_exact::Result;
use nalgebra::{DVector, Quaternion, UnitQuaternion, Vector3, dvector};

impl Scene {
    /// The scene's rigid bodies in space and their initial state; for the planar mechanism see [`Scene::mechanism`].
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] as [`Scene::validate`].
    pub fn spatial_mechanism(&self) -> Result<(Box<dyn Mechanism>, State)> {
        self.validate()?;
        let bodies = self.bodies.iter().map(spatial_body).collect::<Result<Vec<_>>>()?;
        let (friction, restitution) = (self.material.friction, self.material.restitution);
        let mechanism = match &self.ground {
            None => SpatialBodies::without_ground(&self.name, bodies, self.gravity, Materials::new(friction, restitution)?)?,
            Some(ground) => {
                let [x, y, z] = ground.normal;
                let plane = Plane::new(dvector![x, y, z].normalize(), ground.offset, friction, restitution)?;
                SpatialBodies::new(&self.name, bodies, self.gravity, plane)?
            }
        };
        let mechanism = mechanism.with_pairs(self.material.pairs.iter().filter_map(|pair| self.pair(pair)).collect())?;
        Ok((Box::new(mechanism), self.spatial_state()))
    }

    fn spatial_state(&self) -> State {
        let turned = |body: &Body| {
            let [w, i, j, k] = body.orientation;
            UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
        };
        let place = |body: &Body| {
            let (turn, [x, y, z]) = (turned(body), body.position);
            [x, y, z, turn.w, turn.i, turn.j, turn.k]
        };
        let rate = |body: &Body| {
            let [[x, y, z], angular] = body.velocities();
            let spin = turned(body).inverse_transform_vector(&Vector3::from(angular));
            [x, y, z, spin[0], spin[1], spin[2]]
        };
        let bodies = self.bodies.len();
        State {
            time: 0.0,
            position: DVector::from_iterator(7 * bodies, self.bodies.iter().flat_map(place)),
            velocity: DVector::from_iterator(6 * bodies, self.bodies.iter().flat_map(rate)),
        }
    }
}

fn spatial_body(body: &Body) -> Result<SpatialBody> {
    let shape = body.shape()?;
    match body.inertia {
        _ if !body.is_free() => SpatialBody::unmoved(&body.name, shape),
        Some(moments) => SpatialBody::new(&body.name, shape, body.mass, moments),
        None => SpatialBody::solid(&body.name, shape, body.mass),
    }
}
