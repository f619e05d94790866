//! The same scene as seen from elsewhere: turned as a whole, and with its bodies listed in the other order.
//!
//! ```text
//!     x ↦ R x ,   q ↦ R q ,   v ↦ R v ,   ω ↦ R ω
//! ```
//! No law of mechanics tells the two apart. A geometry of boxes that are not turned, or of the first body's shape, does.

use crate::checks::motion::Sample;
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// How a scene is put to an engine.
#[derive(Clone, Copy, Debug)]
pub(in crate::checks) struct View {
    /// R.
    pub turn: UnitQuaternion<f64>,
    /// Whether the bodies are listed in the other order.
    pub reversed: bool,
}

impl View {
    /// The scene as it is.
    pub fn plain() -> Self {
        View { turn: UnitQuaternion::identity(), reversed: false }
    }

    /// Turned about no axis of the world, by about 0.7 rad, so that no normal or edge is along one.
    pub fn turned(reversed: bool) -> Self {
        View { turn: UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, -0.4)), reversed }
    }

    /// The bodies seen like this; gravity and ground are left as they are.
    pub fn of(&self, scene: &Scene) -> Scene {
        let mut seen = scene.clone();
        seen.bodies.iter_mut().for_each(|body| self.turn_body(body));
        if self.reversed {
            seen.bodies.reverse();
        }
        seen
    }

    /// The scene with its gravity and its prescribed velocities, too: the same motion, seen from elsewhere. A ground is left as it is.
    pub fn of_all(&self, scene: &Scene) -> Scene {
        let mut seen = self.of(scene);
        seen.gravity = (self.turn * Vector3::from(scene.gravity)).into();
        for prescribed in seen.bodies.iter_mut().filter_map(|body| body.prescribed.as_mut()) {
            for vector in [&mut prescribed.velocity, &mut prescribed.angular_velocity] {
                *vector = (self.turn * Vector3::from(*vector)).into();
            }
        }
        seen
    }

    /// What a body of that motion does in the scene as it is.
    pub fn back(&self, seen: &Sample) -> Sample {
        let back = self.turn.inverse();
        Sample { position: back * seen.position, rotation: back * seen.rotation, velocity: back * seen.velocity, spin: back * seen.spin }
    }

    fn turn_body(&self, body: &mut Body) {
        for vector in [&mut body.position, &mut body.linear_velocity, &mut body.angular_velocity] {
            *vector = (self.turn * Vector3::from(*vector)).into();
        }
        let turned = self.turn * oriented(body);
        body.orientation = [turned.w, turned.i, turned.j, turned.k];
    }

    /// Places of the scene's first two bodies in the list.
    pub fn pair(&self) -> [usize; 2] {
        if self.reversed { [1, 0] } else { [0, 1] }
    }
}

/// The orientation of a body.
pub(in crate::checks) fn oriented(body: &Body) -> UnitQuaternion<f64> {
    let [w, x, y, z] = body.orientation;
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}
