//! rapier3d-f64 0.36.1.
//!
//! A contact point's friction impulse is the sum over the substeps in the basis t₁ = orthonormal(−n), t₂ = −n × t₁. Under
//! `Simplified` only the last substep's friction is kept, so there the impulse of a step cannot be read off.

use super::impulses::{PointImpulse, on_first_body, orthonormal_vector};
use super::{Real, World};
use crate::options::Settings;
use crate::recorder::ContactPoint;
use rapier::prelude::*;
pub use rapier_0_36 as rapier;
use serde_json::{Map, Value, json};

pub const VERSION: &str = "0.36.1";
pub const PRECISION: &str = "double";

/// More than any scene has \[m/s\]. Rapier's own default stops a body at 400 m/s, a fall of eight kilometres.
const NO_SPEED_LIMIT: f64 = 1e10;

pub const PARAMETERS: &[(&str, &str)] = &[
    ("contact_frequency", "1/s"),
    ("contact_damping_ratio", "1"),
    ("ground_contact_frequency", "1/s"),
    ("ground_contact_damping_ratio", "1"),
    ("max_corrective_velocity", "m/s"),
    ("max_linear_velocity", "m/s"),
    ("prediction_distance", "m"),
    ("ground_extent", "m"),
    ("contact_recycle_distance", "m"),
];

pub fn own_defaults(own: &IntegrationParameters, length: impl Fn(Real) -> Value) -> Map<String, Value> {
    let settings = json!({
        "ground_contact_frequency": super::decimal(own.static_contact_softness.natural_frequency),
        "ground_contact_damping_ratio": super::decimal(own.static_contact_softness.damping_ratio),
        "max_linear_velocity": NO_SPEED_LIMIT,
        "contact_recycle_distance": length(own.normalized_contact_recycle_distance),
        "contact_recycling": own.contact_recycling,
        "contact_clustering": own.contact_clustering,
        "friction_in_bias_pass": own.friction_in_bias_pass,
    });
    settings.as_object().expect("an object").clone()
}

pub fn apply(
    settings: &Settings,
    number: impl Fn(&str) -> Real,
    normalized: impl Fn(&str) -> Real,
    parameters: &mut IntegrationParameters,
) {
    parameters.static_contact_softness.natural_frequency = number("ground_contact_frequency");
    parameters.static_contact_softness.damping_ratio = number("ground_contact_damping_ratio");
    parameters.normalized_max_linear_velocity = normalized("max_linear_velocity");
    parameters.normalized_contact_recycle_distance = normalized("contact_recycle_distance");
    parameters.contact_recycling = settings.switch("contact_recycling");
    parameters.contact_clustering = settings.switch("contact_clustering");
    parameters.friction_in_bias_pass = settings.switch("friction_in_bias_pass");
}

pub fn reports_contacts(settings: &Settings) -> bool {
    settings.coulomb()
}

/// What this version's pipeline needs beyond the common parts.
#[derive(Default)]
pub struct Extra {
    soft_bodies: SoftBodySet,
}

pub fn solver_manifolds(pair: &ContactPair) -> &[ContactManifold] {
    pair.solver_manifolds()
}

/// The manifold's point that a contact of the solver stands for.
pub fn index_of(contact: &SolverContact) -> usize {
    contact.contact_indices()[0] as usize
}

pub fn set_coefficients(context: &mut ContactModificationContext, friction: Real, restitution: Real) {
    if let Some(manifold) = context.rigid_mut() {
        (*manifold.friction, *manifold.restitution) = (friction, restitution);
    }
}

impl World {
    /// One step of the engine.
    pub fn step(&mut self) {
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
            &mut self.extra.soft_bodies,
            &mut self.ccd_solver,
            &self.hooks,
            &(),
        );
    }

    /// Whether the last step has put a body with a state that is not finite into quarantine.
    pub fn lost_a_body(&self) -> bool {
        !self.pipeline.quarantine().is_empty()
    }

    /// The contact points of the last step, with the numbers of their bodies.
    pub fn contacts(&self, mut tell: impl FnMut(u128, u128, ContactPoint)) {
        for point in self.solved_points() {
            let tangent = orthonormal_vector(-point.normal);
            let friction = point.data.tangent_impulse;
            let impulse = PointImpulse { normal: point.data.impulse, tangent: [friction.x, friction.y] };
            tell(point.bodies.0, point.bodies.1, on_first_body(point.normal, tangent, &impulse));
        }
    }
}
