//! One rigid body that touches a plane through spheres fixed to it, its angular velocity in world axes.
//!
//! ```text
//!     q = (x, w, i, j, k)       centre of mass and quaternion, body to world
//!     v = (ẋ, ω)                both in world axes
//!     M(q) = diag(m, m, m) ⊕ R J Rᵀ ,     F = (m g, −ω × R J Rᵀ ω)
//!     q⁺ = (x + h ẋ, (p + ½ h ω ∘ p)/‖·‖)
//!     φ_i = n·(x + R s_i) − c − ρ_i ,     contact point x + R s_i − (ρ_i + φ_i/2) n
//! ```
//! The same body as [`SpatialBodies`](super::SpatialBodies) in other coordinates: M is not diagonal when the body is tilted, the rotation moves by one
//! step of Euler's method, and the contact point lies halfway between sphere and plane. These are the coordinates of Drake, whose contact law depends
//! on them: its regularisation reads the diagonal of M.

use super::point_mass::{Plane, positive};
use super::{BodyState, Mechanism, State};
use crate::contact::{Contact, Place};
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};

/// A rigid body with spheres, over a plane.
#[derive(Clone, Debug)]
pub struct SphereBody {
    name: String,
    mass: f64,
    moments: Vector3<f64>,
    spheres: Vec<(Vector3<f64>, f64)>,
    gravity: Vector3<f64>,
    ground: Plane,
}

impl SphereBody {
    /// A body of mass m \[kg\] and principal moments J \[kg·m²\] about its own axes, with spheres (centre in body axes, radius) \[m\].
    ///
    /// # Errors
    /// [`Error::Invalid`] if mass, a moment or a radius is not positive, there is no sphere, or the ground is not a plane in space.
    pub fn new(
        name: impl Into<String>,
        mass: f64,
        moments: [f64; 3],
        spheres: Vec<([f64; 3], f64)>,
        gravity: [f64; 3],
        ground: Plane,
    ) -> Result<Self> {
        positive("mass", mass)?;
        moments.into_iter().try_for_each(|moment| positive("inertia", moment))?;
        spheres.iter().try_for_each(|(_, radius)| positive("radius", *radius))?;
        if spheres.is_empty() {
            return Err(Error::invalid("spheres", "is empty", "give at least one sphere"));
        }
        if ground.normal.len() != 3 {
            return Err(Error::invalid("normal", format!("has {} components", ground.normal.len()), "use (x, y, z)"));
        }
        let spheres = spheres.into_iter().map(|(centre, radius)| (centre.into(), radius)).collect();
        Ok(SphereBody { name: name.into(), mass, moments: moments.into(), spheres, gravity: gravity.into(), ground })
    }

    /// q and v of a body at rest or in motion: centre \[m\], quaternion \[w, x, y, z\], velocity \[m/s\] and ω \[rad/s\] in world axes.
    pub fn state(position: [f64; 3], orientation: [f64; 4], linear: [f64; 3], angular: [f64; 3]) -> State {
        let joined = |one: &[f64], other: &[f64]| DVector::from_iterator(one.len() + other.len(), one.iter().chain(other).copied());
        State { time: 0.0, position: joined(&position, &orientation), velocity: joined(&linear, &angular) }
    }

    /// R J Rᵀ.
    fn inertia(&self, rotation: &Matrix3<f64>) -> Matrix3<f64> {
        rotation * Matrix3::from_diagonal(&self.moments) * rotation.transpose()
    }
}

fn quaternion(position: &DVector<f64>) -> Quaternion<f64> {
    Quaternion::new(position[3], position[4], position[5], position[6])
}

fn rotation(position: &DVector<f64>) -> Matrix3<f64> {
    *UnitQuaternion::new_normalize(quaternion(position)).to_rotation_matrix().matrix()
}

impl Mechanism for SphereBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        6
    }

    fn rows_per_contact(&self) -> usize {
        3
    }

    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        let inertia = self.inertia(&rotation(position));
        DMatrix::from_fn(6, 6, |i, j| match (i < 3, j < 3) {
            (true, true) if i == j => self.mass,
            // one triangle mirrored: the product of three matrices is symmetric up to rounding only
            (false, false) => inertia[(i.min(j) - 3, i.max(j) - 3)],
            _ => 0.0,
        })
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        let spin = velocity.fixed_rows::<3>(3).into_owned();
        let torque = -spin.cross(&(self.inertia(&rotation(position)) * spin));
        let weight = self.gravity * self.mass;
        DVector::from_iterator(6, weight.iter().chain(torque.iter()).copied())
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let turned = rotation(position);
        let frame = self.ground.frame();
        let normal = Vector3::new(frame[(0, 0)], frame[(0, 1)], frame[(0, 2)]);
        let contact = |(index, (centre, radius)): (usize, &(Vector3<f64>, f64))| {
            let arm = turned * centre;
            let gap = normal.dot(&(position.fixed_rows::<3>(0) + arm)) - self.ground.offset - radius;
            let lever = arm - normal * (radius + 0.5 * gap);
            let rows: [[f64; 3]; 3] = std::array::from_fn(|row| std::array::from_fn(|axis| frame[(row, axis)]));
            let jacobian = DMatrix::from_fn(3, 6, |row, column| {
                let direction = Vector3::from(rows[row]);
                if column < 3 { direction[column] } else { lever.cross(&direction)[column - 3] }
            });
            let place = Place { bodies: (0, None), features: [index as u32, 0], frame: rows };
            let Plane { friction, restitution, .. } = self.ground;
            Contact { gap, jacobian, friction, restitution, label: format!("{}-{index}/ground", self.name), place: Some(place) }
        };
        self.spheres.iter().enumerate().map(contact).collect()
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        -self.mass * self.gravity.dot(&position.fixed_rows::<3>(0))
    }

    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let spin = Quaternion::from_imag(velocity.fixed_rows::<3>(3).into_owned());
        let old = quaternion(position);
        let turned = (old + spin * old * (0.5 * h)).normalize();
        let mut next = position.clone();
        next.rows_mut(0, 3).axpy(h, &velocity.rows(0, 3), 1.0);
        next.fixed_rows_mut::<4>(3).copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
        next
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        vec![BodyState {
            name: self.name.clone(),
            position: std::array::from_fn(|axis| position[axis]),
            orientation: std::array::from_fn(|part| position[3 + part]),
            linear_velocity: std::array::from_fn(|axis| velocity[axis]),
            angular_velocity: std::array::from_fn(|axis| velocity[3 + axis]),
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::SpatialBodies;
    use crate::mechanics::spatial::{Shape, SpatialBody};
    use crate::tolerance::rounding;
    use nalgebra::dvector;

    fn ground() -> Plane {
        let angle = 20f64.to_radians();
        Plane::new(dvector![angle.sin(), 0.0, angle.cos()], 0.1, 0.5, 0.0).expect("a unit normal")
    }

    /// The same ball twice, with the state of the second: position, quaternion and ω in the body.
    fn both() -> (SphereBody, State, SpatialBodies, State) {
        let moments = [0.3, 0.5, 0.7];
        let body = SphereBody::new("ball", 2.0, moments, vec![([0.0; 3], 0.25)], [0.0, 0.0, -9.81], ground()).expect("valid");
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1);
        let spin = Vector3::new(1.0, -2.0, 0.5);
        let [w, x, y, z] = [turn.w, turn.i, turn.j, turn.k];
        let own = SphereBody::state([0.2, 0.1, 0.4], [w, x, y, z], [1.0, 2.0, -1.0], spin.into());
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
        let turned = rotation(&state.position) * inside.fixed_rows::<3>(3);
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
        let exact = UnitQuaternion::from_scaled_axis(spin * h) * UnitQuaternion::new_normalize(quaternion(&state.position));
        let angle = exact.angle_to(&UnitQuaternion::new_normalize(quaternion(&next)));
        // ‖ω‖h − 2 atan(½‖ω‖h) = (‖ω‖h)³/12 − …
        let turn = spin.norm() * h;
        // the angle comes from a cosine near 1
        assert!((angle - (turn - 2.0 * (0.5 * turn).atan())).abs() <= rounding(16, 1.0).sqrt(), "{angle}");
        assert!((quaternion(&next).norm() - 1.0).abs() <= rounding(16, 1.0));
    }

    #[test]
    fn nonsense_is_refused() {
        let make = |mass, spheres, plane| SphereBody::new("body", mass, [1.0; 3], spheres, [0.0; 3], plane);
        let one = || vec![([0.0; 3], 1.0)];
        assert!(make(1.0, one(), ground()).is_ok());
        assert!(make(0.0, one(), ground()).is_err());
        assert!(make(1.0, vec![], ground()).is_err());
        assert!(make(1.0, vec![([0.0; 3], -1.0)], ground()).is_err());
        assert!(make(1.0, one(), Plane::new(dvector![0.0, 1.0], 0.0, 0.0, 0.0).unwrap()).is_err());
    }
}
