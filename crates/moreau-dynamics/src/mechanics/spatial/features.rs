//! Where bodies in space touch: gap, normal and the material points whose relative velocity the contact sees.
//!
//! ```text
//!     plane          φ = n·x − c − r                        r = 0 for the corner of a box
//!     two spheres    φ = ‖x₁ − x₂‖ − r₁ − r₂
//!     sphere, box    φ = signed distance of the centre from the box − r
//! ```
//! Every gap is a distance between material features (corner, edge, face, centre), so its time derivative is exactly
//! n · (v_first − v_second) at the two points; parallel faces of two boxes share a normal, see `faces`.

use super::boxes::box_box;
use super::faces::level;
use super::shape::{Pose, Shape, corners};
use super::touch::{Touch, direction};
use crate::mechanics::Plane;
use nalgebra::Vector3;

/// Appends the candidates of a shape with the ground: the deepest point of a sphere, the eight corners of a box.
pub(super) fn ground_touches(shape: &Shape, pose: &Pose, ground: &Plane, touches: &mut Vec<Touch>) {
    let normal = Vector3::new(ground.normal[0], ground.normal[1], ground.normal[2]);
    let touch = |point: Vector3<f64>, radius: f64, feature: u32| {
        let touching = point - normal * radius;
        Touch::new(normal.dot(&point) - ground.offset - radius, normal, [touching, touching], [feature, 0])
    };
    match shape {
        Shape::Sphere { radius } => touches.push(touch(pose.centre, *radius, 0)),
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
    let mut lowest: Vec<&mut Touch> = touches.iter_mut().filter(|touch| (touch.features[0] & bit == 0) == up).collect();
    level(&mut lowest, &outward, normal);
}

/// Appends the candidates of a pair of shapes: one with a sphere, a manifold of a pair of boxes.
pub(super) fn pair_touches(first: &Shape, pose_first: &Pose, second: &Shape, pose_second: &Pose, touches: &mut Vec<Touch>) {
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
            touches.extend(box_box(half_extents, pose_first, other, pose_second));
        }
    }
}

fn sphere_sphere(radius: f64, first: &Pose, other: f64, second: &Pose) -> Touch {
    let (distance, normal) = direction(second.centre, first.centre);
    let points = [first.centre - normal * radius, second.centre + normal * other];
    Touch::new(distance - radius - other, normal, points, [0, 0])
}

/// Outside, the nearest point of the box counts; inside, its nearest face, the first of several.
pub(in crate::mechanics) fn sphere_box(radius: f64, sphere: &Vector3<f64>, half_extents: [f64; 3], cuboid: &Pose) -> Touch {
    let centre = cuboid.body(*sphere);
    let extents = Vector3::from(half_extents);
    let nearest = centre.zip_map(&extents, |x, extent| x.clamp(-extent, extent));
    let (distance, normal, on_box) = if nearest == centre {
        let depths = extents - centre.abs();
        let axis = depths.imin();
        let sign = if centre[axis] < 0.0 { -1.0 } else { 1.0 };
        let mut on_face = centre;
        on_face[axis] = sign * extents[axis];
        (-depths[axis], cuboid.rotation.column(axis) * sign, on_face)
    } else {
        let (distance, normal) = direction(cuboid.world(nearest), *sphere);
        (distance, normal, nearest)
    };
    Touch::new(distance - radius, normal, [sphere - normal * radius, cuboid.world(on_box)], [0, 0])
}
