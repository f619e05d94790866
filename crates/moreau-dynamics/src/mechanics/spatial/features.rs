//! Where bodies in space touch: gap, normal and the material points whose relative velocity the contact sees.
//!
//! ```text
//!     plane          φ = n·x − c − r                        r = 0 for the corner of a box
//!     two spheres    φ = ‖x₁ − x₂‖ − r₁ − r₂
//!     sphere, box    φ = signed distance of the centre from the box − r
//! ```
//! Every gap is a distance between material features (corner, edge, face, centre), so its time derivative is exactly
//! n · (v_first − v_second) at the two points; parallel faces share a normal, see `faces`. Capsules and cylinders are in `round`,
//! `capsule_box` and `cylinders`.

use super::boxes::box_box;
use super::capsule_box::capsule_box;
use super::cylinders::{capsule_cylinder, cylinder_box, cylinders};
use super::faces::level;
use super::round::{self, Rod};
use super::shape::{Pose, Shape, corners};
use super::spheres::{sphere_box, sphere_sphere};
use super::touch::{Touch, Touches};
use crate::mechanics::Plane;
use nalgebra::Vector3;

/// Appends the candidates of a shape with the ground: the deepest point of a sphere, the eight corners of a box; the
/// others are in `round`.
pub(super) fn ground_touches(shape: &Shape, pose: &Pose, ground: &Plane, touches: &mut Vec<Touch>) {
    let normal = Vector3::new(ground.normal[0], ground.normal[1], ground.normal[2]);
    let touch = |point: Vector3<f64>, radius: f64, feature: u32| {
        let touching = point - normal * radius;
        Touch::new(normal.dot(&point) - ground.offset - radius, normal, [touching, touching], [feature, 0])
    };
    match shape {
        Shape::Sphere { radius } => touches.push(touch(pose.centre, *radius, 0)),
        Shape::Capsule { radius, half_height } => {
            round::capsule_ground(Rod { radius: *radius, half_height: *half_height, pose }, ground, touches);
        }
        Shape::Cylinder { radius, half_height } => {
            round::cylinder_ground(Rod { radius: *radius, half_height: *half_height, pose }, ground, touches);
        }
        Shape::Box { half_extents } => {
            let first = touches.len();
            touches.extend((0..).zip(corners(*half_extents)).map(|(k, corner)| touch(pose.world(corner), 0.0, k)));
            level_lowest_face(&mut touches[first..], pose, &normal);
        }
    }
}

/// The four corners of the face that looks at the ground are seen at one height if that face is parallel to it.
fn level_lowest_face(touches: &mut [Touch], pose: &Pose, normal: &Vector3<f64>) {
    let upward = pose.rotation.tr_mul(normal);
    let axis = upward.iamax();
    // corner k has the sign of bit k of its number, x first
    let (bit, up) = (4 >> axis, upward[axis] > 0.0);
    let outward = pose.rotation.column(axis) * if up { -1.0 } else { 1.0 };
    level(touches, |touch| (touch.features[0] & bit == 0) == up, &outward, normal);
}

/// Appends the candidates of a pair of shapes: one with a sphere, a manifold of a pair of others.
pub(super) fn pair_touches(first: &Shape, pose_first: &Pose, second: &Shape, pose_second: &Pose, into: &mut Touches) {
    let touches = &mut into.list;
    match (*first, *second) {
        (Shape::Sphere { radius }, Shape::Sphere { radius: other }) => {
            touches.push(sphere_sphere(radius, pose_first, other, pose_second));
        }
        (Shape::Sphere { radius }, Shape::Box { half_extents }) => {
            touches.push(sphere_box(radius, &pose_first.centre, half_extents, pose_second));
        }
        (Shape::Box { half_extents }, Shape::Sphere { radius }) => {
            touches.push(sphere_box(radius, &pose_second.centre, half_extents, pose_first).swapped());
        }
        (Shape::Box { half_extents }, Shape::Box { half_extents: other }) => {
            box_box(half_extents, pose_first, other, pose_second, into);
        }
        (Shape::Capsule { radius, half_height }, Shape::Capsule { radius: other, half_height: length }) => {
            let second = Rod { radius: other, half_height: length, pose: pose_second };
            round::capsules(Rod { radius, half_height, pose: pose_first }, second, touches);
        }
        (Shape::Capsule { radius, half_height }, Shape::Box { half_extents }) => {
            capsule_box(Rod { radius, half_height, pose: pose_first }, half_extents, pose_second, touches);
        }
        (Shape::Sphere { radius }, Shape::Capsule { radius: other, half_height }) => {
            touches.push(round::sphere_capsule(radius, &pose_first.centre, Rod { radius: other, half_height, pose: pose_second }));
        }
        (Shape::Sphere { radius }, Shape::Cylinder { radius: other, half_height }) => {
            touches.push(round::sphere_cylinder(radius, &pose_first.centre, Rod { radius: other, half_height, pose: pose_second }));
        }
        (Shape::Capsule { radius, half_height }, Shape::Cylinder { radius: other, half_height: length }) => {
            let cylinder = Rod { radius: other, half_height: length, pose: pose_second };
            capsule_cylinder(Rod { radius, half_height, pose: pose_first }, cylinder, touches);
        }
        (Shape::Cylinder { radius, half_height }, Shape::Box { half_extents }) => {
            cylinder_box(Rod { radius, half_height, pose: pose_first }, half_extents, pose_second, touches);
        }
        (Shape::Cylinder { radius, half_height }, Shape::Cylinder { radius: other, half_height: length }) => {
            let second = Rod { radius: other, half_height: length, pose: pose_second };
            cylinders(Rod { radius, half_height, pose: pose_first }, second, touches);
        }
        (Shape::Capsule { .. } | Shape::Cylinder { .. }, Shape::Sphere { .. })
        | (Shape::Box { .. }, Shape::Capsule { .. } | Shape::Cylinder { .. })
        | (Shape::Cylinder { .. }, Shape::Capsule { .. }) => {
            let begin = touches.len();
            pair_touches(second, pose_second, first, pose_first, into);
            into.list[begin..].iter_mut().for_each(|touch| *touch = touch.swapped());
        }
    }
}
