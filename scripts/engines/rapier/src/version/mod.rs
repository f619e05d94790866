//! What differs between the versions of Rapier: one file each, all with the same items.
//!
//! ```text
//! rapier            the engine's crate
//! VERSION           as published
//! PRECISION         double or single
//! PARAMETERS        the physical settings of the contact model, with their units
//! own_defaults      the settings this version has beyond the common ones
//! apply             … and how they go into its parameters
//! reports_contacts  whether the impulses of a step can be read off completely
//! Extra             what the world needs beyond the common parts, if anything
//! World::step, World::contacts, World::lost_a_body
//! ```

#[cfg(not(any(feature = "v0_36", feature = "v0_35_beta", feature = "v0_34")))]
compile_error!("choose a version of Rapier: --features v0_36, v0_35_beta or v0_34");
#[cfg(any(
    all(feature = "v0_36", feature = "v0_35_beta"),
    all(feature = "v0_36", feature = "v0_34"),
    all(feature = "v0_35_beta", feature = "v0_34")
))]
compile_error!("choose one version of Rapier; the others need --no-default-features");

#[cfg(not(feature = "v0_35_beta"))]
mod impulses;
#[cfg(feature = "v0_34")]
mod v0_34;
#[cfg(feature = "v0_35_beta")]
mod v0_35_beta;
#[cfg(feature = "v0_36")]
mod v0_36;

#[cfg(feature = "v0_34")]
use v0_34 as this;
#[cfg(feature = "v0_35_beta")]
use v0_35_beta as this;
#[cfg(feature = "v0_36")]
use v0_36 as this;

pub use this::{PARAMETERS, PRECISION, VERSION, rapier, reports_contacts};

use crate::options::Settings;
use crate::simulate::PairTable;
use rapier::dynamics::FrictionModel;
use rapier::prelude::*;
use serde_json::{Map, Value, json};

pub type Real = rapier::math::Real;

/// Half the width of the ground where it is a box, in units of length.
const GROUND_EXTENT: f64 = 50.0;

/// Whether the engine's numbers can hold this one.
pub fn representable(number: f64) -> bool {
    (number as Real).is_finite() && (number == 0.0 || (number as Real) != 0.0)
}

/// The same vector in the engine's precision.
pub fn vector(array: [f64; 3]) -> Vector {
    let [x, y, z] = array.map(|x| x as Real);
    Vector::new(x, y, z)
}

/// The direction of a vector, of length 1 in the engine's precision.
pub fn unit_vector(array: [f64; 3]) -> Vector {
    vector(array).normalize()
}

/// The same vector in double precision.
pub fn array(vector: Vector) -> [f64; 3] {
    [vector.x, vector.y, vector.z].map(f64::from)
}

/// The shortest decimal that the engine reads as its own number.
fn decimal(number: Real) -> f64 {
    number.to_string().parse().expect("Rust reads what it writes")
}

/// Rapier's own settings, for lengths in this unit.
pub fn defaults(length_unit: f64) -> Map<String, Value> {
    let own = IntegrationParameters::default();
    let length = |normalized: Real| json!(decimal(normalized) * length_unit);
    let body = RigidBodyBuilder::dynamic();
    let mut settings = json!({
        "friction_model": if own.friction_model == FrictionModel::Coulomb { "Coulomb" } else { "Simplified" },
        "solver_iterations": own.num_solver_iterations,
        "internal_pgs_iterations": own.num_internal_pgs_iterations,
        "stabilization_iterations": own.num_internal_stabilization_iterations,
        "warmstart_coefficient": decimal(own.warmstart_coefficient),
        "max_ccd_substeps": 0,
        "gyroscopic_forces": body.gyroscopic_forces_enabled,
        "length_unit": length_unit,
        "ground_shape": "halfspace",
        "ground_extent": GROUND_EXTENT * length_unit,
        "contact_frequency": decimal(own.contact_softness.natural_frequency),
        "contact_damping_ratio": decimal(own.contact_softness.damping_ratio),
        "max_corrective_velocity": length(own.normalized_max_corrective_velocity),
        "prediction_distance": length(own.normalized_prediction_distance),
    });
    let settings = settings.as_object_mut().expect("an object");
    settings.extend(this::own_defaults(&own, length));
    std::mem::take(settings)
}

/// The engine's parameters for these settings.
pub fn parameters(settings: &Settings, time_step: f64) -> IntegrationParameters {
    let number = |name: &str| settings.number(name) as Real;
    let normalized = |name: &str| (settings.number(name) / settings.number("length_unit")) as Real;
    let mut parameters = IntegrationParameters {
        dt: time_step as Real,
        length_unit: number("length_unit"),
        num_solver_iterations: settings.count("solver_iterations"),
        num_internal_pgs_iterations: settings.count("internal_pgs_iterations"),
        num_internal_stabilization_iterations: settings.count("stabilization_iterations"),
        warmstart_coefficient: number("warmstart_coefficient"),
        max_ccd_substeps: settings.count("max_ccd_substeps"),
        normalized_max_corrective_velocity: normalized("max_corrective_velocity"),
        normalized_prediction_distance: normalized("prediction_distance"),
        friction_model: if settings.coulomb() { FrictionModel::Coulomb } else { FrictionModel::Simplified },
        ..IntegrationParameters::default()
    };
    parameters.contact_softness.natural_frequency = number("contact_frequency");
    parameters.contact_softness.damping_ratio = number("contact_damping_ratio");
    this::apply(settings, number, normalized, &mut parameters);
    parameters
}

/// Everything one simulation needs; each request makes its own.
pub struct World {
    gravity: Vector,
    parameters: IntegrationParameters,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    narrow_phase: NarrowPhase,
    pub bodies: RigidBodySet,
    colliders: ColliderSet,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    ccd_solver: CCDSolver,
    hooks: Hooks,
    #[cfg(not(feature = "v0_35_beta"))]
    extra: this::Extra,
}

impl World {
    /// An empty world.
    pub fn new(parameters: IntegrationParameters, gravity: Vector, pairs: PairTable) -> Self {
        World {
            gravity,
            parameters,
            pipeline: PhysicsPipeline::new(),
            islands: IslandManager::new(),
            broad_phase: DefaultBroadPhase::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            impulse_joints: ImpulseJointSet::new(),
            multibody_joints: MultibodyJointSet::new(),
            ccd_solver: CCDSolver::new(),
            hooks: Hooks(pairs),
            #[cfg(not(feature = "v0_35_beta"))]
            extra: this::Extra::default(),
        }
    }

    /// Adds a body with its shape.
    pub fn insert(&mut self, body: RigidBody, collider: Collider) -> RigidBodyHandle {
        let handle = self.bodies.insert(body);
        self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        handle
    }
}

/// Gives the pairs that have their own coefficients these.
struct Hooks(PairTable);

impl Hooks {
    fn coefficients(&self, colliders: &ColliderSet, a: ColliderHandle, b: ColliderHandle) -> Option<(Real, Real)> {
        self.0.get(colliders[a].user_data, colliders[b].user_data)
    }
}

impl PhysicsHooks for Hooks {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        if let Some((friction, restitution)) = self.coefficients(context.colliders, context.collider1, context.collider2) {
            this::set_coefficients(context, friction, restitution);
        }
    }
}
