//! A box on an inclined plane and a sphere on one, both with their lowest points on it.

use crate::checks::motion::{CLEARANCE, Slope, start_gap};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, sphere};
use crate::model::creep::HeldBox;
use crate::{Bench, Refusal, Reply};
use moreau_dynamics::scenes::{Ground, Scene};

/// Inclination α \[rad\], 20°.
pub(in crate::checks) fn angle() -> f64 {
    20f64.to_radians()
}

/// A 1 kg box `gap` \[m\] above the plane that falls off in the direction x.
pub(in crate::checks) fn slope_box(name: &str, half_extents: [f64; 3], gap: f64, friction: f64) -> Scene {
    let (sine, cosine) = angle().sin_cos();
    let height = half_extents[2] + gap;
    let mut block = cuboid("block", 1.0, half_extents, [height * sine, 0.0, height * cosine]);
    let (half_sine, half_cosine) = (0.5 * angle()).sin_cos();
    block.orientation = [half_cosine, 0.0, half_sine, 0.0];
    inclined(over_floor(name, vec![block], friction), angle())
}

/// A 1 kg sphere of radius [`RADIUS`], [`CLEARANCE`] above the plane.
pub(super) fn slope_sphere(name: &str, angle: f64, friction: f64) -> Scene {
    let (sine, cosine) = angle.sin_cos();
    let height = RADIUS + CLEARANCE;
    let ball = sphere("ball", 1.0, RADIUS, [height * sine, 0.0, height * cosine]);
    inclined(over_floor(name, vec![ball], friction), angle)
}

/// Radius of the sphere \[m\].
pub(super) const RADIUS: f64 = 0.1;

pub(in crate::checks) fn inclined(mut scene: Scene, angle: f64) -> Scene {
    let (sine, cosine) = angle.sin_cos();
    scene.ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.0 });
    scene
}

/// The plane of a scene of this family.
pub(in crate::checks) fn slope(scene: &Scene) -> Reply<Slope> {
    Slope::of(scene).ok_or_else(|| Refusal::errored("the scene has no plane"))
}

/// The box of a scene as its contacts hold it.
pub(in crate::checks) fn held(scene: &Scene, slope: &Slope, time_step: f64) -> HeldBox {
    let block = &scene.bodies[0];
    HeldBox {
        time_step,
        mass: block.mass,
        half_extents: block.cuboid.map_or([0.0; 3], |cuboid| cuboid.half_extents),
        axes: [slope.down, slope.side, slope.normal],
        friction: scene.material.friction,
        pull: slope.pull,
        press: slope.press,
    }
}

/// Where the box starts: see [`start_gap`].
pub(super) fn box_gap(bench: &Bench, h: f64, friction: f64, slip: f64) -> f64 {
    start_gap(bench, h, (1.0, 4.0), GRAVITY * angle().cos(), friction, slip)
}
