//! Rigid bodies in space: unit quaternions, M = diag(m, m, m, J₁, J₂, J₃) per body, contacts of spheres, boxes, capsules and cylinders.
//!
//! ```text
//!     q = (x, y, z, w, i, j, k) per body          centre of mass and unit quaternion, body to world
//!     v = (ẋ, ẏ, ż, Ω₁, Ω₂, Ω₃) per body          linear velocity in the world, angular velocity in the body's principal axes
//!     F = (m g, −Ω × JΩ)                          q⁺ = (x + h ẋ, q ∘ exp(½ h Ω))
//! ```
//! The angular velocity is taken in the body frame because there M is constant and diagonal: the step's effective mass is
//! never factored, and the gyroscopic term has no derivative of R in it. A point at the world distance r from the centre
//! moves with ẋ + (RΩ) × r, so a contact row with direction d is (d, Rᵀ(r × d)).
//!
//! A body that nothing moves (static, or with a prescribed velocity) has M = ∞: M⁻¹ = 0, F = 0, and v stays what it was. Its own motion has
//! no kinetic energy here, and it has no contact with the ground or with another one of its kind.
//!
//! The gyroscopic term enters a step by its average over it, see [`gyroscopic`](self::SpatialBodies) and
//! [`Mechanism::mean_force`].

mod boxes;
mod capsule_box;
mod circles;
mod cylinders;
mod faces;
mod features;
mod gyroscopic;
mod manifold;
mod round;
mod search;
mod shape;
mod solids;
mod spheres;
mod touch;

pub(in crate::mechanics) use shape::Pose;
pub use shape::{Shape, SpatialBody};
pub(in crate::mechanics) use spheres::sphere_box;
pub(in crate::mechanics) use touch::Touch;
use touch::Touches;

use super::neighbours::{Neighbours, largest};
use super::{BodyState, Materials, Mechanism, PairMaterial, Plane, State};
use crate::tolerance::limits::PRECESSION_PARTS;
use crate::tolerance::mechanics::{BESIDE, PARALLEL_FACES};
use features::{ground_touches, pair_touches};
use moreau_contact::contact::frame::spatial_tangents;
use moreau_contact::contact::{Contact, Mass, Place, Rows};
use moreau_contact::memory::spare::{self, Lent, Spare};
use moreau_exact::number::{counted, significant};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, Matrix3, UnitQuaternion, Vector3};

/// Candidates of two boxes at most: corners over faces, and crossings of the edges of two faces.
const MOST_TOUCHES: usize = 16;
/// Candidates of a pair with a capsule at most, a box's: its ends over a face and as balls, its side at eight corners and twelve edges, and
/// the nearest points.
const MOST_OF_CAPSULES: usize = 2 + 2 + 8 + 12 + 1;
/// Candidates of a cylinder with the ground at most: the lowest point of each rim, and four that turn with it.
const MOST_OF_CYLINDERS: usize = 10;
/// Candidates of a pair with a cylinder at most, a box's: ten points of the rims over a face, eight corners over a face or beside the side,
/// twelve edges across the side, two places of each at two rims, and the nearest points.
const MOST_OF_CYLINDER_PAIRS: usize = 10 + 8 + 12 + 48 + 1;

/// Spheres, boxes, capsules and cylinders in space under gravity, over an optional ground plane.
///
/// Contact candidates in fixed order: each body with the ground (sphere: 1, box: its 8 corners, capsule: its 2 ends, cylinder: rims), then
/// each pair i < j (with a sphere: 1, otherwise a manifold whose size varies), with the normal pointing to the body named first.
#[derive(Clone, Debug)]
pub struct SpatialBodies {
    name: String,
    bodies: Vec<SpatialBody>,
    gravity: Vector3<f64>,
    ground: Option<Plane>,
    materials: Materials,
    /// The diagonal of M, infinite where nothing moves the body.
    inertias: DVector<f64>,
    /// Of every body that of [`Shape::radius`] \[m\].
    radii: Vec<f64>,
    neighbours: Neighbours,
}

impl SpatialBodies {
    /// Bodies over a ground plane, whose friction and restitution hold for every pair unless overridden.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no body, gravity is not finite or the ground is not a plane in space.
    pub fn new(name: impl Into<String>, bodies: Vec<SpatialBody>, gravity: [f64; 3], ground: Plane) -> Result<Self> {
        if ground.normal.len() != 3 {
            return Err(Error::invalid("normal", format!("has {}", counted(ground.normal.len(), "component")), "use (x, y, z)"));
        }
        let materials = Materials::new(ground.friction, ground.restitution)?;
        let floating = SpatialBodies::without_ground(name, bodies, gravity, materials)?;
        Ok(SpatialBodies { ground: Some(ground), ..floating })
    }

    /// Bodies in free space.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no body or gravity is not finite.
    pub fn without_ground(name: impl Into<String>, bodies: Vec<SpatialBody>, gravity: [f64; 3], materials: Materials) -> Result<Self> {
        if bodies.is_empty() {
            return Err(Error::invalid("bodies", "is empty", "give at least one body"));
        }
        if !gravity.iter().all(|g| g.is_finite()) {
            return Err(Error::invalid("gravity", format!("is {gravity:?}"), "use finite numbers"));
        }
        let diagonal = bodies.iter().flat_map(|body| [body.mass(); 3].into_iter().chain(body.moments().iter().copied()));
        let inertias = DVector::from_iterator(6 * bodies.len(), diagonal);
        let radii = bodies.iter().map(|body| body.shape().radius()).collect();
        let (name, gravity, neighbours) = (name.into(), gravity.into(), Neighbours::default());
        Ok(SpatialBodies { name, bodies, gravity, ground: None, materials, inertias, radii, neighbours })
    }

    /// The same bodies with some pairs' friction and restitution overridden.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a pair names a body that does not exist, μ < 0 or e ∉ \[0, 1\].
    pub fn with_pairs(mut self, pairs: Vec<PairMaterial>) -> Result<Self> {
        self.materials = self.materials.with_pairs(pairs, self.bodies.len())?;
        Ok(self)
    }

    fn free(&self) -> impl Iterator<Item = (usize, &SpatialBody)> {
        self.bodies.iter().enumerate().filter(|(_, body)| body.is_free())
    }

    fn poses(&self, position: &DVector<f64>) -> impl Iterator<Item = Pose> {
        (0..self.bodies.len()).map(|body| Pose::of(body, position))
    }

    /// A candidate of two bodies at these poses in this frame, its rows taken at the points `seen` of the two.
    fn contact(
        &self,
        (first, second): (usize, Option<usize>),
        touch: &Touch,
        frame: [[f64; 3]; 3],
        seen: [Vector3<f64>; 2],
        poses: [&Pose; 2],
    ) -> Contact {
        let rows = |pose: &Pose, point: Vector3<f64>, sign: f64| {
            let lever = point - pose.centre;
            let row = |direction: [f64; 3]| six(sign, direction, pose.rotation.tr_mul(&lever.cross(&Vector3::from(direction))).into());
            [row(frame[0]), row(frame[1]), row(frame[2])]
        };
        let (friction, restitution) = self.materials.of(first, second);
        let place = Place { bodies: (first, second), features: touch.features, frame };
        let jacobian = Rows::zeros(3, 6 * self.bodies.len());
        let mut contact = Contact { gap: touch.gap, jacobian, friction, restitution, place: Some(place) };
        contact.jacobian.push(6 * first, &rows(poses[0], seen[0], 1.0));
        if let Some(second) = second {
            contact.jacobian.push(6 * second, &rows(poses[1], seen[1], -1.0));
        }
        contact
    }

    /// The candidates with a gap of at most `reach`, their rows taken at the points of the two bodies that `seen` chooses.
    fn candidates(&self, position: &DVector<f64>, reach: f64, seen: impl Fn(&Touch) -> [Vector3<f64>; 2]) -> Vec<Contact> {
        let mut contacts = spare::vector(self.neighbours.expected());
        // those of one face, and all on the ground, have one normal
        let mut frame = [[f64::NAN; 3]; 3];
        self.touches(position, reach, |poses, first, second, touch| {
            let two = [&poses[first], &poses[second.unwrap_or(first)]];
            if frame[0].map(f64::to_bits) != <[f64; 3]>::from(touch.normal).map(f64::to_bits) {
                frame = frame_of(&touch.normal);
            }
            contacts.push(self.contact((first, second), touch, frame, seen(touch), two));
        });
        self.neighbours.expect(contacts.len());
        contacts
    }

    /// (m g, τ) per body with the given torques in the body frame.
    fn weights(&self, torque: impl Fn(usize, &SpatialBody) -> Vector3<f64>) -> DVector<f64> {
        let mut force = spare::zeros(self.degrees_of_freedom());
        for (k, body) in self.free() {
            force.fixed_rows_mut::<3>(6 * k).copy_from(&(self.gravity * body.mass()));
            force.fixed_rows_mut::<3>(6 * k + 3).copy_from(&torque(k, body));
        }
        force
    }
}

/// n, t₁ and t₂ of a normal.
fn frame_of(normal: &Vector3<f64>) -> [[f64; 3]; 3] {
    let [t1, t2] = spatial_tangents((*normal).into());
    [(*normal).into(), t1, t2]
}

/// Ω of body k.
fn spin(body: usize, velocity: &DVector<f64>) -> Vector3<f64> {
    velocity.fixed_rows::<3>(6 * body + 3).into_owned()
}

/// A row of H at one body: the direction in which its point moves, and the arm of a turn, both with a sign.
#[inline]
pub(in crate::mechanics) fn six(sign: f64, [x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 6] {
    [sign * x, sign * y, sign * z, sign * a, sign * b, sign * c]
}

impl Mechanism for SpatialBodies {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        6 * self.bodies.len()
    }

    fn rows_per_contact(&self) -> usize {
        3
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_diagonal(&self.inertias)
    }

    fn mass(&self, _position: &DVector<f64>) -> Mass {
        Mass::Diagonal(self.inertias.copied())
    }

    fn is_free(&self) -> bool {
        true
    }

    fn kinetic_energy(&self, state: &State) -> f64 {
        let mut momentum = Lent::from(self.inertias.copied());
        momentum.zip_apply(&state.velocity, |m, v| *m = if m.is_finite() { *m * v } else { 0.0 });
        0.5 * state.velocity.dot(&*momentum)
    }

    fn force(&self, _position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        self.weights(|k, body| {
            let spin = spin(k, velocity);
            -spin.cross(&body.moments().component_mul(&spin))
        })
    }

    /// The gyroscopic torque is J(Ω⁺ − Ω)/h with the implicit midpoint step Ω⁺ of torque-free rotation, which keeps kinetic energy
    /// and the size of the angular momentum and is of second order.
    fn mean_force(&self, _position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        self.weights(|k, body| {
            let spin = spin(k, velocity);
            (gyroscopic::free_spin(body.moments(), &spin, h) - spin).component_mul(body.moments()) / h
        })
    }

    fn check_speed(&self, velocity: &DVector<f64>, h: f64) -> Result<()> {
        let fast = |(k, body): &(usize, &SpatialBody)| gyroscopic::is_too_fast(body.moments(), &spin(*k, velocity), h);
        let Some((k, _)) = self.free().find(fast) else { return Ok(()) };
        let turn = spin(k, velocity).norm() * h;
        let problem = format!("of {} turns it by {} rad in a step of {h} s", self.bodies[k].name(), significant(turn));
        let cure = format!(
            "use a smaller step: the free rotation of a body that is not round is computed in at most {PRECESSION_PARTS} parts of half a \
                radian a step"
        );
        Err(Error::invalid("angular_velocity", problem, cure))
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        self.contacts_within(position, f64::INFINITY)
    }

    fn contacts_within(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        self.candidates(position, reach, |touch| touch.seen)
    }

    /// A sphere has one candidate with the ground and a box its eight corners; a pair has one, or sixteen of two boxes: eight corners and
    /// eight crossings of the edges of two faces; or as many as a capsule or a cylinder may have.
    fn most_candidates(&self) -> Option<usize> {
        let boxes = self.bodies.iter().filter(|body| matches!(body.shape(), Shape::Box { .. })).count();
        let count = |is: fn(&Shape) -> bool| self.bodies.iter().filter(|body| is(body.shape())).count();
        let capsules = count(|shape| matches!(shape, Shape::Capsule { .. }));
        let cylinders = count(|shape| matches!(shape, Shape::Cylinder { .. }));
        let pairs = |n: usize| n.saturating_mul(n.saturating_sub(1)) / 2;
        let all = pairs(self.bodies.len());
        let with_cylinders = all.saturating_sub(pairs(self.bodies.len() - cylinders));
        let with_capsules = pairs(self.bodies.len() - cylinders).saturating_sub(pairs(self.bodies.len() - cylinders - capsules));
        let others = all.saturating_sub(pairs(boxes)).saturating_sub(with_capsules).saturating_sub(with_cylinders);
        let more = 7 * boxes + capsules + (MOST_OF_CYLINDERS - 1) * cylinders;
        let ground = if self.ground.is_some() { self.bodies.len() + more } else { 0 };
        let many = [(pairs(boxes), MOST_TOUCHES), (with_capsules, MOST_OF_CAPSULES), (with_cylinders, MOST_OF_CYLINDER_PAIRS)];
        let manifolds = many.into_iter().fold(0usize, |sum, (pairs, most)| sum.saturating_add(pairs.saturating_mul(most)));
        Some(manifolds.saturating_add(others).saturating_add(ground))
    }

    fn count_within(&self, position: &DVector<f64>, reach: f64) -> usize {
        let mut count = 0;
        self.touches(position, reach, |_, _, _, _| count += 1);
        count
    }

    fn gaps_within(&self, position: &DVector<f64>, reach: f64, show: &mut dyn FnMut(f64, Option<(usize, Option<usize>)>)) {
        self.touches(position, reach, |_, first, second, touch| show(touch.gap, Some((first, second))));
    }

    fn contacts_between(&self, position: &DVector<f64>, (first, second): (usize, Option<usize>)) -> Vec<Contact> {
        let [own, other] = [first, second.unwrap_or(first)].map(|body| Pose::of(body, position));
        let mut touches = Touches::default();
        match (second, &self.ground) {
            (None, None) => {}
            (None, Some(_)) if !self.bodies[first].is_free() => {}
            (Some(other), _) if !(self.bodies[first].is_free() || self.bodies[other].is_free()) => {}
            (None, Some(ground)) => ground_touches(self.bodies[first].shape(), &own, ground, &mut touches.list),
            (Some(second), _) => {
                pair_touches(self.bodies[first].shape(), &own, self.bodies[second].shape(), &other, &mut touches);
            }
        }
        let contact = |touch: &Touch| self.contact((first, second), touch, frame_of(&touch.normal), touch.seen, [&own, &other]);
        touches.list.iter().map(contact).collect()
    }

    fn contacts_halfway(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        self.candidates(position, reach, |touch| [touch.points[0] - touch.normal * (0.5 * touch.gap); 2])
    }

    fn inverse_mass(&self, contact: &Contact) -> Option<f64> {
        let (first, second) = contact.place.as_ref()?.bodies;
        Some([Some(first), second].into_iter().flatten().map(|body| 1.0 / self.bodies[body].mass()).sum())
    }

    /// R Ω of the first body less that of the second.
    fn contact_rotation(&self, position: &DVector<f64>, contact: &Contact) -> Option<Rows> {
        let place = contact.place.as_ref()?;
        let mut rows = Rows::zeros(3, self.degrees_of_freedom());
        for (body, sign) in [(Some(place.bodies.0), 1.0), (place.bodies.1, -1.0)] {
            let Some(body) = body else { continue };
            let rotation = Pose::of(body, position).rotation;
            let block = place.frame.map(|direction| {
                let own = rotation.tr_mul(&Vector3::from(direction)) * sign;
                [0.0, 0.0, 0.0, own[0], own[1], own[2]]
            });
            rows.push(6 * body, &block);
        }
        Some(rows)
    }

    /// −∂(Ω × JΩ)/∂Ω = \[JΩ\]ₓ − \[Ω\]ₓ J for every body.
    fn gyroscopic_slope(&self, _position: &DVector<f64>, velocity: &DVector<f64>) -> Option<Vec<DMatrix<f64>>> {
        let mut slopes = vec![DMatrix::zeros(6, 6); self.bodies.len()];
        for (k, body) in self.free() {
            let spin = spin(k, velocity);
            let momentum = body.moments().component_mul(&spin);
            let block = momentum.cross_matrix() - spin.cross_matrix() * Matrix3::from_diagonal(body.moments());
            slopes[k].fixed_view_mut::<3, 3>(3, 3).copy_from(&block);
        }
        Some(slopes)
    }

    /// The rows of a contact of body k see a point within its radius R_k. Three things move it outside: beside a face a sixteenth of the
    /// gap φ, halfway between parallel faces φ/2, levelled over the ground half the diameter times the tilt θ₀. With
    /// s = Σ(‖ẋ_k‖ + ‖Ω_k‖ R_k (1 + θ₀)) and w = Σ‖Ω_k‖ over the two fastest bodies and β = ½ + 1/16, h(|u_n| + μ‖u_t‖) ≤
    /// h(1 + μ)(s + β w φ), which is below φ for every φ above h(1 + μ) s / (1 − h(1 + μ) β w).
    fn reach(&self, velocity: &DVector<f64>, h: f64) -> f64 {
        let (mut speeds, mut turns) = ([0.0; 2], [0.0; 2]);
        for (k, radius) in self.radii.iter().enumerate() {
            let turn = spin(k, velocity).norm();
            largest(&mut speeds, velocity.fixed_rows::<3>(6 * k).norm() + turn * radius * (1.0 + PARALLEL_FACES));
            largest(&mut turns, turn);
        }
        let factor = h * (1.0 + self.materials.largest_friction());
        let left = 1.0 - factor * (turns[0] + turns[1]) * (0.5 + BESIDE);
        if left > 0.0 { factor * (speeds[0] + speeds[1]) / left } else { f64::INFINITY }
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        let height = |k: usize| self.gravity.dot(&position.fixed_rows::<3>(7 * k));
        self.free().map(|(k, body)| -body.mass() * height(k)).sum()
    }

    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let mut next = position.copied();
        for (k, next) in next.as_mut_slice().as_chunks_mut::<7>().0.iter_mut().enumerate() {
            let (centre, quaternion) = Pose::placed(k, position);
            let [x, y, z] = (centre + velocity.fixed_rows::<3>(6 * k) * h).into();
            let turned = (quaternion * UnitQuaternion::from_scaled_axis(spin(k, velocity) * h)).into_inner().normalize();
            *next = [x, y, z, turned.w, turned.i, turned.j, turned.k];
        }
        next
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let state = |(k, body): (usize, &SpatialBody)| {
            let pose = Pose::of(k, position);
            BodyState {
                name: body.name().to_string(),
                position: pose.centre.into(),
                orientation: std::array::from_fn(|part| position[7 * k + 3 + part]),
                linear_velocity: std::array::from_fn(|axis| velocity[6 * k + axis]),
                angular_velocity: (pose.rotation * spin(k, velocity)).into(),
            }
        };
        self.bodies.iter().enumerate().map(state).collect()
    }
}

#[cfg(test)]
mod cylinder_tests;
#[cfg(test)]
mod face_tests;
#[cfg(test)]
mod manifold_tests;
#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod unmoved_tests;
