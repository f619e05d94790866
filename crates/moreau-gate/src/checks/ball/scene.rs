//! The ball that is dropped.

use crate::checks::scenery::{over_floor, sphere};
use moreau_dynamics::scenes::Scene;

/// Radius of the ball \[m\].
pub(super) const RADIUS: f64 = 0.1;

/// A 1 kg ball at rest, `height` \[m\] above the floor.
pub(super) fn dropped(height: f64, restitution: f64) -> Scene {
    let mut scene = over_floor("dropped ball", vec![sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + height])], 0.0);
    scene.material.restitution = restitution;
    scene
}
