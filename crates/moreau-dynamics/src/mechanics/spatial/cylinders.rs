//! The sides, rims, edges and corners of a cylinder and of a box, another cylinder or a capsule that may touch each other;
//! `manifold` chooses.

use super::circles::Passage;
use super::manifold::{Meeting, SIDE, collect};
use super::round::{Rod, crossing, sphere_cylinder};
use super::shape::{Pose, corners};
use super::solids::{Cores, Edge, Solid, Widest, edges, rim};
use super::touch::{Touch, direction};

/// The first number of the points of the rims that are nearest to an edge.
const RIMS: u32 = 16;

/// A capsule at a cylinder: its ends as balls, and its side where it passes the cylinder's side and rims. Normals point to the capsule.
pub(super) fn capsule_cylinder(capsule: Rod, cylinder: Rod, touches: &mut Vec<Touch>) {
    let solids = [Solid::Capsule(capsule), Solid::Cylinder(cylinder)];
    let radius = capsule.radius;
    let ends = (0..).zip(capsule.ends()).map(|(side, end)| {
        let Touch { normal, points, .. } = sphere_cylinder(0.0, &end, cylinder);
        Meeting { cores: Cores { points: [end, points[1]], radii: [radius, 0.0] }, normal: Some(normal), features: [side, 0] }
    });
    let mut meetings: Vec<Meeting> = ends.collect();
    let beside = (0..).zip(capsule.ends()).map(|(side, end)| Meeting::side_ball(&cylinder, &end, radius, side).swapped());
    meetings.extend(beside);
    if let Some(points) = crossing(capsule.ends(), cylinder.ends()) {
        let passage = Passage { points, tangents: [capsule.axis(), cylinder.axis()] };
        meetings.push(Meeting::of(passage, [radius, cylinder.radius], [2, SIDE]));
    }
    for side in 0..2 {
        let found = rim(&cylinder, side).passes_line(&capsule.pose.centre, &capsule.axis());
        let passages = (0..).zip(found).filter_map(|(number, found)| Some((number, found?)));
        let inner = passages.filter(|(_, passage)| capsule.nearest(&passage.points[1]).1);
        meetings.extend(inner.map(|(number, passage)| Meeting::edge_line(passage, radius, [RIMS + 2 * number + side as u32, 2]).swapped()));
    }
    collect(solids, Widest::of(&solids), &meetings, touches);
}

/// A cylinder at a box; normals point to the cylinder.
pub(super) fn cylinder_box(cylinder: Rod, half_extents: [f64; 3], pose: &Pose, touches: &mut Vec<Touch>) {
    let solids = [Solid::Cylinder(cylinder), Solid::Box(half_extents, pose)];
    let corners = corners(half_extents).map(|corner| pose.world(corner));
    let mut meetings: Vec<Meeting> =
        (0..).zip(&corners).map(|(number, corner)| Meeting::side_ball(&cylinder, corner, 0.0, number)).collect();
    for Edge { ends, feature } in edges(half_extents, pose) {
        let along = direction(ends[0], ends[1]).1;
        if let Some(points) = crossing(cylinder.ends(), ends) {
            let passage = Passage { points, tangents: [cylinder.axis(), along] };
            meetings.push(Meeting::of(passage, [cylinder.radius, 0.0], [SIDE, feature]));
        }
        for side in 0..2 {
            let found = rim(&cylinder, side).passes_line(&ends[0], &along);
            let passages = (0..).zip(found).filter_map(|(number, found)| Some((number, found?)));
            meetings.extend(passages.map(|(number, passage)| Meeting::of(passage, [0.0; 2], [RIMS + 2 * number + side as u32, feature])));
        }
    }
    let widest = Widest::of(&solids).to_corners(&solids, cylinder, &corners);
    collect(solids, widest, &meetings, touches);
}

/// Two cylinders.
pub(super) fn cylinders(first: Rod, second: Rod, touches: &mut Vec<Touch>) {
    let solids = [Solid::Cylinder(first), Solid::Cylinder(second)];
    let mut meetings = Vec::new();
    if let Some(points) = crossing(first.ends(), second.ends()) {
        let passage = Passage { points, tangents: [first.axis(), second.axis()] };
        meetings.push(Meeting::of(passage, [first.radius, second.radius], [SIDE, SIDE]));
    }
    for side in 0..2 {
        for opposite in 0..2 {
            let found = rim(&first, side).passes_circle(&rim(&second, opposite));
            let features = |number: u32| [RIMS + 4 + 2 * number + side as u32, RIMS + 4 + opposite as u32];
            meetings.extend((0..).zip(found).map(|(number, passage)| Meeting::of(passage, [0.0; 2], features(number))));
        }
        for (body, [own, other]) in [[first, second], [second, first]].into_iter().enumerate() {
            let found = rim(&own, side).passes_line(&other.pose.centre, &other.axis());
            let passages = (0..).zip(found).filter_map(|(number, found)| Some((number, found?)));
            let meeting =
                |(number, passage): (u32, Passage)| Meeting::edge_line(passage, other.radius, [RIMS + 2 * number + side as u32, SIDE]);
            meetings.extend(passages.map(|found| if body == 0 { meeting(found) } else { meeting(found).swapped() }));
        }
    }
    collect(solids, Widest::of(&solids), &meetings, touches);
}
