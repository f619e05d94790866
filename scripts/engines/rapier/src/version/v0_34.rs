//! rapier3d 0.34.0.
//!
//! Its sum of a contact's impulses over the substeps begins with the warm start, the last impulse of the step before, which is
//! subtracted here. Friction acts along t₁ and t₂ = −n × t₁ with t₁ along the relative velocity of the two centres of mass before
//! the step, projected on the plane; below 1e-4 m/s t₁ = orthonormal(−n). Under `Simplified` only the last substep's friction is
//! kept, so there the impulse of a step cannot be read off.

use super::impulses::{PointImpulse, on_first_body, orthonormal_vector};
use super::{Real, World};
use crate::options::Settings;
use crate::recorder::ContactPoint;
use rapier::prelude::*;
pub use rapier_0_34 as rapier;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

pub const VERSION: &str = "0.34.0";
pub const PRECISION: &str = "single";

/// The slowest tangential velocity that gives the friction basis its direction \[m/s\].
const SLOWEST_DIRECTION: Real = 1.0e-4;

pub const PARAMETERS: &[(&str, &str)] = &[
    ("penetration_allowance", "m"),
    ("contact_frequency", "1/s"),
    ("contact_damping_ratio", "1"),
    ("max_corrective_velocity", "m/s"),
    ("prediction_distance", "m"),
    ("ground_extent", "m"),
];

pub fn own_defaults(own: &IntegrationParameters, length: impl Fn(Real) -> Value) -> Map<String, Value> {
    Map::from_iter([("penetration_allowance".to_string(), length(own.normalized_allowed_linear_error))])
}

pub fn apply(
    _settings: &Settings,
    _number: impl Fn(&str) -> Real,
    normalized: impl Fn(&str) -> Real,
    parameters: &mut IntegrationParameters,
) {
    parameters.normalized_allowed_linear_error = normalized("penetration_allowance");
}

pub fn reports_contacts(settings: &Settings) -> bool {
    settings.coulomb()
}

/// The velocities before the step, by the number of the body.
#[derive(Default)]
pub struct Extra {
    velocities: BTreeMap<u128, Vector>,
}

pub fn solver_manifolds(pair: &ContactPair) -> &[ContactManifold] {
    &pair.manifolds
}

/// The manifold's point that a contact of the solver stands for.
pub fn index_of(contact: &SolverContact) -> usize {
    contact.contact_id[0] as usize
}

pub fn set_coefficients(context: &mut ContactModificationContext, friction: Real, restitution: Real) {
    for contact in context.solver_contacts.iter_mut() {
        (contact.friction, contact.restitution) = (friction, restitution);
    }
}

impl World {
    /// One step of the engine.
    pub fn step(&mut self) {
        let velocity = |collider: &Collider| collider.parent().map_or(Vector::ZERO, |body| self.bodies[body].linvel());
        self.extra.velocities = self.colliders.iter().map(|(_, collider)| (collider.user_data, velocity(collider))).collect();
        self.pipeline.step(
            self.gravity,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.ccd_solver,
            &self.hooks,
            &(),
        );
    }

    /// This version has no quarantine: a state that is not finite shows.
    pub fn lost_a_body(&self) -> bool {
        false
    }

    /// The contact points of the last step, with the numbers of their bodies.
    pub fn contacts(&self, mut tell: impl FnMut(u128, u128, ContactPoint)) {
        for point in self.solved_points() {
            let (a, b) = point.bodies;
            let tangent = tangent(-point.normal, self.extra.velocities[&a] - self.extra.velocities[&b]);
            let friction = point.data.tangent_impulse - point.given.warmstart_tangent_impulse;
            let normal = point.data.impulse - point.given.warmstart_impulse;
            tell(a, b, on_first_body(point.normal, tangent, &PointImpulse { normal, tangent: [friction.x, friction.y] }));
        }
    }
}

/// The first friction direction for the normal direction d.
fn tangent(direction: Vector, relative_velocity: Vector) -> Vector {
    let sliding = relative_velocity - direction * direction.dot(relative_velocity);
    if sliding.length() < SLOWEST_DIRECTION { orthonormal_vector(direction) } else { sliding / sliding.length() }
}
