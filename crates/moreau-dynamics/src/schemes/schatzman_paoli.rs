//! Schatzman and Paoli: the constraint at a mean of the positions after and before, restitution without a velocity law.
//!
//! ```text
//!     M (q⁺ − 2q + q⁻)/h² = F + …   with   φ( (q⁺ + e q⁻)/(1 + e) ) ≥ 0 ,   v = (q − q⁻)/h ,   v⁺ = (q⁺ − q)/h .
//! ```
//! Linearised at q, with q⁺ = q + h v⁺ and q⁻ = q − h v, the constraint is
//! ```text
//!     0 ≤ r_n ⟂ u_n⁺ − e u_n + (1 + e) φ/h ≥ 0 ,       M (v⁺ − v) = h F(q, v) + Hᵀ r ,      q⁺ = q + h v⁺ .
//! ```
//! Two steps in contact one after the other have q⁺ = −e q⁻ each, so that the velocity leaves as −e times the one that came, whatever
//! the steps did to the gap in between: the body dips in by up to h v. With e = 0 this is Stewart–Trinkle's normal law. Friction, which the
//! method of Schatzman and Paoli does not have, is Coulomb's on u_t⁺.
//!
//! Every candidate takes part; one left out because it is out of reach has φ ≥ h max(|u_n|, |u_n⁺|), and so no impulse.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n ((1+e) φ/h − e u_n⁻) − ½ rᵀW r ,      ΔẼ ≤ −Σ r_n ((1+e) φ/h − e u_n⁻) + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! A depth is paid back as speed: −r_n φ/h > 0 where φ < 0 (`moreau::checks::energy_balance`).

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_exact::Result;
use nalgebra::DVector;

/// The scheme of Schatzman and Paoli.
///
/// # Source
/// Chapter §10, row Siconos; Paoli and Schatzman, SIAM J. Numer. Anal. 40 (2002) 702.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchatzmanPaoli;

impl Rules for SchatzmanPaoli {
    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        let restitution = candidate.contact.restitution;
        normal_only((1.0 + restitution) * candidate.contact.gap / h - restitution * candidate.velocity[0], candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Coulomb }
    }
}

impl Scheme for SchatzmanPaoli {
    fn name(&self) -> String {
        "schatzman-paoli".into()
    }

    passes_the_waist!();
}

impl Waist for SchatzmanPaoli {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        assembly::assemble("schatzman-paoli", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact_particle::{Ball, BallState};
    use crate::mechanics::{PointMass, State};
    use crate::schemes::{StewartTrinkle, simulate, step};
    use moreau_contact::solvers::LemkePivoting;
    use moreau_exact::scalar::ratio;
    use nalgebra::dvector;

    #[test]
    fn a_ball_leaves_with_exactly_e_times_its_velocity_after_two_steps_in_contact() {
        let (h, e) = (ratio(1, 10), ratio(1, 2));
        let ball = Ball { mass: ratio(3, 1), gravity: ratio(0, 1), restitution: e.clone() };
        for offset in 1..10 {
            let mut now = BallState { position: ratio(2, 10) + ratio(offset, 100), velocity: ratio(-1, 1) };
            let mut hits = 0;
            for _ in 0..12 {
                let outcome = ball.schatzman_paoli(&now, &h);
                hits += usize::from(outcome.impulse > ratio(0, 1));
                assert!(outcome.motion.position >= -&h, "a dip of at most h v");
                now = outcome.motion;
            }
            assert_eq!((now.velocity, hits), (e.clone(), 2), "offset {offset}");
        }
    }

    #[test]
    fn without_restitution_it_is_stewart_and_trinkle() {
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
        let mut state = State { time: 0.0, position: dvector![0.1], velocity: dvector![0.0] };
        for _ in 0..30 {
            let after = |scheme: &dyn Scheme| step(scheme, &LemkePivoting, &ball, &state, 0.01).expect("a step").state;
            let (one, other) = (after(&SchatzmanPaoli), after(&StewartTrinkle::default()));
            assert_eq!(one, other);
            state = one;
        }
        assert!(state.position[0].abs() <= moreau_exact::tolerance::rounding(8, 0.01), "it rests on the floor");
    }

    #[test]
    fn an_elastic_ball_keeps_to_its_parabolas_within_h_times_its_speed() {
        let (gravity, h) = (9.81, 1.0 / 1024.0);
        let ball = PointMass::ball_on_floor(1.0, gravity, 1.0);
        let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let run = simulate(&SchatzmanPaoli, &LemkePivoting, &ball, start, h, 4096).expect("steps");
        let fall = (2.0 / gravity).sqrt();
        let exact = |time: f64| 1.0 - 0.5 * gravity * ((time + fall) % (2.0 * fall) - fall).powi(2);
        // semi-implicit flight: q is late by ½ h g t per flight, and each of 4 impacts by at most one step: (½·0.9 + 2)·h·speed each
        let speed = (2.0 * gravity).sqrt();
        for sample in &run.samples {
            let error = (sample.position[0] - exact(sample.time)).abs();
            assert!(error <= 5.0 * 2.5 * h * speed, "t = {}: {error}", sample.time);
        }
    }
}
