//! rapier3d 0.35.0-beta.0.
//!
//! Its sum of a contact's impulses over the substeps begins with the warm start, the last impulse of the step before, and keeps
//! no trace of it. So the impulse of a step cannot be read off.

use super::{Real, World};
use crate::options::Settings;
use crate::recorder::ContactPoint;
use rapier::prelude::*;
pub use rapier_0_35_beta as rapier;
use serde_json::{Map, Value, json};

pub const VERSION: &str = "0.35.0-beta.0";
pub const PRECISION: &str = "single";

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

pub fn reports_contacts(_settings: &Settings) -> bool {
    false
}

pub fn set_coefficients(context: &mut ContactModificationContext, friction: Real, restitution: Real) {
    (*context.friction, *context.restitution) = (friction, restitution);
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
            &mut self.ccd_solver,
            &self.hooks,
            &(),
        );
    }

    /// Whether the last step has put a body with a state that is not finite into quarantine.
    pub fn lost_a_body(&self) -> bool {
        !self.pipeline.quarantine().is_empty()
    }

    /// Nothing: see the head of this file.
    pub fn contacts(&self, _tell: impl FnMut(u128, u128, ContactPoint)) {}
}
