//! Drake: what the installed package says of itself (stored by the scripts), and a block on the slope it slides down at constant speed.
//!
//! On tan α = μ gravity and friction balance, so that a block slides on at its speed v and settles at one gap φ:
//! ```text
//!     SAP        φ = (h + τ) [μ v − (R_n + μ² R_t) r_n]
//!     Lagged     φ = −m g cos α/k
//! ```

use super::facts::Document;
use crate::mechanics::{PointMass, State};
use crate::schemes::drake::Material;
use crate::schemes::{SchemeParameters, by_name, simulate};
use crate::solvers::SemiAnalyticPrimal;
use crate::stored::{RUNS, read, read_by};
use crate::tolerance::claims::drake::SETTLING_TIME;
use crate::trajectory::Trajectory;
use crate::{Error, Result};
use nalgebra::dvector;
use serde::Deserialize;
use std::collections::BTreeMap;

/// What Drake's own documentation says, in its words.
#[derive(Clone, Debug, Deserialize)]
pub struct Facts {
    /// Which approximations glide.
    pub gliding_of: String,
    /// Which does not.
    pub without_gliding: String,
    /// How often a phrase occurs in the documentation of the plant's module.
    pub mentions: BTreeMap<String, usize>,
}

/// The facts of the pinned release, Drake 1.51.1.
///
/// # Errors
/// If the stored file is not what the script writes.
pub fn facts() -> Result<Facts> {
    Ok(read::<Document<Facts>>(&RUNS, "facts/drake.json")?.stated)
}

/// Material of the sliding block: k = 2000 N/m, τ = 5 ms, d = 10 s/m, and a slip scale of 1 µm/s.
pub const MATERIAL: Material =
    Material { stiffness: 2000.0, relaxation_time: 0.005, dissipation: 10.0, stiction_tolerance: 1.0 / 1_048_576.0 };
/// μ.
pub const FRICTION: f64 = 0.3;
const GRAVITY: f64 = 9.81;

/// φ \[m\] of a block of 1 kg on a contact with this τ that slides at `speed` down the slope tan α = μ, once it has settled.
///
/// # Errors
/// Those of the scheme, and if the block leaves the ground.
pub fn sliding_gap(scheme: &str, relaxation_time: f64, h: f64, speed: f64) -> Result<f64> {
    let material = Material { relaxation_time, ..MATERIAL };
    let scheme = by_name(scheme, SchemeParameters { drake: material, ..SchemeParameters::default() })?;
    let slope = PointMass::block_on_incline(1.0, GRAVITY, FRICTION.atan(), FRICTION, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, -GRAVITY / MATERIAL.stiffness], velocity: dvector![speed, 0.0] };
    let recording = simulate(scheme.as_ref(), &SemiAnalyticPrimal, &slope, start, h, (SETTLING_TIME / h).round() as usize)?;
    let gap = recording.last().position[1];
    if gap < 0.0 { Ok(gap) } else { Err(Error::Unsupported("the block left the ground".into())) }
}

/// How much a slide at 0.7 m/s lifts the block above one at 0.2 m/s \[m\].
///
/// # Errors
/// As [`sliding_gap`].
pub fn lift(scheme: &str, h: f64) -> Result<f64> {
    damped_lift(scheme, MATERIAL.relaxation_time, h)
}

/// [`lift`] on a contact with another τ.
///
/// # Errors
/// As [`sliding_gap`].
pub fn damped_lift(scheme: &str, relaxation_time: f64, h: f64) -> Result<f64> {
    Ok(sliding_gap(scheme, relaxation_time, h, 0.7)? - sliding_gap(scheme, relaxation_time, h, 0.2)?)
}

/// [`lift`] under SAP in closed form, (h + τ) μ Δv \[m\].
pub fn predicted_lift(h: f64) -> f64 {
    predicted_damped_lift(MATERIAL.relaxation_time, h)
}

/// [`damped_lift`] under SAP in closed form \[m\].
pub fn predicted_damped_lift(relaxation_time: f64, h: f64) -> f64 {
    (h + relaxation_time) * FRICTION * (0.7 - 0.2)
}

/// Speed \[m/s\] of the block that should stick at the end of the stored run under SAP, or under Lagged.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn stored_creep(lagged: bool) -> Result<f64> {
    let path = if lagged { "drake/block_stick__lagged__h0.01.json" } else { "drake/block_stick__sap__h0.01.json" };
    let run = read_by(&RUNS, path, Trajectory::from_json)?;
    let last = run.bodies[0].linear_velocity.last().ok_or_else(|| Error::Unsupported("the run has samples".into()))?;
    Ok(last.iter().map(|v| v * v).sum::<f64>().sqrt())
}

/// Depth \[m\] at which a ball of 1 kg on k = 1e5 N/m lies at the end of the stored run, SAP, h = 1 ms.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn rest_depth() -> Result<f64> {
    let run = read_by(&RUNS, "drake/ball_rest__sap__h0.001.json", Trajectory::from_json)?;
    let radius = run.scene.bodies[0].sphere.map_or(0.0, |sphere| sphere.radius);
    let last = run.bodies[0].position.last().ok_or_else(|| Error::Unsupported("the run has samples".into()))?;
    Ok(radius - last[2])
}
