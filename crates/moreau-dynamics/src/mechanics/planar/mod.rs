//! Planar rigid bodies: M = diag(m, m, I) per body, contacts of disks and boxes with the ground and each other.
//!
//! Motion is in the x–z plane. A body's coordinates are (x, z, θ), θ the rotation about +ŷ, so that
//! ```text
//!     R(θ)(a, b) = a (cos θ, −sin θ) + b (sin θ, cos θ),      velocity of the point at r from the centre:  v + ω (r_z, −r_x)
//! ```
//! and (0, θ̇, 0) is the angular velocity in space. Ground tangents point to +x on level ground and down an incline
//! with normal (sin α, cos α).

mod boxes;
mod faces;
mod features;
mod search;
mod shape;
mod touch;

pub use shape::{PlanarBody, Shape};

use super::neighbours::Neighbours;
use super::{BodyState, Materials, Mechanism, PairMaterial, Plane, State};
use features::{ground_touches, pair_touches};
use moreau_contact::contact::{Contact, Mass, Place, Rows};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use shape::Pose;
use touch::Touch;

/// Disks and boxes in the x–z plane under gravity, over an optional ground line; q = (x, z, θ) per body.
///
/// Contact candidates in fixed order: each body with the ground (disk: 1, box: its 4 corners), then each pair i < j
/// (two boxes: 2, otherwise 1), with the normal pointing to the body named first.
#[derive(Clone, Debug)]
pub struct PlanarBodies {
    name: String,
    bodies: Vec<PlanarBody>,
    gravity: [f64; 2],
    ground: Option<Plane>,
    materials: Materials,
    neighbours: Neighbours,
}

impl PlanarBodies {
    /// Bodies over a ground line, whose friction and restitution hold for every pair unless overridden.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no body, gravity is not finite or the ground is not a line in the plane.
    pub fn new(name: impl Into<String>, bodies: Vec<PlanarBody>, gravity: [f64; 2], ground: Plane) -> Result<Self> {
        if ground.normal.len() != 2 {
            return Err(Error::invalid("normal", format!("has {}", counted(ground.normal.len(), "component")), "use (x, z)"));
        }
        let (friction, restitution) = (ground.friction, ground.restitution);
        let floating = PlanarBodies::without_ground(name, bodies, gravity, friction, restitution)?;
        Ok(PlanarBodies { ground: Some(ground), ..floating })
    }

    /// Bodies in free space.
    ///
    /// # Errors
    /// As [`PlanarBodies::new`]; μ < 0 and e ∉ \[0, 1\] are refused too.
    pub fn without_ground(
        name: impl Into<String>,
        bodies: Vec<PlanarBody>,
        gravity: [f64; 2],
        friction: f64,
        restitution: f64,
    ) -> Result<Self> {
        if bodies.is_empty() {
            return Err(Error::invalid("bodies", "is empty", "give at least one body"));
        }
        if !gravity.iter().all(|g| g.is_finite()) {
            return Err(Error::invalid("gravity", format!("is {gravity:?}"), "use finite numbers"));
        }
        let materials = Materials::new(friction, restitution)?;
        Ok(PlanarBodies { name: name.into(), bodies, gravity, ground: None, materials, neighbours: Neighbours::default() })
    }

    /// The same bodies with some pairs' friction and restitution overridden.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a pair names a body that does not exist, μ < 0 or e ∉ \[0, 1\].
    pub fn with_pairs(mut self, pairs: Vec<PairMaterial>) -> Result<Self> {
        self.materials = self.materials.with_pairs(pairs, self.bodies.len())?;
        Ok(self)
    }

    /// The diagonal of M.
    fn inertias(&self) -> DVector<f64> {
        let diagonal = self.bodies.iter().flat_map(|body| [body.mass(), body.mass(), body.inertia()]);
        DVector::from_iterator(3 * self.bodies.len(), diagonal)
    }

    fn poses(&self, position: &DVector<f64>) -> Vec<Pose> {
        let pose = |body: usize| Pose::new([position[3 * body], position[3 * body + 1]], position[3 * body + 2]);
        (0..self.bodies.len()).map(pose).collect()
    }

    fn contact(&self, first: usize, second: Option<usize>, touch: &Touch, poses: &[Pose], index: usize) -> Contact {
        let rows = |body: usize, point: [f64; 2], sign: f64| {
            let arm = [point[0] - poses[body].centre[0], point[1] - poses[body].centre[1]];
            [touch.normal, touch.tangent()].map(|[x, z]| [sign * x, sign * z, sign * (x * arm[1] - z * arm[0])])
        };
        let mut jacobian = Rows::zeros(2, 3 * self.bodies.len()).with(3 * first, rows(first, touch.points[0], 1.0));
        if let Some(second) = second {
            jacobian = jacobian.with(3 * second, rows(second, touch.points[1], -1.0));
        }
        let (friction, restitution) = self.materials.of(first, second);
        let frame = [touch.normal, touch.tangent()].map(|[x, z]| [x, 0.0, z]);
        let place = Place { bodies: (first, second), features: [index as u32, 0], frame: [frame[0], frame[1], [0.0, 1.0, 0.0]] };
        Contact { gap: touch.gap, jacobian, friction, restitution, place: Some(place) }
    }
}

impl Mechanism for PlanarBodies {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        3 * self.bodies.len()
    }

    fn rows_per_contact(&self) -> usize {
        2
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_diagonal(&self.inertias())
    }

    fn mass(&self, _position: &DVector<f64>) -> Mass {
        Mass::Diagonal(self.inertias())
    }

    fn is_free(&self) -> bool {
        true
    }

    fn kinetic_energy(&self, state: &State) -> f64 {
        0.5 * state.velocity.dot(&self.inertias().component_mul(&state.velocity))
    }

    fn force(&self, _position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        let [x, z] = self.gravity;
        let weights = self.bodies.iter().flat_map(|body| [body.mass() * x, body.mass() * z, 0.0]);
        DVector::from_iterator(self.degrees_of_freedom(), weights)
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        self.contacts_within(position, f64::INFINITY)
    }

    fn contacts_within(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        let poses = self.poses(position);
        let mut contacts = Vec::with_capacity(self.neighbours.expected());
        self.touches(&poses, reach, |first, second, touch, index| contacts.push(self.contact(first, second, touch, &poses, index)));
        self.neighbours.expect(contacts.len());
        contacts
    }

    /// The corners of a box or one point of a circle with the ground, two of a pair of boxes and one of another pair.
    fn most_candidates(&self) -> Option<usize> {
        let boxes = self.bodies.iter().filter(|body| matches!(body.shape(), Shape::Box { .. })).count();
        let pairs = |n: usize| n.saturating_mul(n.saturating_sub(1)) / 2;
        let ground = if self.ground.is_some() { self.bodies.len() + 3 * boxes } else { 0 };
        Some(pairs(self.bodies.len()).saturating_add(pairs(boxes)).saturating_add(ground))
    }

    fn count_within(&self, position: &DVector<f64>, reach: f64) -> usize {
        let mut count = 0;
        self.touches(&self.poses(position), reach, |_, _, _, _| count += 1);
        count
    }

    fn contacts_between(&self, position: &DVector<f64>, (first, second): (usize, Option<usize>)) -> Vec<Contact> {
        let poses = self.poses(position);
        let touches = match (second, &self.ground) {
            (None, None) => Vec::new(),
            (None, Some(ground)) => ground_touches(self.bodies[first].shape(), &poses[first], ground),
            (Some(other), _) => pair_touches(self.bodies[first].shape(), &poses[first], self.bodies[other].shape(), &poses[other]),
        };
        touches.iter().enumerate().map(|(k, touch)| self.contact(first, second, touch, &poses, k)).collect()
    }

    fn reach(&self, velocity: &DVector<f64>, h: f64) -> f64 {
        self.reached(velocity, h)
    }

    fn inverse_mass(&self, contact: &Contact) -> Option<f64> {
        let (first, second) = contact.place.as_ref()?.bodies;
        Some([Some(first), second].into_iter().flatten().map(|body| 1.0 / self.bodies[body].mass()).sum())
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        let energy =
            |(k, body): (usize, &PlanarBody)| -body.mass() * (self.gravity[0] * position[3 * k] + self.gravity[1] * position[3 * k + 1]);
        self.bodies.iter().enumerate().map(energy).sum()
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let state = |(k, body): (usize, &PlanarBody)| {
            let (sine, cosine) = (position[3 * k + 2] / 2.0).sin_cos();
            BodyState {
                name: body.name().to_string(),
                position: [position[3 * k], 0.0, position[3 * k + 1]],
                orientation: [cosine, 0.0, sine, 0.0],
                linear_velocity: [velocity[3 * k], 0.0, velocity[3 * k + 1]],
                angular_velocity: [0.0, velocity[3 * k + 2], 0.0],
            }
        };
        self.bodies.iter().enumerate().map(state).collect()
    }
}

#[cfg(test)]
mod tests;
