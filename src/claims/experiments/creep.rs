//! A block of 1 kg that should stick on a 20° slope (μ = 1/2), one contact, under four declared laws: the speed it creeps at.
//!
//! ```text
//!     hard (Coulomb, Anitescu)   v = 0
//!     SAP                        v⁺ = (v + h g_t) R_t/(1 + R_t)                       → R_t h g_t              (∝ h)
//!     MuJoCo, elliptic           v⁺ = v + h (g_t + f) ,  f = −(b v + g_t)/(1 + R_t)   → R_t g_t/b              (no h)
//!     Drake Similar, Lagged      v⁺ = v + h (g_t − μ g_n s/√(1 + s²)) ,  s = v⁺/v_s   → v_s s*, tan α = μ s*/√(1 + s*²)   (no h)
//! ```

use crate::closed_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::mechanics::{PointMass, State};
use crate::schemes::{Anitescu, simulate};
use crate::solvers::Auto;
use crate::{Error, Result};
use nalgebra::dvector;

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.5;
/// v_s of Drake's regularised friction \[m/s\].
const STICTION: f64 = 1.0 / 10_000.0;

/// tan α, α = 20°.
fn slope() -> f64 {
    20f64.to_radians().tan()
}

/// (g_n, g_t) \[m/s²\].
fn loads() -> [f64; 2] {
    let angle = slope().atan();
    [GRAVITY * angle.cos(), GRAVITY * angle.sin()]
}

/// A law of contact that a block creeps under, or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Creeping {
    /// Anitescu's hard relaxation.
    Hard,
    /// Drake's SAP.
    Sap,
    /// MuJoCo's elliptic contact.
    Mujoco {
        /// `impratio`.
        impedance_ratio: u32,
    },
    /// Drake's Similar and Lagged.
    Regularised,
}

impl Creeping {
    /// The name used in findings.
    pub fn name(self) -> String {
        match self {
            Creeping::Hard => "hard relaxation".into(),
            Creeping::Sap => "SAP".into(),
            Creeping::Mujoco { impedance_ratio } => format!("MuJoCo, impratio = {impedance_ratio}"),
            Creeping::Regularised => "Similar and Lagged".into(),
        }
    }

    /// The speed after 2 s from rest \[m/s\] by stepping.
    pub fn stepped(self, h: f64) -> Result<f64> {
        let steps = (2.0 / h).round() as usize;
        let [_, pull] = loads();
        match self {
            Creeping::Hard => hard(h, steps),
            Creeping::Sap => {
                let softness = sap(h).tangential_regularisation();
                Ok((0..steps).fold(0.0, |v, _| (v + h * pull) * softness / (1.0 + softness)))
            }
            Creeping::Mujoco { impedance_ratio } => {
                let (parameters, softness) = mujoco(h, impedance_ratio)?;
                let (_, damping) = parameters.stiffness_and_damping(h);
                let next = |v: f64| v + h * (pull - (damping * v + pull) / (1.0 + softness));
                Ok((0..steps).fold(0.0, |v, _| next(v)))
            }
            Creeping::Regularised => Ok((0..steps).fold(0.0, |v, _| regularised_step(v, h))),
        }
    }

    /// The same in closed form.
    pub fn predicted(self, h: f64) -> Result<f64> {
        let [press, pull] = loads();
        match self {
            Creeping::Hard => Ok(0.0),
            Creeping::Sap => Ok(sap(h).creep_speed(pull)),
            Creeping::Mujoco { impedance_ratio } => mujoco(h, impedance_ratio)?.0.creep_speed(h, 1.0, press, pull),
            Creeping::Regularised => {
                let ratio = slope() / FRICTION;
                Ok(STICTION * ratio / (1.0 - ratio * ratio).sqrt())
            }
        }
    }
}

fn hard(h: f64, steps: usize) -> Result<f64> {
    let block = PointMass::block_on_incline(1.0, GRAVITY, slope().atan(), FRICTION, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
    Ok(simulate(&Anitescu, &Auto, &block, start, h, steps.min(100))?.last().velocity[0])
}

fn sap(h: f64) -> SapContact {
    // one point of 1 kg: w = ‖1‖_F/3 in space
    let diagonal_mean = 3f64.sqrt() / 3.0;
    SapContact { time_step: h, stiffness: 1e6, relaxation_time: 0.1, diagonal_mean, tangential_ratio: TANGENTIAL_RATIO, friction: FRICTION }
}

/// The parameters and R_t at the rest depth.
fn mujoco(h: f64, impedance_ratio: u32) -> Result<(ContactParameters, f64)> {
    let parameters = ContactParameters { impedance_ratio: f64::from(impedance_ratio), ..ContactParameters::default() };
    let depth = parameters.rest_depth(h, 1.0, loads()[0])?;
    let softness = parameters.normal_regularisation(depth, 1.0) / parameters.impedance_ratio;
    if softness > 0.0 { Ok((parameters, softness)) } else { Err(Error::Unsupported("a contact without softness does not creep".into())) }
}

/// The implicit step of regularised friction: the right side falls with v⁺, so bisection down to neighbouring floats finds it.
fn regularised_step(velocity: f64, h: f64) -> f64 {
    let [press, pull] = loads();
    let drag = |v: f64| FRICTION * press * (v / STICTION) / (1.0 + (v / STICTION).powi(2)).sqrt();
    let (mut low, mut high) = (0.0, velocity + h * pull);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if middle < velocity + h * (pull - drag(middle)) { low = middle } else { high = middle }
    }
}
