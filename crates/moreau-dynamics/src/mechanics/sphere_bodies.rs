//! Rigid bodies that touch a plane and each other through spheres fixed to them, their angular velocities in world axes.
//!
//! ```text
//!     q = (x, w, i, j, k) per body       centre of mass and quaternion, body to world
//!     v = (ẋ, ω) per body                both in world axes
//!     M(q) = diag(m, m, m) ⊕ R J Rᵀ ,     F = (m g, −ω × R J Rᵀ ω)
//!     q⁺ = (x + h ẋ, (p + ½ h ω ∘ p)/‖·‖)
//!     φ_i = n·(x + R s_i) − c − ρ_i                        sphere i over the plane
//!     φ_i = signed distance of x + R s_i from a box − ρ_i    sphere i of one body and the faces of another
//! ```
//! Spheres meet planes and faces, never each other. The contact point lies halfway between sphere and plane or face, x + R s_i − (ρ_i +
//! φ_i/2) n. The same bodies as [`SpatialBodies`](super::SpatialBodies) in other coordinates: M is not diagonal when a body is tilted, the
//! rotation moves by one step of Euler's method, and both bodies are looked at halfway. These are the coordinates of Drake, whose contact
//! law depends on them: its regularisation reads the diagonal of M.

use super::point_mass::{Plane, positive};
use super::spatial::{Pose, Touch, six, sphere_box};
use super::{BodyState, Mechanism, State};
use moreau_contact::contact::frame::spatial_tangents;
use moreau_contact::contact::{Contact, Mass, Place, Rows};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, Vector3};

/// A rigid body with spheres, and the faces of a box for the spheres of others.
#[derive(Clone, Debug)]
pub struct SphereBody {
    /// The name in labels and files.
    pub name: String,
    /// m \[kg\].
    pub mass: f64,
    /// J, principal moments about the body axes \[kg·m²\].
    pub moments: [f64; 3],
    /// Centre in body axes and radius \[m\].
    pub spheres: Vec<([f64; 3], f64)>,
    /// Half extents \[m\] of the box that spheres of other bodies meet.
    pub faces: Option<[f64; 3]>,
}

/// Bodies with spheres over a plane, whose friction and restitution hold for every pair.
///
/// Contact candidates in fixed order: the spheres of each body with the ground, then the spheres of each body with the box of each other
/// body, the normal pointing to the sphere.
#[derive(Clone, Debug)]
pub struct SphereBodies {
    name: String,
    bodies: Vec<SphereBody>,
    gravity: Vector3<f64>,
    ground: Plane,
}

impl SphereBodies {
    /// Bodies under gravity \[m/s²\] over a plane.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no body, a mass, moment, radius or half extent is not positive, a body has no sphere, or the ground
    /// is not a plane in space.
    pub fn new(name: impl Into<String>, bodies: Vec<SphereBody>, gravity: [f64; 3], ground: Plane) -> Result<Self> {
        if bodies.is_empty() {
            return Err(Error::invalid("bodies", "is empty", "give at least one body"));
        }
        for body in &bodies {
            positive("mass", body.mass)?;
            body.moments.into_iter().try_for_each(|moment| positive("inertia", moment))?;
            body.spheres.iter().try_for_each(|(_, radius)| positive("radius", *radius))?;
            body.faces.into_iter().flatten().try_for_each(|extent| positive("half_extents", extent))?;
            if body.spheres.is_empty() {
                return Err(Error::invalid("spheres", "is empty", "give at least one sphere"));
            }
        }
        if ground.normal.len() != 3 {
            return Err(Error::invalid("normal", format!("has {}", counted(ground.normal.len(), "component")), "use (x, y, z)"));
        }
        Ok(SphereBodies { name: name.into(), bodies, gravity: gravity.into(), ground })
    }

    /// q and v of bodies in the order of the mechanism: centre \[m\], quaternion \[w, x, y, z\], velocity \[m/s\] and ω \[rad/s\] in world
    /// axes of each.
    pub fn state(bodies: impl IntoIterator<Item = ([f64; 3], [f64; 4], [f64; 3], [f64; 3])>) -> State {
        let (mut position, mut velocity) = (Vec::new(), Vec::new());
        for (place, orientation, linear, angular) in bodies {
            position.extend(place.into_iter().chain(orientation));
            velocity.extend(linear.into_iter().chain(angular));
        }
        State { time: 0.0, position: DVector::from_vec(position), velocity: DVector::from_vec(velocity) }
    }

    fn poses(&self, position: &DVector<f64>) -> Vec<Pose> {
        (0..self.bodies.len()).map(|body| Pose::of(body, position)).collect()
    }

    /// A sphere at its place in space.
    fn sphere(&self, poses: &[Pose], body: usize, sphere: usize) -> (Vector3<f64>, f64) {
        let (centre, radius) = self.bodies[body].spheres[sphere];
        (poses[body].world(centre.into()), radius)
    }

    fn contact(&self, poses: &[Pose], touch: &Touch, first: usize, second: Option<usize>) -> Contact {
        let [t1, t2] = spatial_tangents(touch.normal.into());
        let frame = [touch.normal.into(), t1, t2];
        let point = (touch.points[0] + touch.points[1]) * 0.5;
        let mut jacobian = Rows::zeros(3, 6 * self.bodies.len());
        for (body, sign) in [(Some(first), 1.0), (second, -1.0)].into_iter().filter_map(|(body, sign)| Some((body?, sign))) {
            let lever = point - poses[body].centre;
            jacobian = jacobian.with(6 * body, frame.map(|direction| six(sign, direction, lever.cross(&Vector3::from(direction)).into())));
        }
        let Plane { friction, restitution, .. } = self.ground;
        let place = Place { bodies: (first, second), features: touch.features, frame };
        Contact { gap: touch.gap, jacobian, friction, restitution, place: Some(place) }
    }

    /// The plane under a sphere.
    fn over_ground(&self, (centre, radius): (Vector3<f64>, f64), feature: usize) -> Touch {
        let normal = Vector3::new(self.ground.normal[0], self.ground.normal[1], self.ground.normal[2]);
        let gap = normal.dot(&centre) - self.ground.offset - radius;
        let lowest = centre - normal * radius;
        Touch::new(gap, normal, [lowest, lowest - normal * gap], [feature as u32, 0])
    }
}

/// R J Rᵀ.
fn inertia(body: &SphereBody, rotation: &Matrix3<f64>) -> Matrix3<f64> {
    rotation * Matrix3::from_diagonal(&body.moments.into()) * rotation.transpose()
}

fn quaternion(body: usize, position: &DVector<f64>) -> Quaternion<f64> {
    let part = position.rows(7 * body + 3, 4);
    Quaternion::new(part[0], part[1], part[2], part[3])
}

fn spin(body: usize, velocity: &DVector<f64>) -> Vector3<f64> {
    velocity.fixed_rows::<3>(6 * body + 3).into_owned()
}

impl Mechanism for SphereBodies {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        6 * self.bodies.len()
    }

    fn rows_per_contact(&self) -> usize {
        3
    }

    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        self.mass(position).to_dense()
    }

    fn mass(&self, position: &DVector<f64>) -> Mass {
        let block = |(body, pose): (&SphereBody, Pose)| {
            let inertia = inertia(body, &pose.rotation);
            // one triangle mirrored: the product of three matrices is symmetric up to rounding only
            let turning = DMatrix::from_fn(3, 3, |i, j| inertia[(i.min(j), i.max(j))]);
            [DMatrix::from_diagonal_element(3, 3, body.mass), turning]
        };
        Mass::Blocks(self.bodies.iter().zip(self.poses(position)).flat_map(block).collect())
    }

    fn is_free(&self) -> bool {
        true
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        let mut force = DVector::zeros(self.degrees_of_freedom());
        for (k, (body, pose)) in self.bodies.iter().zip(self.poses(position)).enumerate() {
            let spin = spin(k, velocity);
            force.fixed_rows_mut::<3>(6 * k).copy_from(&(self.gravity * body.mass));
            force.fixed_rows_mut::<3>(6 * k + 3).copy_from(&-spin.cross(&(inertia(body, &pose.rotation) * spin)));
        }
        force
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let poses = self.poses(position);
        let mut contacts = Vec::new();
        for first in 0..self.bodies.len() {
            for feature in 0..self.bodies[first].spheres.len() {
                contacts.push(self.contact(&poses, &self.over_ground(self.sphere(&poses, first, feature), feature), first, None));
            }
        }
        for first in 0..self.bodies.len() {
            for second in (0..self.bodies.len()).filter(|second| *second != first) {
                let Some(faces) = self.bodies[second].faces else { continue };
                for feature in 0..self.bodies[first].spheres.len() {
                    let (centre, radius) = self.sphere(&poses, first, feature);
                    let touch = Touch { features: [feature as u32, 0], ..sphere_box(radius, &centre, faces, &poses[second]) };
                    contacts.push(self.contact(&poses, &touch, first, Some(second)));
                }
            }
        }
        contacts
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        let height = |k: usize| self.gravity.dot(&position.fixed_rows::<3>(7 * k));
        self.bodies.iter().enumerate().map(|(k, body)| -body.mass * height(k)).sum()
    }

    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let mut next = position.clone();
        for k in 0..self.bodies.len() {
            let old = quaternion(k, position);
            let turned = (old + Quaternion::from_imag(spin(k, velocity)) * old * (0.5 * h)).normalize();
            next.rows_mut(7 * k, 3).axpy(h, &velocity.rows(6 * k, 3), 1.0);
            next.fixed_rows_mut::<4>(7 * k + 3).copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
        }
        next
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let state = |(k, body): (usize, &SphereBody)| BodyState {
            name: body.name.clone(),
            position: std::array::from_fn(|axis| position[7 * k + axis]),
            orientation: std::array::from_fn(|part| position[7 * k + 3 + part]),
            linear_velocity: std::array::from_fn(|axis| velocity[6 * k + axis]),
            angular_velocity: std::array::from_fn(|axis| velocity[6 * k + 3 + axis]),
        };
        self.bodies.iter().enumerate().map(state).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::SpatialBodies;
    use crate::mechanics::spatial::{Shape, SpatialBody};
    use moreau_exact::tolerance::rounding;
    use nalgebra::{UnitQuaternion, dvector};

    fn ground() -> Plane {
        let angle = 20f64.to_radians();
        Plane::new(dvector![angle.sin(), 0.0, angle.cos()], 0.1, 0.5, 0.0).expect("a unit normal")
    }

    fn ball(spheres: Vec<([f64; 3], f64)>, faces: Option<[f64; 3]>) -> SphereBody {
        SphereBody { name: "ball".into(), mass: 2.0, moments: [0.3, 0.5, 0.7], spheres, faces }
    }

    /// The same ball twice, with the state of the second: position, quaternion and ω in the body.
    fn both() -> (SphereBodies, State, SpatialBodies, State) {
        let moments = [0.3, 0.5, 0.7];
        let body = SphereBodies::new("ball", vec![ball(vec![([0.0; 3], 0.25)], None)], [0.0, 0.0, -9.81], ground()).expect("valid");
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1);
        let spin = Vector3::new(1.0, -2.0, 0.5);
        let [w, x, y, z] = [turn.w, turn.i, turn.j, turn.k];
        let own = SphereBodies::state([([0.2, 0.1, 0.4], [w, x, y, z], [1.0, 2.0, -1.0], spin.into())]);
        let shape = Shape::Sphere { radius: 0.25 };
        let other = SpatialBodies::new("ball", vec![SpatialBody::new("ball", shape, 2.0, moments).unwrap()], [0.0, 0.0, -9.81], ground());
        let inside = turn.inverse_transform_vector(&spin);
        let velocity = dvector![1.0, 2.0, -1.0, inside[0], inside[1], inside[2]];
        let state = State { velocity, ..own.clone() };
        (body, own, other.expect("valid"), state)
    }

    #[test]
    fn energy_and_gap_are_those_of_the_other_coordinates() {
        let (one, state, other, turned) = both();
        assert!((one.energy(&state) - other.energy(&turned)).abs() <= rounding(64, 20.0));
        let gap = |mechanism: &dyn Mechanism, state: &State| mechanism.contacts(&state.position)[0].gap;
        assert!((gap(&one, &state) - gap(&other, &turned)).abs() <= rounding(16, 1.0));
    }

    #[test]
    fn the_acceleration_in_space_is_that_of_the_other_coordinates() {
        // ω̇ = R Ω̇, because R Ω and ω are the same vector and Ω × Ω = 0.
        let (one, state, other, turned) = both();
        let accelerate = |mechanism: &dyn Mechanism, state: &State| {
            mechanism.mass_matrix(&state.position).lu().solve(&mechanism.force(&state.position, &state.velocity)).expect("regular")
        };
        let (own, inside) = (accelerate(&one, &state), accelerate(&other, &turned));
        let turned = Pose::of(0, &state.position).rotation * inside.fixed_rows::<3>(3);
        assert!((own.fixed_rows::<3>(3) - turned).amax() <= rounding(256, 10.0));
        assert!((own.rows(0, 3) - inside.rows(0, 3)).amax() <= rounding(16, 10.0));
    }

    #[test]
    fn the_rows_of_a_contact_are_the_velocity_of_the_point_halfway_between_sphere_and_plane() {
        let (body, state, _, _) = both();
        let contact = &body.contacts(&state.position)[0];
        let normal = Vector3::new(20f64.to_radians().sin(), 0.0, 20f64.to_radians().cos());
        let spin = state.velocity.fixed_rows::<3>(3).into_owned();
        let point = state.velocity.fixed_rows::<3>(0) + spin.cross(&(-normal * (0.25 + 0.5 * contact.gap)));
        let frame = contact.place.expect("a body").frame.map(Vector3::from);
        let found = &contact.jacobian * &state.velocity;
        for row in 0..3 {
            assert!((found[row] - frame[row].dot(&point)).abs() <= rounding(32, 4.0));
        }
    }

    #[test]
    fn a_rotation_moves_by_eulers_step_and_stays_a_rotation() {
        let (body, state, _, _) = both();
        let h = 1.0 / 64.0;
        let next = body.integrate(&state.position, &state.velocity, h);
        let spin = state.velocity.fixed_rows::<3>(3).into_owned();
        let exact = UnitQuaternion::from_scaled_axis(spin * h) * UnitQuaternion::new_normalize(quaternion(0, &state.position));
        let angle = exact.angle_to(&UnitQuaternion::new_normalize(quaternion(0, &next)));
        // ‖ω‖h − 2 atan(½‖ω‖h) = (‖ω‖h)³/12 − …
        let turn = spin.norm() * h;
        // the angle comes from a cosine near 1
        assert!((angle - (turn - 2.0 * (0.5 * turn).atan())).abs() <= rounding(16, 1.0).sqrt(), "{angle}");
        assert!((quaternion(0, &next).norm() - 1.0).abs() <= rounding(16, 1.0));
    }

    #[test]
    fn a_sphere_and_the_face_of_another_body_are_looked_at_halfway_and_pushed_apart() {
        // a box at rest under a ball that has sunk into its upper face, both tilted with the frame of the world
        let turn = UnitQuaternion::from_euler_angles(0.2, -0.4, 0.7);
        let up = turn * Vector3::z();
        let [w, x, y, z] = [turn.w, turn.i, turn.j, turn.k];
        let (radius, depth, beside) = (0.25, 0.03, turn * Vector3::new(0.3, -0.2, 0.0));
        let (below, above) = (Vector3::new(0.0, 0.0, 5.0), Vector3::new(0.0, 0.0, 5.0) + beside + up * (0.5 + radius - depth));
        let bodies = vec![ball(vec![([0.0; 3], 0.01)], Some([1.0, 1.0, 0.5])), ball(vec![([0.0; 3], radius)], None)];
        let pair = SphereBodies::new("pair", bodies, [0.0, 0.0, -9.81], ground()).expect("valid");
        let spins = [Vector3::new(0.5, -1.0, 2.0), Vector3::new(-3.0, 0.25, 1.0)];
        let speeds = [Vector3::new(0.1, 0.2, 0.3), Vector3::new(-1.0, 0.5, 2.0)];
        let state = SphereBodies::state([
            (below.into(), [w, x, y, z], speeds[0].into(), spins[0].into()),
            (above.into(), [1.0, 0.0, 0.0, 0.0], speeds[1].into(), spins[1].into()),
        ]);
        let contacts = pair.contacts(&state.position);
        assert_eq!(
            contacts.iter().map(|contact| contact.place.expect("bodies").bodies).collect::<Vec<_>>(),
            [(0, None), (1, None), (1, Some(0))]
        );
        let contact = &contacts[2];
        assert!((contact.gap + depth).abs() <= rounding(64, 6.0), "{}", contact.gap);
        let point = below + beside + up * (0.5 - 0.5 * depth);
        let relative = speeds[1] + spins[1].cross(&(point - above)) - speeds[0] - spins[0].cross(&(point - below));
        let frame = contact.place.expect("bodies").frame.map(Vector3::from);
        assert!((frame[0] - up).norm() <= rounding(64, 1.0));
        let found = &contact.jacobian * &state.velocity;
        for row in 0..3 {
            assert!((found[row] - frame[row].dot(&relative)).abs() <= rounding(256, 8.0), "{row}: {found}");
        }
        // the spheres of a body do not meet its own box, and those of one without faces nothing but the ground
        assert_eq!(pair.contacts(&state.position).len(), 3);
    }

    #[test]
    fn nonsense_is_refused() {
        let make = |body: SphereBody, plane| SphereBodies::new("body", vec![body], [0.0; 3], plane);
        let one = || ball(vec![([0.0; 3], 1.0)], None);
        assert!(make(one(), ground()).is_ok());
        assert!(SphereBodies::new("none", vec![], [0.0; 3], ground()).is_err());
        assert!(make(SphereBody { mass: 0.0, ..one() }, ground()).is_err());
        assert!(make(ball(vec![], None), ground()).is_err());
        assert!(make(ball(vec![([0.0; 3], -1.0)], None), ground()).is_err());
        assert!(make(SphereBody { faces: Some([1.0, 0.0, 1.0]), ..one() }, ground()).is_err());
        assert!(make(one(), Plane::new(dvector![0.0, 1.0], 0.0, 0.0, 0.0).unwrap()).is_err());
    }
}
