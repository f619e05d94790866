//! Transformations that leave the laws of rigid bodies in contact alone, on scenes and on trajectories.
//!
//! ```text
//!     x ↦ Q x + d + V t ,   v ↦ Q v + V ,   ω ↦ det(Q) Q ω ,   R ↦ Q R B ,   B = I, or diag(1, −1, 1) if det Q = −1 .
//! ```
//! Boxes and spheres are their own mirror images under B, so that R stays a rotation; ω is an axial vector. Gravity and the ground's
//! normal turn along, the ground's offset moves by d. A boost V needs a scene without ground.

use moreau_dynamics::scenes::{Ground, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

/// x ↦ Q x + d + V t with an orthogonal Q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Q.
    pub linear: Matrix3<f64>,
    /// d \[m\].
    pub offset: Vector3<f64>,
    /// V \[m/s\].
    pub boost: Vector3<f64>,
}

impl Transform {
    fn identity() -> Self {
        Transform { linear: Matrix3::identity(), offset: Vector3::zeros(), boost: Vector3::zeros() }
    }

    /// A rotation by an angle \[rad\] about an axis through the origin.
    pub fn rotation(axis: [f64; 3], angle: f64) -> Self {
        let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle);
        Transform { linear: rotation.into_inner(), ..Self::identity() }
    }

    /// The mirror image y ↦ −y.
    pub fn mirror() -> Self {
        Transform { linear: Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0)), ..Self::identity() }
    }

    /// A displacement by d \[m\].
    pub fn translation(offset: [f64; 3]) -> Self {
        Transform { offset: Vector3::from(offset), ..Self::identity() }
    }

    /// A frame that moves with −V \[m/s\].
    pub fn boost(velocity: [f64; 3]) -> Self {
        Transform { boost: Vector3::from(velocity), ..Self::identity() }
    }

    /// The transformed scene.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut image = scene.clone();
        image.gravity = (self.linear * Vector3::from(scene.gravity)).into();
        image.ground = scene.ground.map(|Ground { normal, offset }| {
            let normal = (self.linear * Vector3::from(normal)).normalize();
            Ground { normal: normal.into(), offset: offset + normal.dot(&self.offset) }
        });
        for body in &mut image.bodies {
            body.position = (self.linear * Vector3::from(body.position) + self.offset).into();
            body.orientation = self.orientation(body.orientation);
            body.linear_velocity = (self.linear * Vector3::from(body.linear_velocity) + self.boost).into();
            body.angular_velocity = self.axial(body.angular_velocity);
            if let Some(prescribed) = &mut body.prescribed {
                prescribed.velocity = (self.linear * Vector3::from(prescribed.velocity) + self.boost).into();
                prescribed.angular_velocity = self.axial(prescribed.angular_velocity);
            }
        }
        image
    }

    /// The trajectory that this transformation takes to the given one.
    pub fn undo(&self, image: &Trajectory) -> Trajectory {
        let inverse = Transform { linear: self.linear.transpose(), ..Self::identity() };
        let mut original = image.clone();
        for track in &mut original.bodies {
            for (position, time) in track.position.iter_mut().zip(&image.times) {
                *position = (inverse.linear * (Vector3::from(*position) - self.offset - self.boost * *time)).into();
            }
            track.orientation.iter_mut().for_each(|q| *q = inverse.orientation(*q));
            track.linear_velocity.iter_mut().for_each(|v| *v = (inverse.linear * (Vector3::from(*v) - self.boost)).into());
            track.angular_velocity.iter_mut().for_each(|w| *w = inverse.axial(*w));
        }
        original
    }

    fn axial(&self, vector: [f64; 3]) -> [f64; 3] {
        (self.linear * Vector3::from(vector) * self.linear.determinant().signum()).into()
    }

    fn orientation(&self, [w, x, y, z]: [f64; 4]) -> [f64; 4] {
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        let own = Matrix3::from_diagonal(&Vector3::new(1.0, self.linear.determinant().signum(), 1.0));
        let image = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(self.linear * rotation.matrix() * own));
        [image.w, image.i, image.j, image.k]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::metamorphic::scenes;
    use crate::checks::scenery::{angle_between, distance};
    use moreau_dynamics::trajectory::{BodyTrack, Producer};
    use moreau_exact::tolerance::rounding;

    /// A trajectory of one sample: the start of the scene, at the given time.
    fn start(scene: &Scene, time: f64) -> Trajectory {
        let bodies = scene.bodies.iter().map(|body| BodyTrack {
            name: body.name.clone(),
            position: vec![body.position],
            orientation: vec![body.orientation],
            linear_velocity: vec![body.linear_velocity],
            angular_velocity: vec![body.angular_velocity],
        });
        Trajectory {
            schema: moreau_dynamics::trajectory::SCHEMA.into(),
            scene: scene.clone(),
            engine: Producer::ours("none", "none"),
            time_step: 1.0,
            times: vec![time],
            bodies: bodies.collect(),
            contacts: Vec::new(),
            steps: None,
            provenance: None,
        }
    }

    #[test]
    fn undoing_a_transformation_gives_the_original_back() {
        let scene = scenes::slide();
        let all = [
            Transform::rotation([1.0, 2.0, -1.0], 0.7),
            Transform::mirror(),
            Transform::translation([600.0, -800.0, 3.0]),
            Transform::boost([3.0, -2.0, 1.0]),
        ];
        for transform in all {
            let image = transform.scene(&scene);
            image.validate().expect("unit vectors stay unit vectors");
            let back = transform.undo(&start(&image, 0.0));
            for (body, track) in scene.bodies.iter().zip(&back.bodies) {
                assert!(distance(body.position, track.position[0]) <= rounding(16, 1000.0));
                assert!(distance(body.linear_velocity, track.linear_velocity[0]) <= rounding(16, 8.0));
                assert!(distance(body.angular_velocity, track.angular_velocity[0]) <= rounding(16, 8.0));
                assert!(angle_between(body.orientation, track.orientation[0]) <= rounding(64, 1.0));
            }
        }
    }

    #[test]
    fn a_mirror_turns_rotations_round_and_keeps_shapes() {
        let mut scene = scenes::slide();
        scene.bodies[0].angular_velocity = [1.0, 2.0, 3.0];
        // A box turned by a about z becomes one turned by −a.
        scene.bodies[1].orientation = [0.2f64.cos(), 0.0, 0.0, 0.2f64.sin()];
        let image = Transform::mirror().scene(&scene);
        assert_eq!(image.bodies[0].angular_velocity, [-1.0, 2.0, -3.0]);
        assert!(angle_between(image.bodies[1].orientation, [0.2f64.cos(), 0.0, 0.0, -0.2f64.sin()]) <= rounding(32, 1.0));
        assert_eq!(image.gravity, scene.gravity);
    }

    #[test]
    fn the_ground_moves_along() {
        let scene = Transform::translation([1.0, 2.0, 3.0]).scene(&scenes::slide());
        assert_eq!(scene.ground.expect("a ground").offset, 3.0);
        let tilted = Transform::rotation([1.0, 0.0, 0.0], std::f64::consts::FRAC_PI_2).scene(&scenes::slide());
        let normal = tilted.ground.expect("a ground").normal;
        assert!(distance(normal, [0.0, -1.0, 0.0]) <= rounding(8, 1.0));
    }

    #[test]
    fn a_boost_is_undone_at_the_time_of_the_sample() {
        let transform = Transform::boost([3.0, 0.0, 0.0]);
        let back = transform.undo(&start(&scenes::collision(), 2.0));
        let expected = scenes::collision().bodies[0].position[0] - 6.0;
        assert!((back.bodies[0].position[0][0] - expected).abs() <= rounding(4, 8.0));
    }
}
