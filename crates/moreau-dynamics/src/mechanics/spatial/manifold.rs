//! What two convex bodies touch each other with, along the direction in which they are farthest apart or overlap least.
//!
//! ```text
//!     over a face with normal n through f    φ = n·(p − f)       p the lowest point of a rim, an end or a corner
//!     two edges with tangents t, e           φ = n·(p − q)       n ∥ t × e, the edges a rim, and a rim or an edge of the box
//!     a side about x + s a                   φ = n·(p − q)       n ⊥ a, p on a corner, a rim or an edge, q = foot on the axis + r n
//!     two sides                              φ = ‖a′ − b′‖ − r₁ − r₂
//! ```
//! First the direction is found along which the bodies are farthest apart or overlap least, see `solids`. What faces it is measured, each
//! pair of features along its own normal and between points of both bodies: so n·(v_first − v_second) at these points is dφ/dt, and
//! no gap is less than the distance of the bodies, or deeper than they overlap. Where they are apart between features that no
//! candidate is made of, such as a corner and a rim, their nearest points are one.
//!
//! Parallel faces share one normal, see `faces`. Their common area is a polygon and discs, or two discs: its corners are candidates, where
//! outlines cross, and of every disc four points that turn with it and the one farthest inside the other face. A disc that leans against
//! a face by less than [`STANDING`] touches with the four and its lowest point, one that leans more with that point only.

use super::circles::Passage;
use super::faces::Faces;
use super::round::Rod;
use super::shape::{Pose, corners};
use super::solids::{Cores, Face, Solid, Widest, rim};
use super::touch::{Touch, direction};
use crate::tolerance::mechanics::{BESIDE, FACING, PARALLEL_FACES, SAME_POINT, STANDING};
use nalgebra::Vector3;

/// Numbers of the features of a cylinder: 0 and 1 are the lowest points of its rims, 4 to 11 points that turn with it, 12 and 13 its ends.
pub(super) const SIDE: u32 = 14;
/// The first number of the corners of the common area of two faces.
const OUTLINE: u32 = 128;

/// Appends the candidates of a pair, given some directions and where its edges, sides and corners pass each other.
pub(super) fn collect(solids: [Solid; 2], mut widest: Widest, meetings: &[Meeting], touches: &mut Vec<Touch>) {
    for Meeting { cores, normal, .. } in meetings {
        normal.iter().for_each(|normal| widest.consider(&solids, *normal, Some(*cores)));
        widest.consider(&solids, cores.points[0] - cores.points[1], Some(*cores));
    }
    let mut manifold = Manifold::new(solids, widest, touches);
    if !manifold.faces_meet() {
        manifold.edges_meet(meetings);
    }
}

/// Where an edge, a side or a corner of one body passes one of the other.
pub(super) struct Meeting {
    /// The points, and how far the surfaces are from them.
    pub cores: Cores,
    /// Normal to both, of any sign, unless they are parallel.
    pub normal: Option<Vector3<f64>>,
    /// Numbers of the features of the first and of the second body.
    pub features: [u32; 2],
}

impl Meeting {
    /// Edges with these tangents, or sides with these radii about the lines.
    pub fn of(passage: Passage, radii: [f64; 2], features: [u32; 2]) -> Self {
        Meeting { cores: Cores { points: passage.points, radii }, normal: passage.across(), features }
    }

    /// A rim of the first body, and the axis of the second, whose side has this radius; they have a way between them, or cross.
    pub fn edge_line(passage: Passage, radius: f64, features: [u32; 2]) -> Self {
        let points = passage.points;
        let (distance, way) = direction(points[1], points[0]);
        let normal = passage.across().or((distance > 0.0).then_some(way));
        Meeting { cores: Cores { points, radii: [0.0, radius] }, normal, features }
    }

    /// The side of a cylinder, and a ball about a point, or a corner if the radius is 0.
    pub fn side_ball(cylinder: &Rod, point: &Vector3<f64>, radius: f64, number: u32) -> Self {
        let (axis, centre) = (cylinder.axis(), cylinder.pose.centre);
        let foot = centre + axis * axis.dot(&(point - centre));
        let (distance, normal) = direction(*point, foot);
        let cores = Cores { points: [foot, *point], radii: [cylinder.radius, radius] };
        Meeting { cores, normal: (distance > 0.0).then_some(normal), features: [SIDE, number] }
    }

    /// The same with first and second exchanged.
    pub fn swapped(self) -> Self {
        let Cores { points: [a, b], radii: [r, s] } = self.cores;
        let [own, other] = self.features;
        Meeting { cores: Cores { points: [b, a], radii: [s, r] }, features: [other, own], ..self }
    }
}

/// The candidates of a pair while they are collected.
struct Manifold<'a> {
    solids: [Solid<'a>; 2],
    widest: Widest,
    /// The faces that look at each other along the widest direction.
    faces: [Option<Face>; 2],
    size: f64,
    touches: &'a mut Vec<Touch>,
    begin: usize,
}

impl<'a> Manifold<'a> {
    fn new(solids: [Solid<'a>; 2], widest: Widest, touches: &'a mut Vec<Touch>) -> Self {
        let faces = [solids[0].face(&-widest.normal), solids[1].face(&widest.normal)];
        let (size, begin) = (solids[0].size().max(solids[1].size()), touches.len());
        Manifold { solids, widest, faces, size, touches, begin }
    }

    /// Keeps a candidate that faces the widest direction and whose points are on the sides of the bodies that do, if none is at its place.
    fn keep(&mut self, touch: Touch) {
        let (widest, solids) = (self.widest.normal, &self.solids);
        let slack = BESIDE * touch.gap.abs() + SAME_POINT * self.size;
        let outside = |body: usize| solids[body].outside(&touch.points[body]) > slack;
        let behind = |body: usize, sign: f64| sign * widest.dot(&(touch.points[body] - solids[body].pose().centre)) > 0.0;
        let same = |known: &Touch| (0..2).all(|body| (known.points[body] - touch.points[body]).norm() <= SAME_POINT * self.size);
        let faces = touch.normal.dot(&widest) > FACING && !behind(0, 1.0) && !behind(1, -1.0);
        if faces && !outside(0) && !outside(1) && !self.touches[self.begin..].iter().any(same) {
            self.touches.push(touch);
        }
    }

    /// Whether a candidate is as near as the bodies are, up to this \[m\].
    fn is_found(&self, slack: f64) -> bool {
        let nearest = self.touches[self.begin..].iter().map(|touch| touch.gap).fold(f64::INFINITY, f64::min);
        nearest <= self.widest.gap + BESIDE * self.widest.gap.abs() + slack
    }

    fn push(&mut self, normal: Vector3<f64>, points: [Vector3<f64>; 2], features: [u32; 2]) {
        self.keep(Touch::new(normal.dot(&(points[0] - points[1])), normal, points, features));
    }

    /// The candidates of faces that look at each other if they are parallel, and whether that is all; otherwise those of corners and rims
    /// over the faces.
    fn faces_meet(&mut self) -> bool {
        if let [Some(own), Some(opposite)] = self.faces
            && let Some(faces) = Faces::new(&own.normal, &opposite.normal)
        {
            let pair = [own, opposite];
            (0..2).for_each(|body| self.over_parallel(body, &pair, &faces));
            let outline = match self.solids {
                [Solid::Cylinder(first), Solid::Cylinder(second)] => discs(&first, &second, &pair, &faces),
                [Solid::Cylinder(disc), Solid::Box(half_extents, pose)] => disc_and_sides(&disc, half_extents, pose, &pair, &faces),
                _ => Vec::new(),
            };
            for (number, place) in (0..).zip(outline) {
                self.between(place, faces.normal, (&pair, &faces), [OUTLINE + number, OUTLINE]);
            }
            // what leans so little has no lowest points of rims: the four that turn with it are higher by (1 − √½) r times the angle
            return self.is_found(PARALLEL_FACES * self.size);
        }
        for body in 0..2 {
            if let Some(face) = self.faces[1 - body] {
                for (place, feature) in self.vertices(body, &face, true) {
                    let foot = place - face.normal * face.height(&place);
                    let (normal, points) = if body == 0 { (face.normal, [place, foot]) } else { (-face.normal, [foot, place]) };
                    self.push(normal, points, if body == 0 { [feature, face.feature] } else { [face.feature, feature] });
                }
            }
        }
        false
    }

    /// What a body has over the face of the other one that looks at it: corners, points of its rims that turn with it, and their `lowest`.
    fn vertices(&self, body: usize, face: &Face, lowest: bool) -> Vec<(Vector3<f64>, u32)> {
        let mut found = Vec::with_capacity(8);
        match self.solids[body] {
            Solid::Capsule(rod) => found.extend(rod.ends().map(|end| end - face.normal * rod.radius).into_iter().zip(0..)),
            Solid::Box(half_extents, pose) => found.extend(corners(half_extents).map(|corner| pose.world(corner)).into_iter().zip(0..)),
            Solid::Cylinder(cylinder) => {
                let axis = cylinder.axis();
                let across = face.normal - axis * face.normal.dot(&axis);
                let leaning = across.norm();
                for (side, middle) in (0..).zip(cylinder.ends()) {
                    if lowest && leaning > PARALLEL_FACES {
                        found.push((middle - across * (cylinder.radius / leaning), side));
                    }
                    if leaning < STANDING {
                        let [x, y] = rim(&cylinder, side as usize).plane.map(|out| out * cylinder.radius);
                        found.extend([x, y, -x, -y].map(|out| middle + out).into_iter().zip([4, 6, 8, 10].map(|first| first + side)));
                    }
                }
            }
        }
        found
    }

    /// The corners of a body, or points that turn with it, over a face that is parallel to its own.
    fn over_parallel(&mut self, body: usize, pair: &[Face; 2], faces: &Faces) {
        let face = &pair[1 - body];
        let normal = if body == 0 { face.normal } else { -face.normal };
        for (place, feature) in self.vertices(body, face, false) {
            let features = if body == 0 { [feature, face.feature] } else { [face.feature, feature] };
            self.between(place, normal, (pair, faces), features);
        }
    }

    /// The candidate of two parallel faces at a place next to both, whose own normal is `own`.
    fn between(&mut self, place: Vector3<f64>, own: Vector3<f64>, (pair, faces): (&[Face; 2], &Faces), features: [u32; 2]) {
        let normal = faces.turn(own);
        let points = pair.map(|face| place - normal * (face.height(&place) / face.normal.dot(&normal)));
        let gap = normal.dot(&(points[0] - points[1]));
        self.keep(faces.join(Touch::new(gap, normal, points, features)));
    }

    /// Edges, sides and corners that pass each other, and the nearest points of both bodies if nothing else is as near.
    fn edges_meet(&mut self, meetings: &[Meeting]) {
        for Meeting { cores, normal, features } in meetings {
            if let Some(normal) = normal {
                let normal = normal * if normal.dot(&self.widest.normal) < 0.0 { -1.0 } else { 1.0 };
                self.push(normal, cores.surfaces(&normal), *features);
            }
        }
        let Widest { normal, cores, .. } = self.widest;
        if let Some(cores) = cores.filter(|_| !self.is_found(SAME_POINT * self.size)) {
            self.push(normal, cores.surfaces(&normal), [OUTLINE, OUTLINE]);
        }
    }
}

/// Where the outlines of two discs cross, and the point of each that is farthest inside the other one.
///
/// Discs with one centre have no direction in which they overlap most, and need none: each has points of its own in the other.
fn discs(first: &Rod, second: &Rod, pair: &[Face; 2], faces: &Faces) -> Vec<Vector3<f64>> {
    let [own, other] = [first.ends()[pair[0].index], second.ends()[pair[1].index]];
    let apart = other - own;
    let level = apart - faces.normal * faces.normal.dot(&apart);
    let (distance, [r, s]) = (level.norm(), [first.radius, second.radius]);
    if distance <= (r - s).abs() + SAME_POINT * (r + s) || distance >= r + s {
        return Vec::new();
    }
    let along = level / distance;
    let reach = (distance * distance + r * r - s * s) / (2.0 * distance);
    let aside = faces.normal.cross(&along) * (r * r - reach * reach).max(0.0).sqrt();
    vec![own + along * reach + aside, own + along * reach - aside, own + along * r, other - along * s]
}

/// Where the outline of a disc crosses the edges of the face of a box, and the point farthest from each edge that it crosses.
fn disc_and_sides(disc: &Rod, half_extents: [f64; 3], pose: &Pose, pair: &[Face; 2], faces: &Faces) -> Vec<Vector3<f64>> {
    let (centre, face, r) = (disc.ends()[pair[0].index], &pair[1], disc.radius);
    let mut found = Vec::new();
    for axis in (0..3).filter(|axis| *axis != face.index) {
        let outward = pose.rotation.column(axis).into_owned();
        let along = faces.normal.cross(&outward);
        for side in [-1.0, 1.0] {
            let reach = half_extents[axis] - side * outward.dot(&(centre - pose.centre));
            if reach.abs() < r {
                let [foot, half] = [outward * (side * reach), along * (r * r - reach * reach).sqrt()];
                found.extend([foot + half, foot - half, outward * (-side * r)].map(|place| centre + place));
            }
        }
    }
    found
}
