//! One place where planar bodies touch, and the vectors it is made of.

use moreau_contact::contact::frame::planar_tangent;

/// One contact candidate between a first body and a second one (or the ground).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// φ \[m\].
    pub gap: f64,
    /// Unit normal, pointing to the first body.
    pub normal: [f64; 2],
    /// The points of the first and of the second body that touch, in the world; between parallel faces one point for both.
    pub points: [[f64; 2]; 2],
}

impl Touch {
    pub fn tangent(&self) -> [f64; 2] {
        planar_tangent(self.normal)
    }

    /// The same candidate with first and second body exchanged.
    pub fn swapped(self) -> Self {
        let [first, second] = self.points;
        Touch { normal: [-self.normal[0], -self.normal[1]], points: [second, first], ..self }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// a + s b.
pub(super) fn along(a: [f64; 2], s: f64, b: [f64; 2]) -> [f64; 2] {
    [a[0] + s * b[0], a[1] + s * b[1]]
}

/// Distance and unit vector from a to b; +z where they coincide and every direction would do.
pub(super) fn direction(a: [f64; 2], b: [f64; 2]) -> (f64, [f64; 2]) {
    let [x, z] = [b[0] - a[0], b[1] - a[1]];
    let distance = x.hypot(z);
    if distance > 0.0 { (distance, [x / distance, z / distance]) } else { (0.0, [0.0, 1.0]) }
}
