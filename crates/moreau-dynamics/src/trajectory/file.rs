//! The file format `trajectory/1`: what a simulator reports, in SI units and world coordinates.
//!
//! ```json
//! { "schema": "trajectory/1", "scene": { "schema": "scene/1", … },
//!   "engine": { "name": "…", "version": "…", "options": { } }, "time_step": 0.001, "times": [0, …],
//!   "bodies": [ { "name": "ball", "position": [[0, 0, 1], …], "orientation": [[1, 0, 0, 0], …],
//!                 "linear_velocity": [[0, 0, 0], …], "angular_velocity": [[0, 0, 0], …] } ],
//!   "contacts": [ { "sample": 1, "bodies": ["ball", "ground"], "normal": [0, 0, 1], "impulse": [0, 0, 0.01] } ] }
//! ```
//! Sample 0 is t = 0. A contact at sample k carries the impulse summed over (t_{k−1}, t_k], with the normal from the
//! second body to the first and the impulse acting on the first. `steps` holds the worst residual of every step, not of every sample.

use crate::scenes::Scene;
use moreau_contact::files::{read_schema, read_text};
use moreau_exact::Result;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The name that stands for the plane in contacts.
pub(super) const GROUND: &str = "ground";

/// The name and version of the format.
pub const SCHEMA: &str = "trajectory/1";

/// The motion of every body of a scene, as one engine computed it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Trajectory {
    /// Always `trajectory/1`.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: String,
    /// What was simulated.
    pub scene: Scene,
    /// The engine that computed the trajectory.
    pub engine: Producer,
    /// h \[s\], the engine's step; samples may be several steps apart.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub time_step: f64,
    /// t_k \[s\], increasing from 0.
    pub times: Vec<f64>,
    /// One track per body of the scene.
    pub bodies: Vec<BodyTrack>,
    /// Impulses between samples, where known.
    #[serde(default)]
    pub contacts: Vec<ContactRecord>,
    /// How well each step was solved, where the engine certifies its steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<StepResiduals>,
    /// How the file was made, where it was stored; opaque here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub provenance: Option<serde_json::Value>,
}

/// The worst residual of every step, relative to its scale, for an engine that certifies its steps. Sample k ends step k·n.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepResiduals {
    /// Largest relative residual that is accepted.
    pub limit: f64,
    /// One entry per step; null where nothing was solved.
    pub relative: Vec<Option<f64>>,
    /// Whether the step was accepted.
    pub accepted: Vec<bool>,
}

/// The program that computed a trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Engine")]
pub struct Producer {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Everything that was chosen.
    #[serde(default)]
    pub options: serde_json::Map<String, serde_json::Value>,
}

/// The samples of one body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyTrack {
    /// Its name in the scene.
    pub name: String,
    /// Centre of mass \[m\].
    pub position: Vec<[f64; 3]>,
    /// Unit quaternion \[w, x, y, z\].
    pub orientation: Vec<[f64; 4]>,
    /// Velocity of the centre of mass \[m/s\].
    pub linear_velocity: Vec<[f64; 3]>,
    /// \[rad/s\], world frame.
    pub angular_velocity: Vec<[f64; 3]>,
}

/// The impulse between two bodies over the interval that ends at a sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactRecord {
    /// k ≥ 1: the impulse acted during (t_{k−1}, t_k].
    #[schemars(range(min = 1))]
    pub sample: usize,
    /// \[a, b\]; `ground` is the plane.
    pub bodies: [String; 2],
    /// Unit normal from b to a.
    pub normal: [f64; 3],
    /// On a, world frame \[N·s\].
    pub impulse: [f64; 3],
}

impl Trajectory {
    /// Parses and validates the text of a `trajectory/1` file.
    ///
    /// # Errors
    /// [`Error::Invalid`](moreau_exact::Error::Invalid) naming the field, with line and column where it is no JSON, and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        let trajectory: Trajectory = read_schema(text, SCHEMA)?;
        trajectory.validate()?;
        Ok(trajectory)
    }

    /// Reads a `trajectory/1` file.
    ///
    /// # Errors
    /// [`Error::Read`](moreau_exact::Error::Read), or those of [`Trajectory::from_json`] with the file's name.
    pub fn read(file: &Path) -> Result<Self> {
        let text = read_text(file)?;
        Trajectory::from_json(&text).map_err(|error| error.in_file(file))
    }

    /// The text of the file.
    ///
    /// # Errors
    /// [`Error::Invalid`](moreau_exact::Error::Invalid) if the trajectory is not valid: what is written can be read.
    pub fn to_json(&self) -> Result<String> {
        self.validate()?;
        Ok(serde_json::to_string(self)? + "\n")
    }

    /// The same with the ground as the second body of every record that names it: impulse and normal are those of the other one.
    pub fn with_ground_second(mut self) -> Self {
        for contact in self.contacts.iter_mut().filter(|contact| contact.bodies[0] == GROUND) {
            contact.bodies.reverse();
            contact.normal = contact.normal.map(|x| -x);
            contact.impulse = contact.impulse.map(|x| -x);
        }
        self
    }

    /// The track of a body, by name.
    pub fn body(&self, name: &str) -> Option<&BodyTrack> {
        self.bodies.iter().find(|track| track.name == name)
    }
}

impl Producer {
    /// This crate with one of its schemes and solvers.
    pub fn ours(scheme: &str, solver: &str) -> Self {
        let options = [("scheme", scheme), ("solver", solver)].map(|(key, value)| (key.to_string(), value.into()));
        Producer { name: env!("CARGO_PKG_NAME").into(), version: env!("CARGO_PKG_VERSION").into(), options: options.into_iter().collect() }
    }
}

impl BodyTrack {
    pub(super) fn empty(name: &str) -> Self {
        BodyTrack {
            name: name.into(),
            position: Vec::new(),
            orientation: Vec::new(),
            linear_velocity: Vec::new(),
            angular_velocity: Vec::new(),
        }
    }
}
