//! Drake's discrete contact: four laws at the contacts with φ < 0, one way to move on.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r(v⁺) ,     q⁺ = q + h v⁺ ,     contacts with φ(q) < 0
//!     w = ‖H_i diag(M)⁻¹ H_iᵀ‖_F / 3          a contact's response, from the diagonal of M in the mechanism's own velocities
//! ```
//! [`DrakeSap`] is the associated cone law with compliance; [`DrakeSimilar`] and [`DrakeLagged`] follow Hunt and Crossley with friction
//! regularised so that the step stays convex, and [`DrakeTamsi`] with friction that follows its own normal impulse, which is not.
//! w depends on the velocities M is written in. Drake writes a free body's in world axes
//! ([`SphereBodies`](moreau_dynamics::mechanics::SphereBodies)).
//!
//! # Source
//! Drake 1.51's `DiscreteContactApproximation`; the papers are named with each law.

use moreau_contact::certificate::StepResidual;
use moreau_contact::problem::Solution;
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::schemes::waist::{Parts, step_in_parts};
use moreau_dynamics::schemes::{OwnAnswer, Scheme, Start, Step, StepContext, StepProblem, assembly};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

mod hunt_crossley;
mod lagged;
pub mod primal_newton;
pub mod replay;
mod sap;
pub mod semi_analytic_primal;
mod similar;
mod tamsi;

pub use hunt_crossley::Touch;
pub use lagged::DrakeLagged;
pub use sap::DrakeSap;
pub use semi_analytic_primal::SemiAnalyticPrimal;
pub use similar::DrakeSimilar;
pub use tamsi::{DrakeTamsi, law as tamsi_law};

/// σ = R_t/w of SAP, which also widens the stiction tolerance of Similar and Lagged.
pub const SIGMA: f64 = 0.001;

/// The material of a pair of bodies; each law takes what it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// k \[N/m\].
    pub stiffness: f64,
    /// τ \[s\], of SAP.
    pub relaxation_time: f64,
    /// d \[s/m\], of Hunt and Crossley.
    pub dissipation: f64,
    /// v_s \[m/s\], of regularised friction.
    pub stiction_tolerance: f64,
}

impl Default for Material {
    /// k = 1e5 N/m, no dissipation, v_s = 1 mm/s.
    fn default() -> Self {
        Material { stiffness: 1e5, relaxation_time: 0.0, dissipation: 0.0, stiction_tolerance: 0.001 }
    }
}

/// The names of the four laws on the command line.
pub const NAMES: [&str; 4] = ["drake-sap", "drake-similar", "drake-lagged", "drake-tamsi"];

/// The scheme of Drake's law with this name, one of [`NAMES`].
///
/// # Errors
/// [`Error::Invalid`] for another name, or a material that is none.
pub fn by_name(name: &str, material: Material) -> Result<Box<dyn Scheme>> {
    material.validate()?;
    match name {
        "drake-sap" => Ok(Box::new(DrakeSap { material })),
        "drake-similar" => Ok(Box::new(DrakeSimilar { material })),
        "drake-lagged" => Ok(Box::new(DrakeLagged { material })),
        "drake-tamsi" => Ok(Box::new(DrakeTamsi { material })),
        _ => Err(Error::invalid("scheme", format!("`{name}` is unknown"), format!("use one of {}", NAMES.join(", ")))),
    }
}

impl Material {
    /// Checks the signs.
    ///
    /// # Errors
    /// [`Error::Invalid`] if k or v_s is not positive, τ or d negative, or a number not finite.
    pub fn validate(&self) -> Result<()> {
        let Material { stiffness, relaxation_time, dissipation, stiction_tolerance } = *self;
        for (field, value) in [("stiffness", stiffness), ("stiction tolerance", stiction_tolerance)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        for (field, value) in [("relaxation time", relaxation_time), ("dissipation", dissipation)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a number ≥ 0"));
            }
        }
        Ok(())
    }
}

/// w \[1/kg\] of the contact with these rows of H.
fn response(mass: &DMatrix<f64>, rows: &DMatrix<f64>) -> f64 {
    let inverse = DMatrix::from_diagonal(&mass.diagonal().map(|m| 1.0 / m));
    (rows * inverse * rows.transpose()).norm() / 3.0
}

/// An answer with Drake's measure of it, ‖D(M(v⁺ − v_free) − Hᵀr)‖ relative to its larger term, D = diag(M)^(−½).
fn own_answer(solution: Solution, relative: f64) -> OwnAnswer {
    let residual =
        StepResidual { rule: "step of the regularised law", residual: "momentum", relative, limit: CERTIFY, contact: None, pair: None };
    OwnAnswer { solution, residual: Some(residual) }
}

/// The step of a law that is no relation K ∋ r ⟂ y ∈ K*: explicit forces, the contacts with φ < 0, and the law's own `answer`.
fn step_touching(start: &Start, answer: &dyn Fn(&StepContext, &StepProblem) -> Result<Option<OwnAnswer>>) -> Result<Step> {
    let assemble = |at: &StepContext| Ok(assembly::held(at, 0.0, |candidate| candidate.contact.gap < 0.0)?.0);
    let advance =
        |at: &StepContext, _: &StepProblem, velocity: &DVector<f64>| Ok(at.mechanism.integrate(&at.state.position, velocity, at.h));
    step_in_parts(start, &Parts { assemble: &assemble, answer, advance: &advance })
}
