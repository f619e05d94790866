//! Euler's rules with contact: forces at the old state, impulses for the new velocity, positions with the old or with the new one.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e H v   at contacts with φ ≤ 0 ,
//!     explicit:  q⁺ = q + h v          semi-implicit:  q⁺ = q + h v⁺
//! ```
//! All forces are explicit, springs and dampers too: on the undamped spring the explicit rule grows at every step and the semi-implicit
//! one is stable for hω < 2. The step of the explicit rule in which the contact acts still moves by h v into the obstacle.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ e r_n u_n⁻ − ½ rᵀW r ,      ΔẼ ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8 + e/(1+e) r·(u_g − u⁻) ,   Ẽ = E ∓ ½ h F·v
//! ```
//! − explicit, + semi-implicit; the second for one e, and no friction or e = 0, under a constant force. Springs have no theorem here
//! (`moreau::checks::energy_balance`).

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_exact::Result;
use nalgebra::DVector;

/// Which velocity moves the positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Euler {
    /// v, at the start of the step.
    Explicit,
    /// v⁺, at its end.
    SemiImplicit,
}

impl Euler {
    /// The name used on the command line.
    pub fn label(self) -> &'static str {
        match self {
            Euler::Explicit => "explicit-euler",
            Euler::SemiImplicit => "semi-implicit-euler",
        }
    }
}

impl Rules for Euler {
    fn is_active(&self, candidate: &Candidate, _h: f64) -> bool {
        candidate.contact.gap <= 0.0
    }

    fn shift(&self, candidate: &Candidate, _h: f64) -> Components {
        normal_only(candidate.contact.restitution * candidate.velocity[0], candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Coulomb }
    }
}

impl Scheme for Euler {
    fn name(&self) -> String {
        self.label().into()
    }

    passes_the_waist!();
}

impl Waist for Euler {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        assembly::assemble(self.label(), self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let velocity = match self {
            Euler::Explicit => &state.velocity,
            Euler::SemiImplicit => velocity_post,
        };
        at.mechanism().integrate(&at.state().position, velocity, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::{Damping, ExplicitEuler, Method, Phase, SemiImplicitEuler, SpringDamper};
    use crate::mechanics::{Mechanism, OscillatorWithStop, PointMass, State};
    use crate::schemes::step;
    use moreau_contact::solvers::ProjectedGaussSeidel;
    use moreau_exact::scalar::exact;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn after(scheme: Euler, mechanism: &dyn Mechanism, position: f64, velocity: f64, h: f64) -> State {
        let state = State { time: 0.0, position: dvector![position], velocity: dvector![velocity] };
        step(&scheme, &ProjectedGaussSeidel::default(), mechanism, &state, h).expect("a valid step").state
    }

    #[test]
    fn a_free_step_is_that_of_the_integrator() {
        let (mass, stiffness, damping, h) = (2.0, 30.0, 0.5, 0.125);
        let spring = SpringDamper { stiffness_per_mass: exact(stiffness / mass), damping_per_mass: exact(damping / mass) };
        let body = OscillatorWithStop::new(mass, stiffness, damping, -10.0, 0.0).expect("valid");
        let now = Phase::of_one(0.5, -2.0);
        let explicit = ExplicitEuler.step(&spring, &now, &h);
        let semi = SemiImplicitEuler { damping: Damping::Explicit }.step(&spring, &now, &h);
        for (scheme, expected) in [(Euler::Explicit, explicit), (Euler::SemiImplicit, semi)] {
            let reached = after(scheme, &body, 0.5, -2.0, h);
            assert!((reached.velocity - expected.velocity).amax() <= rounding(8, 4.0));
            assert!((reached.position - expected.position).amax() <= rounding(8, 1.0));
        }
    }

    #[test]
    fn the_explicit_rule_moves_on_into_the_floor_and_the_semi_implicit_one_does_not() {
        let ball = PointMass::ball_on_floor(1.0, 0.0, 0.0);
        let reached = |scheme| after(scheme, &ball, 0.0, -2.0, 0.01);
        let (explicit, semi) = (reached(Euler::Explicit), reached(Euler::SemiImplicit));
        assert_eq!([explicit.velocity[0], semi.velocity[0]], [0.0, 0.0]);
        assert_eq!([explicit.position[0], semi.position[0]], [-0.02, 0.0]);
    }
}
