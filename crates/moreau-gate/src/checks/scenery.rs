//! Small pieces that the scenes of several families are built from.

use crate::Expectation;
use moreau_dynamics::scenes::{Body, Ground, Material, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
pub(super) use moreau_exact::number::larger as worst;

/// Standard gravity of the scenes \[m/s²\].
pub(super) const GRAVITY: f64 = 9.81;

/// Bodies over the floor z = 0 under gravity, with one friction coefficient and no restitution.
pub(super) fn over_floor(name: &str, bodies: Vec<Body>, friction: f64) -> Scene {
    Scene {
        schema: moreau_dynamics::scenes::SCHEMA.into(),
        name: name.into(),
        description: String::new(),
        gravity: [0.0, 0.0, -GRAVITY],
        ground: Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 }),
        bodies,
        material: Material { friction, restitution: 0.0, pairs: Vec::new() },
        duration: 1.0,
        engines: std::collections::BTreeMap::new(),
    }
}

/// The same scene with a static box in place of its floor: the box's upper face is the plane z = 0, its middle is not below the bodies.
pub(super) fn over_static_box(mut scene: Scene) -> Scene {
    scene.ground = None;
    scene.bodies.push(cuboid("floor", 1.0, [12.0, 10.0, 1.0], [1.0, -2.0, -1.0]).fixed());
    scene
}

/// A solid sphere at rest.
pub(super) fn sphere(name: &str, mass: f64, radius: f64, position: [f64; 3]) -> Body {
    Body::sphere(name, mass, radius, position)
}

/// A solid box at rest, its edges along the axes.
pub(super) fn cuboid(name: &str, mass: f64, half_extents: [f64; 3], position: [f64; 3]) -> Body {
    Body::cuboid(name, mass, half_extents, position)
}

/// (steps, sample_every) of a motion of about `duration` \[s\] with about `samples` samples, at least one step each.
pub(super) fn schedule(duration: f64, samples: usize, h: f64) -> (usize, usize) {
    let every = (duration / (h * samples as f64)).round().max(1.0);
    let samples = (duration / (h * every)).round().max(1.0);
    ((samples * every) as usize, every as usize)
}

/// What lies between the least and the greatest of these values, or within `allowed` of them.
pub(super) fn between(values: impl IntoIterator<Item = f64>, allowed: f64, why: &str) -> Expectation {
    let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    Expectation::equal(0.5 * (low + high), 0.5 * (high - low) + allowed, why)
}

/// The bodies' tracks in the order of their names in the first trajectory; a body that is missing has been refused by the bench.
pub(super) fn paired<'a>(one: &'a Trajectory, other: &'a Trajectory) -> impl Iterator<Item = (&'a BodyTrack, &'a BodyTrack)> {
    one.bodies.iter().filter_map(|track| Some((track, other.body(&track.name)?)))
}

/// ‖a − b‖.
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).fold(0.0, |length: f64, k| length.hypot(a[k] - b[k]))
}

/// Angle \[rad\] of the rotation from one unit quaternion to another, from the chord ‖p ∓ q‖ = 2 sin(angle/4): exact for small angles.
pub(super) fn angle_between(p: [f64; 4], q: [f64; 4]) -> f64 {
    let chord = |sign: f64| (0..4).fold(0.0, |length: f64, k| length.hypot(p[k] - sign * q[k]));
    4.0 * (0.5 * chord(1.0).min(chord(-1.0))).min(1.0).asin()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn a_schedule_has_whole_samples_and_about_the_duration() {
        for h in [1.0 / 60.0, 3e-3, 1e-4] {
            let (steps, every) = schedule(0.2, 40, h);
            assert_eq!(steps % every, 0);
            assert!((steps as f64 * h - 0.2).abs() <= 0.5 * h * every as f64 + rounding(4, 1.0));
        }
        assert_eq!(schedule(0.0, 10, 1.0), (1, 1));
    }

    #[test]
    fn the_angle_between_orientations_ignores_the_sign_of_a_quaternion() {
        let turned = |angle: f64| [(angle / 2.0).cos(), 0.0, (angle / 2.0).sin(), 0.0];
        for angle in [0.0, 1e-9, 0.5, 3.0] {
            let q = turned(angle);
            assert!((angle_between(turned(0.0), q) - angle).abs() <= rounding(16, 1.0 + angle));
            assert!((angle_between(turned(0.0), q.map(|x| -x)) - angle).abs() <= rounding(16, 1.0 + angle));
        }
    }

    #[test]
    fn what_is_between_is_expected_and_what_is_beside_is_not() {
        let expected = between([3.0, 1.0, 2.0], 0.25, "");
        assert!([0.75, 1.5, 3.25].iter().all(|x| expected.holds(*x)) && [0.5, 3.5].iter().all(|x| !expected.holds(*x)));
        assert!(!between([], 1.0, "").holds(0.0));
    }

    #[test]
    fn worst_does_not_lose_nan() {
        assert!(worst(f64::NAN, 1.0).is_nan() && worst(1.0, f64::NAN).is_nan());
    }
}
