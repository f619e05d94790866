//! A scene as an engine sees it that has no contact of boxes: a sphere in each corner of a box, tangent to its faces.
//!
//! The corners' centres are at (±(a − ρ), ±(b − ρ), ±(c − ρ)), ρ the radius: faces touch the ground where the box's would, but the feet
//! stand ρ further in.

use super::{Body, Scene};
use crate::mechanics::spatial::Shape;
use crate::mechanics::{Mechanism, Plane, SphereBodies, SphereBody, State};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

impl Scene {
    /// The scene's bodies over its ground, boxes with spheres of `corner_radius` \[m\] in their corners that meet the ground and the other
    /// boxes, and the initial state.
    ///
    /// # Errors
    /// [`Error::Unsupported`] unless there are a body and a ground; [`Error::Invalid`] as [`Scene::validate`].
    pub fn corner_sphere_mechanism(&self, corner_radius: f64) -> Result<(Box<dyn Mechanism>, State)> {
        self.validate()?;
        let (Some(ground), [_, ..]) = (&self.ground, self.bodies.as_slice()) else {
            return Err(Error::Unsupported("corner spheres stand for bodies on a ground plane".into()));
        };
        let material = &self.material;
        let normal = DVector::from_row_slice(&ground.normal).normalize();
        let plane = Plane::new(normal, ground.offset, material.friction, material.restitution)?;
        let bodies = self.bodies.iter().map(|body| sphere_body(body, corner_radius)).collect::<Result<_>>()?;
        let mechanism = SphereBodies::new(&self.name, bodies, self.gravity, plane)?;
        let state = |body: &Body| (body.position, body.orientation, body.linear_velocity, body.angular_velocity);
        Ok((Box::new(mechanism), SphereBodies::state(self.bodies.iter().map(state))))
    }
}

fn sphere_body(body: &Body, corner_radius: f64) -> Result<SphereBody> {
    if !body.is_free() {
        return Err(Error::Unsupported(format!("`{}` is static or moves as prescribed; corner spheres belong to free bodies", body.name)));
    }
    let (spheres, solid) = shape(body, corner_radius)?;
    let faces = body.cuboid.as_ref().map(|cuboid| cuboid.half_extents);
    Ok(SphereBody { name: body.name.clone(), mass: body.mass, moments: body.inertia.unwrap_or(solid), spheres, faces })
}

/// Centre in body axes and radius \[m\].
type SphereAt = ([f64; 3], f64);

/// Spheres and solid moments \[kg·m²\] of a body.
fn shape(body: &Body, corner_radius: f64) -> Result<(Vec<SphereAt>, [f64; 3])> {
    let shape = body.shape()?;
    let solid = shape.solid_moments(body.mass);
    let half_extents = match shape {
        Shape::Sphere { radius } => return Ok((vec![([0.0; 3], radius)], solid)),
        Shape::Box { half_extents } => half_extents,
        Shape::Capsule { .. } | Shape::Cylinder { .. } => {
            return Err(Error::Unsupported(format!("`{}` is a {}; corner spheres stand for boxes", body.name, shape.word())));
        }
    };
    let sign = |corner: usize, axis: usize| if corner >> (2 - axis) & 1 == 1 { 1.0 } else { -1.0 };
    let centre = |corner: usize| std::array::from_fn(|axis| sign(corner, axis) * (half_extents[axis] - corner_radius));
    Ok(((0..8).map(|corner| (centre(corner), corner_radius)).collect(), solid))
}
