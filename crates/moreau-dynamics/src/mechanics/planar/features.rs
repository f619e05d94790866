//! Where planar bodies touch: gap, normal and the material points whose relative velocity the contact sees.
//!
//! Every gap is a distance between material features (vertex, face, centre), so its time derivative is exactly
//! n · (v_first − v_second) at the two points; parallel faces of two boxes share a normal, see `faces`.

use super::boxes::box_box;
use super::faces::level;
use super::shape::{Pose, Shape, corners};
use super::touch::{Touch, along, direction, dot};
use crate::mechanics::Plane;

/// The candidates of a shape with the ground: the deepest point of a disk, the four corners of a box.
pub(super) fn ground_touches(shape: &Shape, pose: &Pose, ground: &Plane) -> Vec<Touch> {
    let normal = [ground.normal[0], ground.normal[1]];
    let touch = |point: [f64; 2], radius: f64| {
        let gap = dot(normal, point) - ground.offset - radius;
        let touching = along(point, -radius, normal);
        Touch { gap, normal, points: [touching, touching] }
    };
    match shape {
        Shape::Disk { radius } => vec![touch(pose.centre, *radius)],
        Shape::Box { half_extents } => {
            let mut touches = corners(*half_extents).map(|corner| touch(pose.world(corner), 0.0));
            level_lowest_face(&mut touches, pose, normal);
            touches.to_vec()
        }
    }
}

/// The two corners of the face that looks at the ground are seen at one height if that face is parallel to it.
fn level_lowest_face(touches: &mut [Touch; 4], pose: &Pose, normal: [f64; 2]) {
    // face k looks along −z, +x, +z, −x and joins the corners k and k + 1
    let outward = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]].map(|face| pose.rotate(face));
    let lowest = (0..4).min_by(|one, other| dot(outward[*one], normal).total_cmp(&dot(outward[*other], normal)));
    let lowest = lowest.expect("a box has four faces");
    let ends = [lowest, (lowest + 1) % 4];
    let levelled = level(ends.map(|corner| touches[corner]), outward[lowest], normal);
    ends.into_iter().zip(levelled).for_each(|(corner, touch)| touches[corner] = touch);
}

/// The candidates of a pair of shapes: one, or two for a pair of boxes.
pub(super) fn pair_touches(first: &Shape, pose_first: &Pose, second: &Shape, pose_second: &Pose) -> Vec<Touch> {
    match (*first, *second) {
        (Shape::Disk { radius }, Shape::Disk { radius: other }) => vec![disk_disk(radius, pose_first, other, pose_second)],
        (Shape::Disk { radius }, Shape::Box { half_extents }) => vec![disk_box(radius, pose_first, half_extents, pose_second)],
        (Shape::Box { half_extents }, Shape::Disk { radius }) => {
            vec![disk_box(radius, pose_second, half_extents, pose_first).swapped()]
        }
        (Shape::Box { half_extents }, Shape::Box { half_extents: other }) => box_box(half_extents, pose_first, other, pose_second).to_vec(),
    }
}

/// φ = ‖x₁ − x₂‖ − r₁ − r₂.
fn disk_disk(radius: f64, first: &Pose, other: f64, second: &Pose) -> Touch {
    let (distance, normal) = direction(second.centre, first.centre);
    let points = [along(first.centre, -radius, normal), along(second.centre, other, normal)];
    Touch { gap: distance - radius - other, normal, points }
}

/// φ = signed distance of the disk's centre from the box − r; inside, the nearest face counts.
fn disk_box(radius: f64, disk: &Pose, [a, b]: [f64; 2], cuboid: &Pose) -> Touch {
    let [x, z] = cuboid.body(disk.centre);
    let nearest = [x.clamp(-a, a), z.clamp(-b, b)];
    let inside = nearest == [x, z];
    let (distance, normal, on_box) = if inside {
        let (depth_x, depth_z) = (a - x.abs(), b - z.abs());
        if depth_x < depth_z {
            (-depth_x, cuboid.rotate([x.signum(), 0.0]), [a * x.signum(), z])
        } else {
            (-depth_z, cuboid.rotate([0.0, z.signum()]), [x, b * z.signum()])
        }
    } else {
        let (distance, normal) = direction(cuboid.world(nearest), disk.centre);
        (distance, normal, nearest)
    };
    Touch { gap: distance - radius, normal, points: [along(disk.centre, -radius, normal), cuboid.world(on_box)] }
}
