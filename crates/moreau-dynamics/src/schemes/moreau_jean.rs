//! Moreau–Jean: impact law at velocity level, contacts chosen by a forecast of the gap.
//!
//! ```text
//!     M (v⁺ − v) = h F_θ + Hᵀ r ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e H v   at active contacts,
//!     q⁺ = q + h (θ v⁺ + (1−θ) v) .
//! ```
//! The gap enters only through the choice of the active contacts, so that choice is part of the scheme. It is taken at its word, as in
//! Siconos: a contact at φ = 0 that rounding lets part at 10⁻¹⁶ m/s is not active under rule B, and falls for one step.
//!
//! # Which force
//! M, H and φ are taken at the start of the step, and so is F: a nonlinear force is explicit, which costs nothing in
//! the order of a scheme that is of first order through impacts anyway and keeps the step a contact problem with a
//! constant matrix. A linear part −K q − C v may be stiff, so it is evaluated at the step's own intermediate point,
//! ```text
//!     v_θ = θ v⁺ + (1−θ) v ,   q_θ = q + h θ v_θ ,   F_θ = F(q, v) − C (v_θ − v) − K (q_θ − q) .
//! ```
//! Collecting v⁺ − v on the left gives M̂ (v⁺ − v_free) = Hᵀ r with
//! ```text
//!     M̂ = M(q) + h θ C + h² θ² K ,      v_free = v + h M̂⁻¹ (F(q, v) − h θ K v) .
//! ```
//! Without contact θ = ½ is the implicit midpoint rule of a linear system, and θ = 0 is explicit.
//!
//! # Energy
//! ```text
//!     T̂(v⁺) ≤ T̂(v_free) − r·(e u⁻) − ½ rᵀŴ r ,      ΔẼ ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8 + e/(1+e) r·(u_g − u⁻) ,   Ẽ = T + V + (θ−½) h F·v
//! ```
//! u⁻ is the normal part or the full vector. The first holds always: e = 0 never exceeds T(v_free). The second is the gain of discretised
//! gravity, for one e at all contacts without friction, with e = 0, or with the full vector; u_g = H v_g is the velocity after torque-free
//! rotation alone. Unequal e, and e > 0 on normals beside friction, have no bound on the total energy. With linear forces M̂ and v_free − v
//! take the places of M and h M⁻¹F (`moreau::checks::energy_balance`).

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_contact::contact::Components;
use moreau_contact::memory::spare::{Lent, Spare};
use moreau_contact::problem::Law;
use moreau_exact::{Error, Result};
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

    /// λ of the common form φ + λ h u ≤ 0.
    pub fn forecast(self) -> f64 {
        match self {
            Activation::Gap => 0.0,
            Activation::HalfStepForecast => 0.5,
            Activation::FreeVelocityForecast => 1.0,
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

    fn shift(&self, candidate: &Candidate, _h: f64) -> Components {
        let Candidate { contact, velocity, .. } = candidate;
        match self.restitution {
            RestitutionRule::NormalOnly => normal_only(velocity[0] * contact.restitution, velocity.len()),
            RestitutionRule::FullVector => velocity.iter().map(|u| u * contact.restitution).collect(),
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

    passes_the_waist!();
}

impl Waist for MoreauJean {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        self.validate()?;
        assembly::assemble("moreau-jean", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let (own, others) = (self.theta, 1.0 - self.theta);
        let mut mean = Lent::from(velocity_post.copied());
        mean.zip_apply(&state.velocity, |after, before| *after = *after * own + before * others);
        at.mechanism().integrate(&at.state().position, &mean, h)
    }
}

impl Activation {
    /// The rule with this name.
    ///
    /// # Errors
    /// An unknown name; the message lists the known ones.
    pub fn by_name(name: &str) -> Result<Self> {
        let names = Self::ALL.map(Self::name);
        Self::ALL.into_iter().find(|rule| rule.name() == name).ok_or_else(|| unknown("activation", name, &names))
    }
}

impl RestitutionRule {
    /// The rule with this name.
    ///
    /// # Errors
    /// An unknown name; the message lists the known ones.
    pub fn by_name(name: &str) -> Result<Self> {
        let names = Self::ALL.map(Self::name);
        Self::ALL.into_iter().find(|rule| rule.name() == name).ok_or_else(|| unknown("restitution rule", name, &names))
    }
}

fn unknown(field: &str, name: &str, known: &[&str]) -> Error {
    Error::invalid(field, format!("`{name}` is unknown"), format!("use one of {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{Mechanism, OscillatorWithStop, PointMass, State};
    use crate::schemes::step;
    use moreau_contact::solvers::ProjectedGaussSeidel;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn scheme(theta: f64, restitution: RestitutionRule) -> MoreauJean {
        MoreauJean { theta, activation: Activation::Gap, restitution }
    }

    fn at(position: DVector<f64>, velocity: DVector<f64>) -> State {
        State { time: 0.0, position, velocity }
    }

    #[test]
    fn the_midpoint_oscillator_conserves_its_energy_at_any_step() {
        let free = OscillatorWithStop::new(2.0, 50.0, 0.0, -10.0, 0.5).expect("valid");
        let mut state = at(dvector![1.0], dvector![0.0]);
        let energy = free.energy(&state);
        for h in [0.01, 0.3, 5.0] {
            let next = step(&scheme(0.5, RestitutionRule::NormalOnly), &ProjectedGaussSeidel::default(), &free, &state, h);
            state = next.expect("no contact").state;
            let lost = free.energy(&state) - energy;
            // ½v² and ½kq² have condition number two in v and q, each the result of fewer than 32 operations.
            assert!(lost.abs() <= rounding(3 * 2 * 32, energy), "h = {h}: energy changed by {lost}");
        }
    }

    #[test]
    fn a_stiff_damper_needs_no_small_step_when_theta_is_one() {
        let (mass, damping, h) = (1.0, 1e6, 0.1);
        let damped = OscillatorWithStop::new(mass, 0.0, damping, -10.0, 0.0).expect("valid");
        let next = step(
            &scheme(1.0, RestitutionRule::NormalOnly),
            &ProjectedGaussSeidel::default(),
            &damped,
            &at(dvector![0.0], dvector![1.0]),
            h,
        );
        let velocity = next.expect("no contact").state.velocity[0];
        assert!((velocity - mass / (mass + h * damping)).abs() <= rounding(8, 1.0), "v = {velocity}");
    }

    #[test]
    fn full_vector_restitution_reverses_the_tangential_velocity_too() {
        let wall = PointMass::block_on_incline(1.0, 0.0, 0.0, 10.0, 0.5);
        let before = at(dvector![0.0, 0.0], dvector![1.0, -1.0]);
        let after = |rule| {
            let next = step(&scheme(0.5, rule), &ProjectedGaussSeidel::default(), &wall, &before, 0.1);
            next.expect("one contact").state.velocity
        };
        // μ = 10 sticks: the tangential velocity becomes 0 with the normal rule and −e v_t with Moreau's.
        assert!((after(RestitutionRule::NormalOnly) - dvector![0.0, 0.5]).amax() <= rounding(64, 1.0));
        assert!((after(RestitutionRule::FullVector) - dvector![-0.5, 0.5]).amax() <= rounding(64, 1.0));
    }

    #[test]
    fn each_rule_activates_on_its_side_of_its_own_boundary() {
        let (v, free, h) = (-1.0, -3.0, 0.5);
        for (rule, edge) in [(Activation::Gap, 0.0), (Activation::HalfStepForecast, 0.25), (Activation::FreeVelocityForecast, 1.5)] {
            assert!(rule.is_active(edge, v, free, h));
            assert!(!rule.is_active(edge.next_up(), v, free, h));
        }
    }

    #[test]
    fn a_theta_outside_the_unit_interval_is_refused() {
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.5);
        for theta in [-0.1, 1.1, f64::NAN] {
            let state = at(dvector![1.0], dvector![0.0]);
            let refused = scheme(theta, RestitutionRule::NormalOnly).assemble(&StepContext::new(&ball, &state, 0.1).expect("valid"));
            assert!(refused.expect_err("refused").to_string().contains("theta"));
        }
    }

    #[test]
    fn every_rule_is_found_by_its_name() {
        for rule in Activation::ALL {
            assert_eq!(Activation::by_name(rule.name()).expect("a listed name"), rule);
        }
        for rule in RestitutionRule::ALL {
            assert_eq!(RestitutionRule::by_name(rule.name()).expect("a listed name"), rule);
        }
        assert!(Activation::by_name("c").expect_err("refused").to_string().contains("free-velocity-forecast"));
    }
}
