//! Contact candidates of a pair of boxes.
//!
//! A collision library finds the separating axis and clips the two faces that look along it against each other
//! (fifteen axes; corners over a face and crossings of edges, with the numbers of their features). It measures every
//! point along that one axis, whose rate of change is not the points' relative velocity. So each pair of features is measured again:
//! ```text
//!     corner c over a face with normal n through f     φ = n·(c − f)                  points c and c − φ n
//!     edges through a, b with directions d, e          φ = n·(a′ − b′), n ∥ d × e     a′, b′ the feet of the common perpendicular
//! ```
//! Both have dφ/dt = n·(v_first − v_second) at those points, exactly. Parallel faces share one normal, see `faces`: then the gap is
//! measured along it, from corner to face and between the points of two edges that lie over each other.
//!
//! Along the separating axis every point of the clipped faces is at
//! least as far as the boxes are separated, and φ has the same sign with a factor cos of an angle: no candidate is deeper
//! than the boxes overlap, and none is negative while they do not.
//!
//! The axis may also run from an edge or corner of one box past an edge of the other. Corners then lie over the *plane* of a face, not over
//! the face: such pairs are left out while they are apart. And if no pair is as near as the boxes are apart along the axis, the nearest
//! points of their edges are a candidate too.
//!
//! A corner over the *rim* of the other face is inside or outside by rounding, and the clipping then also loses the crossing beside it: an
//! edge of one box over a face that ends where the edge does would touch with one point. Corners over the rim are candidates always.
//!
//! Two edges that cross at a small angle ψ have no reliable common normal, and need none: there the outline of the overlap bends by ψ
//! only, so the crossing lies within ψ L of the line between its neighbours, and its gap is theirs, interpolated, up to ψ L times
//! the tilt of the faces. Such crossings are left out, but where the faces lie on opposite sides of the edges: there the overlap is a
//! sliver, and the crossing its tip.
//!
//! Edges that are nearly parallel over each other and tilted against each other have a common normal along the faces. No contact is
//! where it points out of neither body: it must have no part against a face beside either edge, up to [`LEANING`], and its feet must be on
//! the edges, up to the gap.

use super::faces::Faces;
use super::shape::Pose;
use super::touch::{Touch, Touches, direction};
use crate::tolerance::mechanics::{BESIDE, LEANING, ON_RIM, PARALLEL, SAME_POINT};
use nalgebra::Vector3;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::details::{closest_points_segment_segment, contact_manifold_cuboid_cuboid};
use parry3d_f64::query::{ClosestPoints, ContactManifold, TrackedContact};
use parry3d_f64::shape::{Cuboid, FeatureId, Segment};

/// Appends the candidates of a pair of boxes, normals pointing to the first.
pub(super) fn box_box(half_extents: [f64; 3], first: &Pose, other: [f64; 3], second: &Pose, into: &mut Touches) {
    manifold([half_extents, other], [first, second], Faces::new, into);
}

/// Appends the candidates of a pair of boxes. `share` takes the outward normals of two faces that look at each other and gives their
/// shared normal.
pub(super) fn manifold(
    half_extents: [[f64; 3]; 2],
    poses: [&Pose; 2],
    share: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Option<Faces>,
    Touches { list: touches, manifold }: &mut Touches,
) {
    let (pair, begin) = (Pair::new(half_extents, poses), touches.len());
    // a manifold without points is a new one: nothing is taken over from the pair before
    manifold.clear();
    contact_manifold_cuboid_cuboid(&pair.relative, &pair.cuboids[0], &pair.cuboids[1], f64::MAX, manifold);
    let [own, opposite] = pair.facing(manifold);
    let faces = share(&own, &opposite);
    let rims = pair.over_rim(0, manifold).chain(pair.over_rim(1, manifold));
    for touch in manifold.points.iter().copied().chain(rims).filter_map(|point| pair.measure(&point, manifold, faces.as_ref())) {
        if touch.gap > 0.0 && pair.overshoot(&touch) > BESIDE * touch.gap + SAME_POINT * pair.size {
            continue;
        }
        let same = |known: &Touch| (known.points[0] - touch.points[0]).norm() <= SAME_POINT * pair.size;
        if !touches[begin..].iter().any(same) {
            touches.push(touch);
        }
    }
    let nearest = touches[begin..].iter().map(|touch| touch.gap).fold(f64::INFINITY, f64::min);
    let separation = pair.separation(manifold);
    let found = separation <= 0.0 || nearest <= separation * (1.0 + BESIDE) + SAME_POINT * pair.size;
    if touches.len() == begin || !found {
        touches.extend(pair.nearest_edges().filter(|touch| touch.gap < nearest));
    }
}

/// Two boxes, also in the terms of the collision library; lengths there are in units of `size`.
struct Pair<'a> {
    poses: [&'a Pose; 2],
    cuboids: [Cuboid; 2],
    relative: ParryPose,
    size: f64,
}

impl<'a> Pair<'a> {
    fn new(half_extents: [[f64; 3]; 2], poses: [&'a Pose; 2]) -> Self {
        let size = half_extents.iter().flatten().copied().fold(0.0, f64::max);
        let cuboid = |extents: [f64; 3]| Cuboid::new(vector(Vector3::from(extents) / size));
        let turn = poses[0].quaternion.inverse() * poses[1].quaternion;
        let rotation = Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w).normalize();
        let relative = ParryPose::from_parts(vector(poses[0].body(poses[1].centre) / size), rotation);
        Pair { poses, cuboids: half_extents.map(cuboid), relative, size }
    }

    /// A point of the library in the world.
    fn world(&self, body: usize, point: Vector) -> Vector3<f64> {
        self.poses[body].world(Vector3::new(point.x, point.y, point.z) * self.size)
    }

    /// The outward normals of the two faces that are clipped: those that look along the library's axis most directly.
    fn facing(&self, manifold: &ContactManifold<(), ()>) -> [Vector3<f64>; 2] {
        let axes = [manifold.local_n1, manifold.local_n2];
        [0, 1].map(|body| {
            let axis = Vector3::new(axes[body].x, axes[body].y, axes[body].z);
            let most = axis.iamax();
            self.poses[body].rotation.column(most) * if axis[most] < 0.0 { -1.0 } else { 1.0 }
        })
    }

    fn measure(&self, point: &TrackedContact<()>, manifold: &ContactManifold<(), ()>, faces: Option<&Faces>) -> Option<Touch> {
        let points = [self.world(0, point.local_p1), self.world(1, point.local_p2)];
        let turn = |own: Vector3<f64>| faces.map_or(own, |faces| faces.turn(own));
        let along = |own: Vector3<f64>, normal: &Vector3<f64>| own.dot(&(points[0] - points[1])) / own.dot(normal);
        let is_crossing = matches!((point.fid1.unpack(), point.fid2.unpack()), (FeatureId::Edge(_), FeatureId::Edge(_)));
        let (normal, feet) = match (point.fid1.unpack(), point.fid2.unpack()) {
            (FeatureId::Vertex(_), FeatureId::Face(face)) => {
                let own = self.face(1, face);
                let normal = turn(own);
                (normal, [points[0], points[0] - normal * along(own, &normal)])
            }
            (FeatureId::Face(face), FeatureId::Vertex(_)) => {
                let own = -self.face(0, face);
                let normal = turn(own);
                (normal, [points[1] + normal * along(own, &normal), points[1]])
            }
            (FeatureId::Edge(edge), FeatureId::Edge(other)) => {
                let axis = manifold.local_n1;
                let outward = self.poses[0].rotation * -Vector3::new(axis.x, axis.y, axis.z);
                self.crossing([edge, other].map(edge_axis), points, outward, turn)?
            }
            _ => return None,
        };
        let gap = normal.dot(&(feet[0] - feet[1]));
        let touch = Touch::new(gap, normal, feet, [point.fid1.0, point.fid2.0]);
        // the normal may lean against the axis of the clipping by half a right angle: the feet are then beside by the depth
        if is_crossing && self.overshoot(&touch) > gap.abs() + SAME_POINT * self.size {
            return None;
        }
        Some(faces.map_or(touch, |faces| faces.join(touch)))
    }

    /// Corners of a body's face that lie over the rim of the other one along the library's axis, up to [`ON_RIM`].
    fn over_rim(&self, body: usize, manifold: &ContactManifold<(), ()>) -> impl Iterator<Item = TrackedContact<()>> {
        let (axes, other) = ([manifold.local_n1, manifold.local_n2], 1 - body);
        let face = self.cuboids[body].support_face(axes[body]);
        let (opposite, rim) = (self.cuboids[other].support_face(axes[other]).fid, Rim::new(axes[other], self.cuboids[other].half_extents));
        let into = if body == 0 { self.relative.inverse() } else { self.relative };
        face.vertices.into_iter().zip(face.vids).filter_map(move |(corner, feature)| {
            let (foot, distance) = rim.foot(into * corner)?;
            Some(TrackedContact::flipped(corner, foot, feature, opposite, distance, body == 1))
        })
    }

    /// How far the boxes are apart along the axis the library has chosen \[m\]; they are at least as far from each other.
    fn separation(&self, manifold: &ContactManifold<(), ()>) -> f64 {
        let axis = self.poses[0].rotation * Vector3::new(manifold.local_n1.x, manifold.local_n1.y, manifold.local_n1.z);
        let half_width = |body: usize| {
            let extents = self.cuboids[body].half_extents;
            self.poses[body].rotation.tr_mul(&axis).abs().dot(&Vector3::new(extents.x, extents.y, extents.z)) * self.size
        };
        axis.dot(&(self.poses[1].centre - self.poses[0].centre)) - half_width(0) - half_width(1)
    }

    /// How far the points of a candidate lie outside the boxes' surfaces \[m\].
    fn overshoot(&self, touch: &Touch) -> f64 {
        let outside = |body: usize| {
            let point = self.poses[body].body(touch.points[body]);
            let extents = self.cuboids[body].half_extents;
            let over = point.abs() - Vector3::new(extents.x, extents.y, extents.z) * self.size;
            over.max()
        };
        outside(0).max(outside(1))
    }

    /// Outward normal of a face: faces 10, 11, 12 look along −x, −y, −z, faces 13, 14, 15 along +x, +y, +z.
    fn face(&self, body: usize, face: u32) -> Vector3<f64> {
        let number = face.saturating_sub(10);
        let sign = if number < 3 { -1.0 } else { 1.0 };
        self.poses[body].rotation.column((number % 3) as usize) * sign
    }

    /// Normal and feet of two edges along these axes that cross, from two points on them: `turn` of their common perpendicular, which has
    /// the sense of `outward`, and the points where one edge lies over the other along the normal.
    fn crossing(
        &self,
        axes: [usize; 2],
        points: [Vector3<f64>; 2],
        outward: Vector3<f64>,
        turn: impl Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<(Vector3<f64>, [Vector3<f64>; 2])> {
        let [own, other] = [0, 1].map(|body| self.poses[body].rotation.column(axes[body]).into_owned());
        let beside = [0, 1].map(|body| self.beside(body, axes[body], points[body]));
        let cross = own.cross(&other);
        let length = cross.norm();
        if length < if are_opposite(&beside, &outward) { SAME_POINT } else { PARALLEL } {
            return None;
        }
        let sign = if cross.dot(&outward) < 0.0 { -1.0 } else { 1.0 };
        let normal = turn(cross * (sign / length));
        let points_out = |body: usize, sense: f64| beside[body].iter().all(|face| sense * face.dot(&normal) >= -LEANING);
        if !points_out(0, -1.0) || !points_out(1, 1.0) {
            return None;
        }
        // a − s d − (b − t e) is along n: multiply by e × n and d × n.
        let (difference, volume) = (points[0] - points[1], cross.dot(&normal));
        let along = difference.cross(&other).dot(&normal) / volume;
        let across = difference.cross(&own).dot(&normal) / volume;
        Some((normal, [points[0] - own * along, points[1] - other * across]))
    }

    /// The outward normals of the two faces that meet at the edge along an axis through a point.
    fn beside(&self, body: usize, axis: usize, point: Vector3<f64>) -> [Vector3<f64>; 2] {
        let (pose, place) = (self.poses[body], self.poses[body].body(point));
        [(axis + 1) % 3, (axis + 2) % 3].map(|face| pose.rotation.column(face) * place[face].signum())
    }

    /// The two nearest points of the boxes' edges, where no corner is over a face and no edges cross.
    fn nearest_edges(&self) -> Option<Touch> {
        let mut best: Option<Touch> = None;
        for (own, edge) in (0..).zip(edges(&self.cuboids[0])) {
            for (other, opposite) in (0..).zip(edges(&self.cuboids[1])) {
                let ClosestPoints::WithinMargin(a, b) = closest_points_segment_segment(&self.relative, &edge, &opposite, f64::MAX) else {
                    continue;
                };
                let points = [self.world(0, a), self.world(1, b)];
                let (gap, normal) = direction(points[1], points[0]);
                if best.is_none_or(|best| gap < best.gap) {
                    best = Some(Touch::new(gap, normal, points, [own, other]));
                }
            }
        }
        best
    }
}

/// Whether the faces that look at each other along `outward` lie on opposite sides of an edge: of the two faces beside each edge the other
/// one, that looks along `outward` least, says on which side its body is not.
fn are_opposite(beside: &[[Vector3<f64>; 2]; 2], outward: &Vector3<f64>) -> bool {
    let aside = beside.map(|[one, other]| if one.dot(outward).abs() < other.dot(outward).abs() { one } else { other });
    aside[0].dot(&aside[1]) < 0.0
}

/// The rim of the face of a box that looks along an outward axis.
struct Rim {
    axis: [f64; 3],
    half: [f64; 3],
    facing: usize,
    /// How far the face is along the axis.
    reach: f64,
}

impl Rim {
    fn new(along: Vector, half_extents: Vector) -> Self {
        let [axis, half] = [along, half_extents].map(|x| [x.x, x.y, x.z]);
        let facing = Vector3::from(axis).iamax();
        Rim { axis, half, facing, reach: half[facing] / axis[facing].abs() }
    }

    /// The foot of a place along the axis on the face, and how far it is, if the foot is on the rim.
    fn foot(&self, place: Vector) -> Option<(Vector, f64)> {
        let (place, facing) = ([place.x, place.y, place.z], self.facing);
        let distance = place[facing] / self.axis[facing] - self.reach;
        let foot: [f64; 3] = std::array::from_fn(|k| place[k] - self.axis[k] * distance);
        let [one, other] = [1, 2].map(|next| (facing + next) % 3).map(|k| foot[k].abs() - self.half[k]);
        (one.max(other).abs() <= ON_RIM).then(|| (Vector::new(foot[0], foot[1], foot[2]), distance))
    }
}

fn vector(x: Vector3<f64>) -> Vector {
    Vector::new(x[0], x[1], x[2])
}

/// The axis along which an edge runs: its number holds the two corners it joins, three bits each, x first, and they differ in one.
fn edge_axis(edge: u32) -> usize {
    match ((edge >> 3) ^ edge) & 0b111 {
        0b100 => 0,
        0b010 => 1,
        _ => 2,
    }
}

/// The twelve edges of a box.
fn edges(cuboid: &Cuboid) -> impl Iterator<Item = Segment> {
    let [a, b, c] = [cuboid.half_extents.x, cuboid.half_extents.y, cuboid.half_extents.z];
    let corners = super::shape::corners([a, b, c]).map(vector);
    [1usize, 2, 4]
        .into_iter()
        .flat_map(move |bit| (0..8usize).filter(move |k| k & bit == 0).map(move |k| (k, bit)))
        .map(move |(k, bit)| Segment::new(corners[k], corners[k | bit]))
}
