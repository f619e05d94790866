//! Anitescu: the cone complementarity step, convex because the friction law is associated.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,   K_μ ∋ r ⟂ u⁺ + (φ/h) n ∈ K_μ* ,   q⁺ = q + h v⁺ .
//! ```
//! The dual cone asks φ/h + u_n⁺ ≥ μ‖u_t⁺‖: a sliding contact keeps the gap φ⁺ ≥ μ h ‖u_t⁺‖.
//! Every contact candidate takes part, for the reason given in [`super::stewart_trinkle`]; all forces are
//! explicit; no restitution.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n φ/h − ½ rᵀW r ,      ΔẼ ≤ −Σ r_n φ/h + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! A depth is paid back as speed: −r_n φ/h > 0 where φ < 0; an open contact that acts takes energy (`moreau::checks::energy_balance`).

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_exact::Result;
use nalgebra::DVector;

/// The cone complementarity scheme of Anitescu.
///
/// # Source
/// Chapter §5; Anitescu, *Optimization-based simulation of nonsmooth rigid multibody dynamics* (2006).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Anitescu;

impl Rules for Anitescu {
    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
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

    fn has_restitution(&self) -> bool {
        false
    }

    passes_the_waist!();
}

impl Waist for Anitescu {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        assembly::assemble("anitescu", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{PointMass, State};
    use crate::schemes::{StewartTrinkle, step};
    use moreau_contact::solvers::{ContactSolver, LemkePivoting, ProjectedGaussSeidel};
    use moreau_contact::tolerance::solvers;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    /// Gap after 40 steps of a block sliding down a slope of 20° with μ = 0.2, and the gap μ h v_t it should have.
    fn slide(scheme: &dyn Scheme, solver: &dyn ContactSolver) -> (f64, f64) {
        let (mu, h) = (0.2, 0.005);
        let mechanism = PointMass::block_on_incline(1.0, 9.81, 20f64.to_radians(), mu, 0.0);
        let mut state = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
        for _ in 0..40 {
            state = step(scheme, solver, &mechanism, &state, h).expect("one contact").state;
        }
        (state.position[1], mu * h * state.velocity[0].abs())
    }

    #[test]
    fn anitescu_sliding_block_lifts_off_by_mu_h_v() {
        let (gap, predicted) = slide(&Anitescu, &ProjectedGaussSeidel::default());
        // The solver stops at a relative natural map of STOP; φ⁺ = h(φ/h + u_n⁺) inherits it once per step.
        assert!(predicted > 0.0 && (gap - predicted).abs() <= 40.0 * solvers::STOP * predicted.max(gap), "{gap} against {predicted}");
    }

    #[test]
    fn stewart_trinkle_sliding_block_stays_on_the_slope() {
        let (gap, predicted) = slide(&StewartTrinkle::default(), &LemkePivoting);
        assert!(predicted > 0.0 && gap.abs() <= rounding(40 * 64, predicted), "{gap}");
    }

    #[test]
    fn a_penetrating_contact_is_pushed_out_within_the_step() {
        // φ = −1/64, h = 1/16: both schemes ask for v⁺ = −φ/h = 1/4 and arrive at q⁺ = 0.
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.5);
        let state = State { time: 0.0, position: dvector![-1.0 / 64.0], velocity: dvector![0.0] };
        for scheme in [&Anitescu as &dyn Scheme, &StewartTrinkle::default()] {
            let next = step(scheme, &ProjectedGaussSeidel::default(), &ball, &state, 1.0 / 16.0).expect("one contact").state;
            assert!((next.velocity[0] - 0.25).abs() <= rounding(8, 1.0) && next.position[0].abs() <= rounding(8, 0.1), "{}", scheme.name());
        }
    }

    #[test]
    fn a_distant_contact_takes_part_without_impulse() {
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
        let state = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let next = step(&Anitescu, &ProjectedGaussSeidel::default(), &ball, &state, 0.01).expect("one contact");
        assert_eq!(next.impulses.len(), 1);
        assert_eq!(&next.impulses[0].impulse[..], [0.0]);
    }
}
