//! Two faces that look at each other share one normal and one plane of contact if they are parallel.
//!
//! ```text
//!     c = ‖a + b‖ = 2 sin(θ/2)          a, b outward normals of the face of the first and of the second body
//!     w = 2 − c/θ₀, between 0 and 1     1 for parallel faces (θ ≤ θ₀), 0 for faces that are not (θ ≥ 2θ₀)
//!     n = (b − a)/‖b − a‖               the bisector, pointing to the first body
//! ```
//! A contact of the two faces with a normal m of its own gets the normal along m + w (n − m), its gap is measured along that, and
//! its rows see both bodies at a point that moves by w from the two that touch to the one halfway. So all changes continuously with θ.
//!
//! For w = 1 the rows are dependent to rounding. Points halfway between two planes along their bisector lie in one plane normal to n.
//! Both bodies are looked at at the same points x_k, so the relative velocities a + ω × x_k have six degrees of freedom. In this plane a
//! turn about a tangent moves points along n alone: the normal velocities depend on three of the six, the tangential ones on the other
//! three. So no normal velocity that the points can have asks for a tangential one.
//!
//! The gap changes as dφ/dt = n·v + tan α τ·(v − φ dn/dt) with the relative velocity v of the two points, α the angle between n and m, and
//! τ the unit tangent towards m: differentiate m·(p − q − φ n) = 0. The rows have the first term, see
//! [`PARALLEL_FACES`](crate::tolerance::mechanics::PARALLEL_FACES) for the others.

use super::touch::Touch;
use crate::tolerance::mechanics::faces_are_parallel;
use nalgebra::Vector3;

/// The shared normal of two faces, and how far they are parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Faces {
    /// n, pointing to the first body.
    pub normal: Vector3<f64>,
    /// w, above 0 and at most 1.
    pub weight: f64,
}

impl Faces {
    /// Two faces with these outward normals; `None` if they are not parallel at all.
    pub fn new(first: &Vector3<f64>, second: &Vector3<f64>) -> Option<Self> {
        let weight = faces_are_parallel((first + second).norm());
        (weight > 0.0).then(|| Faces { normal: (second - first).normalize(), weight })
    }

    /// The normal of a contact whose own is `own`.
    pub fn turn(&self, own: Vector3<f64>) -> Vector3<f64> {
        if self.weight < 1.0 { (own + (self.normal - own) * self.weight).normalize() } else { self.normal }
    }

    /// Lets the rows of a contact see both bodies at one point.
    pub fn join(&self, touch: Touch) -> Touch {
        let halfway = (touch.points[0] + touch.points[1]) * 0.5;
        let seen = if self.weight < 1.0 { touch.points.map(|point| point + (halfway - point) * self.weight) } else { [halfway; 2] };
        Touch { seen, ..touch }
    }
}

/// Lets the rows of the corners of one face see them at the same height over the ground, halfway between the lowest and the highest.
///
/// The ground has one normal for all of them. Without this a turn that closes their gaps moves the higher ones sideways.
pub(super) fn level(touches: &mut [Touch], is_corner: impl Fn(&Touch) -> bool, outward: &Vector3<f64>, ground: &Vector3<f64>) {
    let weight = faces_are_parallel((outward + ground).norm());
    if weight == 0.0 {
        return;
    }
    let corners = touches.iter().filter(|touch| is_corner(touch));
    let (low, high) = corners.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), touch| (touch.gap.min(low), touch.gap.max(high)));
    let height = 0.5 * (low + high);
    for touch in touches.iter_mut().filter(|touch| is_corner(touch)) {
        let rise = ground * (weight * (height - touch.gap));
        touch.seen = touch.points.map(|point| point + rise);
    }
}
