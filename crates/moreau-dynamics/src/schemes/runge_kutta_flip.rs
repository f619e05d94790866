//! The classical Runge–Kutta method with the velocity flipped where a step ends in an obstacle: high order between impacts, none through
//! them.
//!
//! ```text
//!     (q⁺, v_free) = one classical Runge–Kutta step of q̇ = v, M v̇ = F(q, v)
//!     M (v⁺ − v_free) = Hᵀ r ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e H v_free   at contacts with φ(q⁺) ≤ 0
//! ```
//! The impact is late by up to h, so that the error in position is O(h) however small the error between impacts, and a body that
//! comes to rest sinks. On coordinates that are not a vector space (rotations) the order between impacts is two.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ e r_n min(u_free,n, 0) − ½ rᵀW r ,      H and M at q⁺
//! ```
//! A constant force has no error of its own, so that ΔE is what contact does to T; other forces add h⁵, and a body at rest sinks and loses
//! V (`moreau::checks::energy_balance`).
//!
//! # Source
//! Chapter §0, why high order is of no use across impacts.

use super::assembly::stack;
use super::{Inertia, Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use crate::mechanics::{Mechanism, State};
use moreau_contact::contact::pairs;
use moreau_contact::problem::{ContactProblem, Law};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::sync::Arc;

/// Runge–Kutta with a flip at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RungeKuttaFlip;

/// Mean velocity and velocity at the end of a free step \[m/s\].
fn free_step(mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<[DVector<f64>; 2]> {
    let acceleration = |position: &DVector<f64>, velocity: &DVector<f64>| -> Result<DVector<f64>> {
        Ok(Inertia::of(mechanism.mass(position))?.solve(&mechanism.force(position, velocity)))
    };
    let State { position, velocity, .. } = state;
    let first = acceleration(position, velocity)?;
    let second_velocity = velocity + &first * (0.5 * h);
    let second = acceleration(&mechanism.integrate(position, velocity, 0.5 * h), &second_velocity)?;
    let third_velocity = velocity + &second * (0.5 * h);
    let third = acceleration(&mechanism.integrate(position, &second_velocity, 0.5 * h), &third_velocity)?;
    let fourth_velocity = velocity + &third * h;
    let fourth = acceleration(&mechanism.integrate(position, &third_velocity, h), &fourth_velocity)?;
    let mean = (velocity + (second_velocity + third_velocity) * 2.0 + fourth_velocity) / 6.0;
    let end = velocity + (first + (second + third) * 2.0 + fourth) * (h / 6.0);
    if end.iter().chain(mean.iter()).any(|entry| !entry.is_finite()) {
        return Err(Error::invalid("force", "is not finite", "every force and velocity must be a finite number"));
    }
    Ok([mean, end])
}

impl Scheme for RungeKuttaFlip {
    fn name(&self) -> String {
        "runge-kutta-flip".into()
    }

    passes_the_waist!();
}

impl Waist for RungeKuttaFlip {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let [mean, free_velocity] = free_step(mechanism, state, h)?;
        let reached = at.mechanism().integrate(&at.state().position, &mean, h);
        let effective_mass = Arc::new(Inertia::of(mechanism.mass(&reached))?);
        let contacts = mechanism.contacts(&reached);
        let active: Vec<usize> = (0..contacts.len()).filter(|&k| contacts[k].gap <= 0.0).collect();
        let (rows, columns) = (mechanism.rows_per_contact(), mechanism.degrees_of_freedom());
        let jacobian = stack(active.iter().map(|&k| &contacts[k]), rows, columns);
        let mut shift = DVector::zeros(rows * active.len());
        for (place, &k) in active.iter().enumerate() {
            let contact = &contacts[k];
            let arriving = (&contact.jacobian * &free_velocity)[0];
            shift[place * rows] = contact.restitution * arriving.min(0.0);
        }
        let places: Vec<_> = active.iter().map(|&k| contacts[k].place).collect();
        let problem = ContactProblem::from_inertia(&effective_mass, &jacobian, &free_velocity)
            .name(format!("{} runge-kutta-flip t={}", mechanism.name(), state.time))
            .law(if rows == 1 { Law::Frictionless } else { Law::Coulomb })
            .rows_per_contact(rows)
            .friction(active.iter().map(|&k| contacts[k].friction).collect())
            .shift(shift)
            .bodies(pairs(&places))
            .build()?;
        let problem = (!active.is_empty()).then_some(problem);
        Ok(StepProblem { problem, active, places, effective_mass, free_velocity, jacobian, residual: None, rejected: None })
    }

    fn advance(&self, at: &StepContext, _velocity_post: &DVector<f64>) -> DVector<f64> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let [mean, _] = free_step(mechanism, state, h).expect("the step was assembled from the same state");
        at.mechanism().integrate(&at.state().position, &mean, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::{Method, Phase, RungeKutta, SpringDamper};
    use crate::mechanics::{OscillatorWithStop, PointMass};
    use crate::schemes::{simulate, step};
    use moreau_contact::solvers::ProjectedGaussSeidel;
    use moreau_exact::scalar::exact;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn at(position: f64, velocity: f64) -> State {
        State { time: 0.0, position: dvector![position], velocity: dvector![velocity] }
    }

    #[test]
    fn a_free_step_is_that_of_the_integrator() {
        let (mass, stiffness, damping, h) = (2.0, 30.0, 0.5, 0.125);
        let spring = SpringDamper { stiffness_per_mass: exact(stiffness / mass), damping_per_mass: exact(damping / mass) };
        let body = OscillatorWithStop::new(mass, stiffness, damping, -10.0, 0.0).expect("valid");
        let expected = RungeKutta.step(&spring, &Phase::of_one(0.5, -2.0), &h);
        let taken = step(&RungeKuttaFlip, &ProjectedGaussSeidel::default(), &body, &at(0.5, -2.0), h).expect("valid");
        assert!((taken.state.velocity - expected.velocity).amax() <= rounding(64, 8.0));
        assert!((taken.state.position - expected.position).amax() <= rounding(64, 1.0));
    }

    #[test]
    fn the_velocity_is_flipped_at_the_end_of_the_step_and_the_position_left_below() {
        let ball = PointMass::ball_on_floor(1.0, 10.0, 0.5);
        let taken = step(&RungeKuttaFlip, &ProjectedGaussSeidel::default(), &ball, &at(0.1, -2.0), 0.125).expect("valid").state;
        let arrived = -2.0 - 10.0 * 0.125;
        assert!((taken.velocity[0] + 0.5 * arrived).abs() <= rounding(64, 4.0));
        assert!((taken.position[0] - (0.1 - 2.0 * 0.125 - 5.0 * 0.125 * 0.125)).abs() <= rounding(64, 1.0));
    }

    #[test]
    fn a_body_at_rest_sinks_by_half_g_h_squared_a_step() {
        let (ball, h) = (PointMass::ball_on_floor(1.0, 10.0, 0.0), 0.125);
        let end = simulate(&RungeKuttaFlip, &ProjectedGaussSeidel::default(), &ball, at(0.0, 0.0), h, 8).expect("valid");
        assert!((end.last().position[0] + 8.0 * 5.0 * h * h).abs() <= rounding(8 * 64, 1.0));
    }
}
