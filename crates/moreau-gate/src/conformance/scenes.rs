//! The scenes of the probes: one body each, a few steps.

use crate::tolerance::conformance::STEP;
use moreau_dynamics::scenes::{Body, Cuboid, Ground, Material, Prescribed, Scene};

/// How long a probe runs, in steps.
pub(super) const STEPS: usize = 12;
/// How long the ball lands and rests, in steps.
pub(super) const LANDING: usize = 8 * STEPS;
/// Steps from sample to sample in most probes.
pub(super) const EVERY: usize = 3;
/// g \[m/s²\].
pub(super) const GRAVITY: f64 = 9.81;
/// m \[kg\].
pub(super) const MASS: f64 = 2.0;

/// A ball that is thrown where there is no ground, with different numbers everywhere; gravity is not along an axis.
pub(super) fn thrown_ball() -> Scene {
    let mut ball = ball([0.5, -0.25, 3.0], [1.0, 2.0, -3.0]);
    ball.angular_velocity = [0.5, -1.0, 0.25];
    scene("thrown ball", [1.0, -2.0, -GRAVITY], None, ball, STEPS)
}

/// A brick that tumbles without gravity: its orientation is 2 acos(2/11) about (1, 4, 10), its spin about no axis of either frame.
pub(super) fn tumbling_brick() -> Scene {
    let mut brick = ball([0.0, 0.0, 1.0], [0.0; 3]);
    brick.sphere = None;
    brick.cuboid = Some(Cuboid { half_extents: [0.1, 0.2, 0.3] });
    brick.orientation = [2.0 / 11.0, 1.0 / 11.0, 4.0 / 11.0, 10.0 / 11.0];
    brick.angular_velocity = [4.0, -2.0, 1.0];
    scene("tumbling brick", [0.0; 3], None, brick, STEPS)
}

/// A ball that falls on the ground at 2 m/s within the first quarter of the probe and stays.
pub(super) fn landing_ball() -> Scene {
    let ball = ball([0.0, 0.0, 0.1 + 5.5 * 2.0 * STEP], [0.0, 0.0, -2.0]);
    scene("landing ball", [0.0, 0.0, -GRAVITY], Some(ground()), ball, LANDING)
}

/// A ball that arrives at the ground without gravity at 2 m/s: 1/16 of a step's way is left when the impact begins, so that an engine
/// that uses up the gap in the step of the impact loses 1/16 of the speed.
pub(super) fn bouncing_ball(restitution: f64) -> Scene {
    let ball = ball([0.0, 0.0, 0.1 + (5.0 + 1.0 / 16.0) * 2.0 * STEP], [0.0, 0.0, -2.0]);
    let mut scene = scene("bouncing ball", [0.0; 3], Some(ground()), ball, STEPS);
    scene.material.restitution = restitution;
    scene
}

/// The ball falls on a slab that nothing moves but, if it is given one, its velocity; the slab also turns then.
pub(super) fn ball_on_slab(velocity: Option<[f64; 3]>) -> Scene {
    let mut scene = landing_ball();
    scene.ground = None;
    let slab = Body::cuboid("slab", MASS, [1.0, 1.0, 0.1], [0.0, 0.0, -0.1]);
    scene.bodies.push(match velocity {
        None => slab.fixed(),
        Some(velocity) => Body { prescribed: Some(Prescribed { velocity, angular_velocity: [0.0, 0.0, 1.0] }), ..slab.driven(velocity) },
    });
    scene
}

fn ground() -> Ground {
    Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 }
}

fn ball(position: [f64; 3], linear_velocity: [f64; 3]) -> Body {
    Body { linear_velocity, ..Body::sphere("probe", MASS, 0.1, position) }
}

fn scene(name: &str, gravity: [f64; 3], ground: Option<Ground>, body: Body, steps: usize) -> Scene {
    Scene {
        schema: moreau_dynamics::scenes::SCHEMA.into(),
        name: name.into(),
        description: String::new(),
        gravity,
        ground,
        bodies: vec![body],
        material: Material { friction: 0.0, restitution: 0.0, pairs: Vec::new() },
        duration: steps as f64 * STEP,
        engines: Default::default(),
    }
}
