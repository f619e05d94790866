//! Where a capsule touches a box: with its ends as spheres, and with its side at the corners and edges of the box; `manifold` chooses.

use super::circles::Passage;
use super::manifold::{Meeting, SIDE, collect};
use super::round::{Rod, crossing};
use super::shape::{Pose, corners};
use super::solids::{Cores, Edge, Solid, Widest, edges};
use super::spheres::sphere_box;
use super::touch::{Touch, direction};

/// A capsule at a box: its ends as balls, and its side at the corners and edges; normals point to the capsule.
pub(super) fn capsule_box(capsule: Rod, half_extents: [f64; 3], cuboid: &Pose, touches: &mut Vec<Touch>) {
    let solids = [Solid::Capsule(capsule), Solid::Box(half_extents, cuboid)];
    let radius = capsule.radius;
    let ends = (0..).zip(capsule.ends()).map(|(side, end)| {
        let Touch { normal, points, .. } = sphere_box(0.0, &end, half_extents, cuboid);
        Meeting { cores: Cores { points: [end, points[1]], radii: [radius, 0.0] }, normal: Some(normal), features: [side, 0] }
    });
    let corners = (0..).zip(corners(half_extents).map(|corner| cuboid.world(corner)));
    let beside = corners.filter(|(_, corner)| capsule.nearest(corner).1);
    let mut meetings: Vec<Meeting> =
        ends.chain(beside.map(|(number, corner)| Meeting::side_ball(&capsule, &corner, 0.0, number))).collect();
    for Edge { ends, feature } in edges(half_extents, cuboid) {
        if let Some(points) = crossing(capsule.ends(), ends) {
            let passage = Passage { points, tangents: [capsule.axis(), direction(ends[0], ends[1]).1] };
            meetings.push(Meeting::of(passage, [radius, 0.0], [SIDE, feature]));
        }
    }
    collect(solids, Widest::of(&solids), &meetings, touches);
}
