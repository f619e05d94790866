//! The scenes: boxes thrown with an orientation and a spin that a seed decides.
//!
//! ```text
//!     orientation   uniform on the unit quaternions     spin   each component uniform in ±8 rad/s
//!     velocity      each component uniform in ±1 m/s, of two boxes in ±¼ m/s, so that one falls on the other
//! ```
//! A seed stands for one throw, the same on every machine.

use crate::checks::scenery::{cuboid, over_floor};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector4;

/// μ of every scene with friction.
pub(super) const FRICTION: f64 = 0.6;

/// Masses \[kg\] of a light box and of the heavy one that falls on it.
const LIGHT: f64 = 1.0;
const HEAVY: f64 = 50.0;

/// Which bodies are thrown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Thrown {
    /// One cube, which has no gyroscopic torque.
    Cube,
    /// One box with three different edges.
    Box,
    /// Two boxes of equal mass, one above the other.
    Pair,
    /// A light box, and a heavy one above it.
    Heavy,
}

/// One throw.
#[derive(Clone, Copy, Debug)]
pub(super) struct Throw {
    /// Which bodies.
    pub thrown: Thrown,
    /// What decides orientations and velocities.
    pub seed: u64,
    /// e of every pair.
    pub restitution: f64,
}

impl Throw {
    /// What is thrown, in words; the same at every time step.
    pub fn words(&self) -> String {
        let bodies = match self.thrown {
            Thrown::Cube => "a cube",
            Thrown::Box => "a box",
            Thrown::Pair => "two boxes",
            Thrown::Heavy => "a heavy box on a light one",
        };
        format!("{bodies}, throw {}", self.seed)
    }

    /// The scene with a friction coefficient.
    pub fn scene(&self, friction: f64) -> Scene {
        let mut numbers = Numbers(self.seed);
        let bodies = match self.thrown {
            Thrown::Cube => vec![numbers.thrown(cuboid("box", LIGHT, [0.1; 3], [0.0, 0.0, 0.3]), 1.0)],
            Thrown::Box => vec![numbers.thrown(cuboid("box", LIGHT, [0.108, 0.056, 0.098], [0.0, 0.0, 0.3]), 1.0)],
            Thrown::Pair | Thrown::Heavy => {
                let above = if self.thrown == Thrown::Pair { LIGHT } else { HEAVY };
                let [low, high] = [[0.1, 0.08, 0.09], [0.1, 0.11, 0.09]];
                vec![
                    numbers.thrown(cuboid("box", LIGHT, low, [0.0, 0.0, 0.2]), 0.25),
                    numbers.thrown(cuboid("upper", above, high, [0.02, 0.01, 0.6]), 0.25),
                ]
            }
        };
        let mut scene = over_floor("tumbling", bodies, friction);
        scene.material.restitution = self.restitution;
        scene
    }
}

/// Uniform numbers in \[−1, 1) from a seed (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    }

    /// A point of the unit sphere in four dimensions: of the cube's points, the first inside the ball and not near its centre.
    fn orientation(&mut self) -> [f64; 4] {
        loop {
            let point = Vector4::from_fn(|_, _| self.next());
            if (0.25..=1.0).contains(&point.norm()) {
                return point.normalize().into();
            }
        }
    }

    /// The body, turned and moving with up to `speed` \[m/s\] along each axis; its place stays.
    fn thrown(&mut self, body: Body, speed: f64) -> Body {
        let orientation = self.orientation();
        let linear_velocity = std::array::from_fn(|_| speed * self.next());
        let angular_velocity = std::array::from_fn(|_| 8.0 * self.next());
        Body { orientation, linear_velocity, angular_velocity, ..body }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn a_seed_is_a_throw_and_every_throw_is_a_scene_above_the_floor() {
        for thrown in [Thrown::Cube, Thrown::Box, Thrown::Pair, Thrown::Heavy] {
            let mut before: Option<Scene> = None;
            for seed in 0..20 {
                let throw = Throw { thrown, seed, restitution: 0.5 };
                let scene = throw.scene(FRICTION);
                scene.validate().expect("a scene");
                assert_eq!(scene, throw.scene(FRICTION));
                assert!(before.as_ref() != Some(&scene));
                for body in &scene.bodies {
                    let half = body.cuboid.expect("a box").half_extents;
                    assert!(body.position[2] > half.iter().map(|a| a * a).sum::<f64>().sqrt());
                    assert!((Vector4::from(body.orientation).norm() - 1.0).abs() <= rounding(8, 1.0));
                }
                before = Some(scene);
            }
        }
    }

    #[test]
    fn boxes_start_apart() {
        let scene = Throw { thrown: Thrown::Heavy, seed: 0, restitution: 0.0 }.scene(0.0);
        let radius = |k: usize| scene.bodies[k].cuboid.map_or(0.0, |cuboid| cuboid.half_extents.iter().map(|a| a * a).sum::<f64>().sqrt());
        assert!(scene.bodies[1].position[2] - scene.bodies[0].position[2] > radius(0) + radius(1));
    }
}
