//! Cylinders, boxes and capsules as convex bodies that are their own mirror image: how wide they are, their flat faces, and how far apart
//! two of them are along a direction.
//!
//! ```text
//!     h(n) = max n·(y − x)       cylinder: l |a·n| + r ‖n × a‖       box: Σ_k c_k |b_k·n|       capsule: l |a·n| + r
//!     s(n) = |n·(x₁ − x₂)| − h₁(n) − h₂(n) ≤ max s
//!     max s = distance of two bodies that are apart ,   −max s the least way that parts two that overlap
//! ```
//! The largest s(n) is at the normal of a face, at a direction normal to two edges – of a box, of a side, of a rim – or along the shortest
//! way from a corner or a rim to the other body. Each of them is tried; one too many does no harm.

use super::circles::Circle;
use super::round::{Rod, sphere_cylinder};
use super::shape::{Pose, corners};
use crate::tolerance::mechanics::FACING;
use nalgebra::Vector3;

/// A body that two of its kind make a pair of.
#[derive(Clone, Copy)]
pub(super) enum Solid<'a> {
    /// A cylinder.
    Cylinder(Rod<'a>),
    /// A capsule.
    Capsule(Rod<'a>),
    /// A box by its half extents.
    Box([f64; 3], &'a Pose),
}

/// A flat face.
#[derive(Clone, Copy)]
pub(super) struct Face {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    /// A point on it.
    pub point: Vector3<f64>,
    /// Its number among the features of the body.
    pub feature: u32,
    /// 0 and 1 for the lower and the upper end of a cylinder; 0, 1, 2 for the axis of a box.
    pub index: usize,
}

impl Face {
    /// How high a point is over it \[m\].
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.point))
    }
}

/// An edge of a box between two corners.
pub(super) struct Edge {
    /// Its ends.
    pub ends: [Vector3<f64>; 2],
    /// Its number among the features of the box.
    pub feature: u32,
}

/// The edges of a box: their corners differ in one bit.
pub(super) fn edges(half_extents: [f64; 3], pose: &Pose) -> impl Iterator<Item = Edge> {
    let corners = corners(half_extents).map(|corner| pose.world(corner));
    let pairs = (0..8usize).flat_map(|k| [4, 2, 1].map(|bit| (k, bit))).filter(|(k, bit)| k & bit == 0);
    pairs.map(move |(k, bit)| Edge { ends: [corners[k], corners[k | bit]], feature: (8 + 8 * bit + k) as u32 })
}

/// The circle about the end of a cylinder.
pub(super) fn rim(cylinder: &Rod, side: usize) -> Circle {
    let plane = [0, 1].map(|column| cylinder.pose.rotation.column(column).into_owned());
    Circle { centre: cylinder.ends()[side], plane, radius: cylinder.radius }
}

impl Solid<'_> {
    /// Where it is.
    pub fn pose(&self) -> &Pose {
        match self {
            Solid::Cylinder(rod) | Solid::Capsule(rod) => rod.pose,
            Solid::Box(_, pose) => pose,
        }
    }

    /// The largest of its lengths \[m\].
    pub fn size(&self) -> f64 {
        match self {
            Solid::Cylinder(rod) | Solid::Capsule(rod) => rod.radius.max(rod.half_height),
            Solid::Box(half_extents, _) => Vector3::from(*half_extents).max(),
        }
    }

    /// h(n) \[m\].
    fn half_width(&self, normal: &Vector3<f64>) -> f64 {
        match self {
            Solid::Cylinder(Rod { radius, half_height, .. }) => {
                let axis = self.pose().rotation.column(2);
                half_height * axis.dot(normal).abs() + radius * axis.cross(normal).norm()
            }
            Solid::Capsule(rod) => rod.half_height * rod.axis().dot(normal).abs() + rod.radius,
            Solid::Box(half_extents, pose) => pose.rotation.tr_mul(normal).abs().dot(&Vector3::from(*half_extents)),
        }
    }

    /// How far a point is outside, along the axis of the body where it is farthest \[m\]; negative inside.
    pub fn outside(&self, point: &Vector3<f64>) -> f64 {
        let own = self.pose().body(*point);
        match self {
            Solid::Cylinder(Rod { radius, half_height, .. }) => (own.x.hypot(own.y) - radius).max(own.z.abs() - half_height),
            Solid::Capsule(rod) => (point - rod.nearest(point).0).norm() - rod.radius,
            Solid::Box(half_extents, _) => (own.abs() - Vector3::from(*half_extents)).max(),
        }
    }

    /// The face that looks along a unit vector, if one does.
    pub fn face(&self, towards: &Vector3<f64>) -> Option<Face> {
        let own = self.pose().rotation.tr_mul(towards);
        let (axis, depth) = match self {
            Solid::Cylinder(cylinder) => (2, cylinder.half_height),
            Solid::Box(half_extents, _) => (own.iamax(), half_extents[own.iamax()]),
            Solid::Capsule(_) => return None,
        };
        let up = own[axis] > 0.0;
        let normal = self.pose().rotation.column(axis) * if up { 1.0 } else { -1.0 };
        let (feature, index) = match self {
            Solid::Box(..) => (64 + 2 * axis as u32 + u32::from(up), axis),
            _ => (12 + u32::from(up), usize::from(up)),
        };
        (own[axis].abs() > FACING).then(|| Face { normal, point: self.pose().centre + normal * depth, feature, index })
    }
}

/// The direction along which two bodies are farthest apart, or overlap least.
#[derive(Clone, Copy)]
pub(super) struct Widest {
    /// Unit vector, from the second body to the first.
    pub normal: Vector3<f64>,
    /// s \[m\].
    pub gap: f64,
    /// What is nearest to each other, where the direction was found as theirs.
    pub cores: Option<Cores>,
}

/// A point of each body, or of the axis of its side.
#[derive(Clone, Copy)]
pub(super) struct Cores {
    /// On the first and on the second body.
    pub points: [Vector3<f64>; 2],
    /// The radius of the side about the axis, 0 for a point of an edge \[m\].
    pub radii: [f64; 2],
}

impl Cores {
    /// The points of the surfaces along a normal that points to the first body.
    pub fn surfaces(&self, normal: &Vector3<f64>) -> [Vector3<f64>; 2] {
        [self.points[0] - normal * self.radii[0], self.points[1] + normal * self.radii[1]]
    }
}

impl Widest {
    /// Along the normals of the faces of both, and the directions at right angles to a side and an edge, or to two sides.
    pub fn of(solids: &[Solid; 2]) -> Self {
        let mut widest = Widest { normal: Vector3::z(), gap: f64::NEG_INFINITY, cores: None };
        let axes = |solid: &Solid| match solid {
            Solid::Cylinder(rod) | Solid::Capsule(rod) => vec![rod.axis()],
            Solid::Box(_, pose) => (0..3).map(|axis| pose.rotation.column(axis).into_owned()).collect(),
        };
        let [own, other] = [axes(&solids[0]), axes(&solids[1])];
        own.iter().chain(&other).for_each(|axis| widest.consider(solids, *axis, None));
        own.iter().for_each(|a| other.iter().for_each(|b| widest.consider(solids, a.cross(b), None)));
        widest
    }

    /// Also along the shortest ways from a cylinder to the corners of a box.
    pub fn to_corners(mut self, solids: &[Solid; 2], cylinder: Rod, corners: &[Vector3<f64>; 8]) -> Self {
        for corner in corners {
            let touch = sphere_cylinder(0.0, corner, cylinder);
            self.consider(solids, -touch.normal, Some(Cores { points: [touch.points[1], *corner], radii: [0.0; 2] }));
        }
        self
    }

    /// Takes the direction of a vector if the bodies are farther apart along it.
    pub fn consider(&mut self, solids: &[Solid; 2], direction: Vector3<f64>, cores: Option<Cores>) {
        let length = direction.norm();
        if length == 0.0 {
            return;
        }
        let apart = solids[0].pose().centre - solids[1].pose().centre;
        let along = direction.dot(&apart) / length;
        let normal = direction * (if along < 0.0 { -1.0 } else { 1.0 } / length);
        let gap = along.abs() - solids[0].half_width(&normal) - solids[1].half_width(&normal);
        if gap > self.gap {
            *self = Widest { normal, gap, cores };
        }
    }
}
