//! Anitescu: the cone complementarity step, convex because the friction law is associated.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,   K_μ ∋ r ⟂ u⁺ + (φ/h) n ∈ K_μ* ,   q⁺ = q + h v⁺ .
//! ```
//! The dual cone asks φ/h + u_n⁺ ≥ μ‖u_t⁺‖: a sliding contact keeps the gap φ⁺ ≥ μ h ‖u_t⁺‖.
//! Every contact candidate takes part, for the reason given in [`super::stewart_trinkle`]; no restitution.

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepProblem};
use crate::Result;
use crate::mechanics::{Mechanism, State};
use crate::problem::Law;
use nalgebra::DVector;

/// The cone complementarity scheme of Anitescu.
///
/// # Source
/// Chapter §5; Anitescu, *Optimization-based simulation of nonsmooth rigid multibody dynamics* (2006).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Anitescu;

impl Rules for Anitescu {
    fn theta(&self) -> f64 {
        0.0
    }

    fn is_active(&self, _candidate: &Candidate, _h: f64) -> bool {
        true
    }

    fn shift(&self, candidate: &Candidate, h: f64) -> DVector<f64> {
        normal_only(candidate.contact.gap / h, candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Associated }
    }
}

impl Scheme for Anitescu {
    fn name(&self) -> String {
        "anitescu".into()
    }

    fn assemble(&self, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
        assembly::assemble("anitescu", self, mechanism, state, h)
    }

    fn advance(&self, mechanism: &dyn Mechanism, state: &State, velocity_post: &DVector<f64>, h: f64) -> DVector<f64> {
        mechanism.integrate(&state.position, velocity_post, h)
    }
}
