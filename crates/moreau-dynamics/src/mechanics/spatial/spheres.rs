//! Where a sphere touches a sphere or a box: one point.

use super::shape::Pose;
use super::touch::{Touch, direction};
use nalgebra::Vector3;

/// Two spheres, the normal along their line of centres.
pub(super) fn sphere_sphere(radius: f64, first: &Pose, other: f64, second: &Pose) -> Touch {
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
