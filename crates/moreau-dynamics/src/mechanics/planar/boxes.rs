//! Two contact candidates of a pair of boxes, each a vertex of one against a face of the other.
//!
//! 1. The *reference face* is the one of the eight faces from which the other box is farthest (separating axis with the
//!    least overlap; ties go to the first box, then to the lower face number).
//! 2. The *incident face* of the other box is the one facing it most directly.
//! 3. Along the reference face both faces are intervals; the two ends of their overlap are the candidates. An end that
//!    belongs to the incident box is measured against the reference face, and one of the reference box against the
//!    incident face. If the intervals do not overlap, both candidates are the two nearest end points.
//!
//! In every case the gap is a distance between material features, so dφ/dt = H_n v holds wherever the choice is
//! locally constant. Parallel faces share one normal, along which both gaps are measured, see `faces`.

use super::faces::Faces;
use super::shape::{Pose, corners};
use super::touch::{Touch, along, direction, dot};

/// Outward normal and end points of a face, in the world; the tangent runs from `ends[0]` to `ends[1]`.
struct Face {
    normal: [f64; 2],
    ends: [[f64; 2]; 2],
}

/// An end of the overlap: a vertex, and whether it belongs to the incident box.
struct End {
    vertex: [f64; 2],
    place: f64,
    incident: bool,
}

/// The two candidates of a pair of boxes, normals pointing to the first.
pub(super) fn box_box(half_extents: [f64; 2], first: &Pose, other: [f64; 2], second: &Pose) -> [Touch; 2] {
    manifold([half_extents, other], [first, second], Faces::new)
}

/// The candidates of a pair of boxes. `share` takes the outward normals of two faces that look at each other and gives their shared normal.
pub(super) fn manifold(half_extents: [[f64; 2]; 2], poses: [&Pose; 2], share: impl Fn([f64; 2], [f64; 2]) -> Option<Faces>) -> [Touch; 2] {
    let [faces_first, faces_second] = [0, 1].map(|body| faces(half_extents[body], poses[body]));
    let (separation_first, best_first) = farthest(&faces_first, &faces_second);
    let (separation_second, best_second) = farthest(&faces_second, &faces_first);
    if separation_second > separation_first {
        clip(&faces_second[best_second], &faces_first, share)
    } else {
        clip(&faces_first[best_first], &faces_second, share).map(Touch::swapped)
    }
}

/// Faces in the order of their first corner; the outward normal is the tangent turned by −90°.
fn faces(half_extents: [f64; 2], pose: &Pose) -> [Face; 4] {
    let corners = corners(half_extents).map(|corner| pose.world(corner));
    let normals = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]].map(|normal| pose.rotate(normal));
    std::array::from_fn(|k| Face { normal: normals[k], ends: [corners[k], corners[(k + 1) % 4]] })
}

/// The largest separation of the other box from a face, and the face.
fn farthest(faces: &[Face; 4], other: &[Face; 4]) -> (f64, usize) {
    let separation = |face: &Face| {
        let heights = other.iter().map(|face_other| dot(face.normal, face_other.ends[0]) - dot(face.normal, face.ends[0]));
        heights.fold(f64::INFINITY, f64::min)
    };
    let mut best = (separation(&faces[0]), 0);
    for (k, face) in faces.iter().enumerate().skip(1) {
        let candidate = separation(face);
        if candidate > best.0 {
            best = (candidate, k);
        }
    }
    best
}

/// The candidates with normals pointing to the incident box.
fn clip(reference: &Face, others: &[Face; 4], share: impl Fn([f64; 2], [f64; 2]) -> Option<Faces>) -> [Touch; 2] {
    let mut incident = &others[0];
    for face in &others[1..] {
        if dot(face.normal, reference.normal) < dot(incident.normal, reference.normal) {
            incident = face;
        }
    }
    let (_, tangent) = direction(reference.ends[0], reference.ends[1]);
    let end = |vertex: [f64; 2], incident: bool| End { vertex, place: dot(tangent, vertex), incident };
    // Both boundaries run counter-clockwise, so facing faces run in opposite senses.
    let low = later(end(reference.ends[0], false), end(incident.ends[1], true));
    let high = earlier(end(reference.ends[1], false), end(incident.ends[0], true));
    if low.place > high.place {
        let (on_incident, on_reference) = if low.incident { (&low, &high) } else { (&high, &low) };
        let (distance, normal) = direction(on_reference.vertex, on_incident.vertex);
        let touch = Touch { gap: distance, normal, points: [on_incident.vertex, on_reference.vertex] };
        return [touch, touch];
    }
    let shared = share(incident.normal, reference.normal);
    [low, high].map(|end| measure(&end, reference, incident, shared.as_ref()))
}

fn later(a: End, b: End) -> End {
    if a.place > b.place { a } else { b }
}

fn earlier(a: End, b: End) -> End {
    if a.place < b.place { a } else { b }
}

/// The signed distance of a vertex from the face of the other box, along the shared normal if there is one.
fn measure(end: &End, reference: &Face, incident: &Face, shared: Option<&Faces>) -> Touch {
    let face = if end.incident { reference } else { incident };
    let own = if end.incident { face.normal } else { face.normal.map(|x| -x) };
    let normal = shared.map_or(own, |shared| shared.turn(own));
    let gap = (dot(face.normal, end.vertex) - dot(face.normal, face.ends[0])) / dot(own, normal);
    let points = if end.incident { [end.vertex, along(end.vertex, -gap, normal)] } else { [along(end.vertex, gap, normal), end.vertex] };
    let touch = Touch { gap, normal, points };
    shared.map_or(touch, |shared| shared.join(touch))
}
