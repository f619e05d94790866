//! The ball of this family: on a slope of 20°, with one contact.

use crate::Bench;
use crate::checks::motion::start_gap;
use crate::checks::scenery::{GRAVITY, over_floor, sphere};
use moreau_dynamics::scenes::{Ground, Scene};

/// Distance of μ from the limit, relative: below the difference of static and kinetic friction that engines have had.
pub(super) const MARGIN: f64 = 1.0 / 50.0;
/// Mass of the ball \[kg\].
pub(super) const MASS: f64 = 1.0;
/// Radius of the ball \[m\]: large against the depth at which a step may leave it.
pub(super) const RADIUS: f64 = 1.0;

/// A ball on a slope of 20°, as deep as it lies.
pub(super) fn ball_on_slope(bench: &Bench, h: f64, name: &str, friction: f64) -> Scene {
    let (sine, cosine) = 20f64.to_radians().sin_cos();
    let height = RADIUS + start_gap(bench, h, (MASS, 1.0), GRAVITY * cosine, friction, 0.0);
    let ball = sphere("ball", MASS, RADIUS, [height * sine, 0.0, height * cosine]);
    let ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.0 });
    Scene { ground, ..over_floor(name, vec![ball], friction) }
}
