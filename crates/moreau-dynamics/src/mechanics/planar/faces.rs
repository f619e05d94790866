//! Two faces that look at each other share one normal and one line of contact if they are parallel.
//!
//! ```text
//!     c = ‖a + b‖ = 2 sin(θ/2)          a, b outward normals of the two faces
//!     w = 2 − c/θ₀, between 0 and 1     1 for parallel faces (θ ≤ θ₀), 0 for faces that are not (θ ≥ 2θ₀)
//!     n = (b − a)/‖b − a‖               the bisector, pointing to the body of the first face
//! ```
//! The same in the plane as in space: a contact with a normal m of its own gets the one along m + w (n − m), its gap is measured along
//! that, and its rows see both bodies at a point that moves by w from the two that touch to the one halfway. Points halfway lie on one line
//! normal to n, so their relative velocities have three degrees of freedom, of which two are normal and one is tangential.

use super::touch::{Touch, along};
use crate::tolerance::mechanics::faces_are_parallel;

/// The shared normal of two faces, and how far they are parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Faces {
    /// n, pointing to the body of the first face.
    pub normal: [f64; 2],
    /// w, above 0 and at most 1.
    pub weight: f64,
}

impl Faces {
    /// Two faces with these outward normals; `None` if they are not parallel at all.
    pub fn new(first: [f64; 2], second: [f64; 2]) -> Option<Self> {
        let weight = faces_are_parallel((first[0] + second[0]).hypot(first[1] + second[1]));
        (weight > 0.0).then(|| Faces { normal: unit(along(second, -1.0, first)), weight })
    }

    /// The normal of a contact whose own is `own`.
    pub fn turn(&self, own: [f64; 2]) -> [f64; 2] {
        if self.weight < 1.0 { unit(along(own, self.weight, along(self.normal, -1.0, own))) } else { self.normal }
    }

    /// Lets the rows of a contact see both bodies at one point.
    pub fn join(&self, touch: Touch) -> Touch {
        let [first, second] = touch.points;
        let halfway = [0, 1].map(|axis| 0.5 * (first[axis] + second[axis]));
        let moved = |point: [f64; 2]| along(point, self.weight, along(halfway, -1.0, point));
        Touch { points: if self.weight < 1.0 { [moved(first), moved(second)] } else { [halfway; 2] }, ..touch }
    }
}

/// Lets the rows of the two corners of a face see them at the same height over the ground, halfway between the two.
pub(super) fn level(corners: [Touch; 2], outward: [f64; 2], ground: [f64; 2]) -> [Touch; 2] {
    let weight = faces_are_parallel((outward[0] + ground[0]).hypot(outward[1] + ground[1]));
    let height = 0.5 * (corners[0].gap + corners[1].gap);
    corners.map(|touch| {
        let rise = weight * (height - touch.gap);
        Touch { points: touch.points.map(|point| along(point, rise, ground)), ..touch }
    })
}

fn unit([x, z]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(z);
    [x / length, z / length]
}
