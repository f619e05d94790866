//! Moreau–Jean: impact law at velocity level, contacts chosen by a forecast of the gap.
//!
//! ```text
//!     M̂ (v⁺ − v) = h F_θ + Hᵀ r ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e H v   at active contacts,
//!     q⁺ = q + h (θ v⁺ + (1−θ) v) .
//! ```
//! The gap enters only through the choice of the active contacts, so that choice is part of the scheme.

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepProblem};
use crate::mechanics::{Mechanism, State};
use crate::problem::Law;
use crate::{Error, Result};
use nalgebra::DVector;

/// When a contact takes part in the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activation {
    /// Rule A: φ ≤ 0.
    Gap,
    /// Rule B: φ + ½ h u_n ≤ 0 with u_n at the start of the step (what the Siconos code does).
    HalfStepForecast,
    /// Rule D: φ + h u_free,n ≤ 0 (chapter §12).
    FreeVelocityForecast,
}

impl Activation {
    /// Every rule that is a scheme; φ + h u_n ≤ 0 together with u_n ≤ 0 is not one, it lets the ball sink.
    pub const ALL: [Activation; 3] = [Activation::Gap, Activation::HalfStepForecast, Activation::FreeVelocityForecast];

    /// The name used on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Activation::Gap => "gap",
            Activation::HalfStepForecast => "half-step-forecast",
            Activation::FreeVelocityForecast => "free-velocity-forecast",
        }
    }

    fn is_active(self, gap: f64, velocity: f64, free_velocity: f64, h: f64) -> bool {
        match self {
            Activation::Gap => gap <= 0.0,
            Activation::HalfStepForecast => gap + 0.5 * h * velocity <= 0.0,
            Activation::FreeVelocityForecast => gap + h * free_velocity <= 0.0,
        }
    }
}

/// Which components of the contact velocity the restitution coefficient reverses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestitutionRule {
    /// Newton: y_n = u_n⁺ + e u_n⁻, y_t = u_t⁺.
    NormalOnly,
    /// Moreau: y = u⁺ + e u⁻ in every component, which is dissipative with friction as well.
    FullVector,
}

impl RestitutionRule {
    /// Both rules.
    pub const ALL: [RestitutionRule; 2] = [RestitutionRule::NormalOnly, RestitutionRule::FullVector];

    /// The name used on the command line.
    pub fn name(self) -> &'static str {
        match self {
            RestitutionRule::NormalOnly => "normal-only",
            RestitutionRule::FullVector => "full-vector",
        }
    }
}

/// The Moreau–Jean θ scheme.
///
/// # Source
/// Chapter §3 and §12; Jean, *The non-smooth contact dynamics method* (1999).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoreauJean {
    /// θ ∈ \[0, 1\] of the position update and of linear forces.
    pub theta: f64,
    /// Which contacts take part.
    pub activation: Activation,
    /// What e acts on.
    pub restitution: RestitutionRule,
}

impl Default for MoreauJean {
    fn default() -> Self {
        MoreauJean { theta: 0.5, activation: Activation::HalfStepForecast, restitution: RestitutionRule::NormalOnly }
    }
}

impl MoreauJean {
    /// Checks θ.
    ///
    /// # Errors
    /// If θ is not in \[0, 1\].
    pub fn validate(&self) -> Result<()> {
        if (0.0..=1.0).contains(&self.theta) {
            return Ok(());
        }
        Err(Error::invalid("theta", format!("is {}", self.theta), "use a number from 0 to 1"))
    }
}

impl Rules for MoreauJean {
    fn theta(&self) -> f64 {
        self.theta
    }

    fn is_active(&self, candidate: &Candidate, h: f64) -> bool {
        self.activation.is_active(candidate.contact.gap, candidate.velocity[0], candidate.free_velocity[0], h)
    }

    fn shift(&self, candidate: &Candidate, _h: f64) -> DVector<f64> {
        let reversed = &candidate.velocity * candidate.contact.restitution;
        match self.restitution {
            RestitutionRule::NormalOnly => normal_only(reversed[0], reversed.len()),
            RestitutionRule::FullVector => reversed,
        }
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Coulomb }
    }
}

impl Scheme for MoreauJean {
    fn name(&self) -> String {
        format!("moreau-jean theta={} activation={} restitution={}", self.theta, self.activation.name(), self.restitution.name())
    }

    fn assemble(&self, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
        self.validate()?;
        assembly::assemble("moreau-jean", self, mechanism, state, h)
    }

    fn advance(&self, mechanism: &dyn Mechanism, state: &State, velocity_post: &DVector<f64>, h: f64) -> DVector<f64> {
        let mean = velocity_post * self.theta + &state.velocity * (1.0 - self.theta);
        mechanism.integrate(&state.position, &mean, h)
    }
}
