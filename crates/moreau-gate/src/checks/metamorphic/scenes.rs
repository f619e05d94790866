//! The scenes that are transformed. No contact begins touching, so that no rounding decides whether it acts, and none is chaotic: errors of
//! a step are handed on without growth.

use crate::checks::scenery::{cuboid, over_floor, sphere};
use moreau_dynamics::scenes::Scene;

/// Simulated time \[s\] of every scene here.
pub const DURATION: f64 = 0.2;

/// Friction coefficient of every scene here.
pub const FRICTION: f64 = 0.3;

/// A bound on the speeds \[m/s\] of the centres and, over the radius or half the edge, of the surfaces: √(0.7² + 0.4² + 0.31²) + 0.1·√14 <
/// 1.3.
pub const SPEED: f64 = 1.3;

/// The smallest distance \[m\] that turns a velocity at a contact into an angular velocity: the radius of gyration 0.1·√0.4 over its ratio
/// to the radius, I/(m r) = 0.04 m for the sphere; the smallest half edge, 0.05 m, for boxes.
pub const ARM: f64 = 0.04;

/// A sphere that lands sliding and spinning and begins to roll, and, far from it, a box that lands flat and slides without stopping.
///
/// The corners of the box slide in one direction, and the reaction's centre lies on that line, so that it does not turn whatever the
/// distribution of the load; the sphere's single contact leaves nothing to choose.
pub fn slide() -> Scene {
    let mut ball = sphere("ball", 2.0, 0.1, [-0.5, 0.3, 0.1053]);
    ball.linear_velocity = [0.7, -0.4, -0.31];
    ball.angular_velocity = [2.0, -1.0, 3.0];
    let mut block = cuboid("block", 1.5, [0.1, 0.15, 0.05], [0.6, -0.2, 0.0537]);
    block.orientation = [0.2f64.cos(), 0.0, 0.0, 0.2f64.sin()];
    block.linear_velocity = [-0.5, 0.6, -0.23];
    over_floor("slide", vec![ball, block], FRICTION)
}

/// Three boxes, a few millimetres apart, fall on the floor and on each other.
pub fn pile() -> Scene {
    let bodies = vec![
        cuboid("lower", 1.0, [0.12, 0.12, 0.05], [0.0, 0.0, 0.0531]),
        cuboid("middle", 1.5, [0.1, 0.1, 0.05], [0.01, 0.0, 0.1554]),
        cuboid("upper", 0.5, [0.08, 0.08, 0.05], [0.0, 0.01, 0.2571]),
    ];
    over_floor("pile", bodies, FRICTION)
}

/// Without gravity and ground: two spheres meet off centre, with spin.
pub fn collision() -> Scene {
    let mut swift = sphere("swift", 1.0, 0.1, [-0.13, 0.05, 0.02]);
    swift.linear_velocity = [1.0, 0.2, 0.0];
    swift.angular_velocity = [0.0, 3.0, 1.0];
    let slow = sphere("slow", 2.0, 0.1, [0.1, 0.0, 0.0]);
    Scene { gravity: [0.0; 3], ground: None, ..over_floor("collision", vec![swift, slow], FRICTION) }
}
