//! One place where bodies in space touch.

use nalgebra::Vector3;
use parry3d_f64::query::ContactManifold;

/// Touches that are being found, and memory of the collision library that is used again.
pub(in crate::mechanics) struct Touches {
    pub list: Vec<Touch>,
    pub manifold: ContactManifold<(), ()>,
}

impl Default for Touches {
    fn default() -> Self {
        Touches { list: Vec::new(), manifold: ContactManifold::new() }
    }
}

/// One contact candidate between a first body and a second one (or the ground).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::mechanics) struct Touch {
    /// φ \[m\].
    pub gap: f64,
    /// Unit normal, pointing to the first body.
    pub normal: Vector3<f64>,
    /// The points of the first and of the second body that touch, in the world.
    pub points: [Vector3<f64>; 2],
    /// The points of the first and of the second body whose velocities its rows are: `points`, but between parallel faces one point for
    /// both.
    pub seen: [Vector3<f64>; 2],
    /// Numbers of the features of the first and of the second body.
    pub features: [u32; 2],
}

impl Touch {
    /// A candidate whose rows are taken at the points that touch.
    pub fn new(gap: f64, normal: Vector3<f64>, points: [Vector3<f64>; 2], features: [u32; 2]) -> Self {
        Touch { gap, normal, points, seen: points, features }
    }

    /// The same candidate with first and second body exchanged.
    pub fn swapped(self) -> Self {
        let exchanged = |[first, second]: [Vector3<f64>; 2]| [second, first];
        let [own, other] = self.features;
        Touch { normal: -self.normal, points: exchanged(self.points), seen: exchanged(self.seen), features: [other, own], ..self }
    }
}

/// Distance and unit vector from a to b; +z where they coincide and every direction would do.
pub(super) fn direction(a: Vector3<f64>, b: Vector3<f64>) -> (f64, Vector3<f64>) {
    let difference = b - a;
    let distance = difference.norm();
    if distance > 0.0 { (distance, difference / distance) } else { (0.0, Vector3::z()) }
}
