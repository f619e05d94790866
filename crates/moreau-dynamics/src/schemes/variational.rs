//! The variational integrator: Verlet's discrete Lagrangian, with the time of an elastic impact as one of its unknowns.
//!
//! ```text
//!     L_d(q, q⁺, h) = h (½ v̄ᵀM v̄ − ½ V(q) − ½ V(q⁺)) ,  q⁺ = q ⊕ h v̄ ,        v̄ = v + ½h M⁻¹F(q) ,   v⁺ = v̄ + ½h M⁻¹F(q⁺)
//!     impact after τ, at q̃:   φ(q̃) = 0 ,   M (ṽ⁺ − ṽ⁻) = nᵀr ,   E_d before = E_d after ,   E_d = ½ v̄ᵀM v̄ + ½ V(start) + ½ V(end)
//! ```
//! n is the normal row of H. What makes the action stationary in q̃ and τ is symplectic through the impact. Both parts of the step have one
//! energy E_d, which is not E: an impact of a ball under gravity changes E by m g² h (h − 2τ)/8, up or down.
//!
//! It is a scheme for e = 1 and no friction (μ = 0, or no tangential velocity before and after): an impact with another law is refused, as
//! are two contacts hit at once, whose impulses E_d alone does not decide, and a second impact in one step.
//!
//! # Energy
//! ```text
//!     |ΔE| ≤ h²FᵀM⁻¹F/8   in a step with an impact under a constant force, 0 without:   ΔE = h (h − 2τ) FᵀM⁻¹F/8
//! ```
//! Other forces keep E_d and have no theorem on E (`moreau::checks::energy_balance`).
//!
//! # Source
//! Chapter §8; Fetecau, Marsden, Ortiz and West, *Nonsmooth Lagrangian mechanics and variational collision integrators* (2003).

use super::assembly::stack;
use super::{Certified, Inertia, Scheme, Start, Step, StepContext, StepProblem};
use crate::event_driven::root::falling_root;
use crate::mechanics::{Mechanism, State, afford};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::{Contact, ContactImpulse};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::sync::Arc;

/// Discrete Euler–Lagrange equations with elastic impacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variational;

/// Shares of a step at which impacts are looked for.
const LOOKS: usize = 8;

/// A mechanism whose M is one matrix and whose forces have a potential.
struct Conservative<'a> {
    mechanism: &'a dyn Mechanism,
    inertia: Inertia,
}

/// A part of a step without impact.
struct Part {
    position: DVector<f64>,
    velocity: DVector<f64>,
    /// E_d \[J\].
    energy: f64,
}

/// An impact within a step.
struct Hit {
    contact: usize,
    /// r \[N·s\].
    impulse: f64,
    /// What the root of the discrete energy leaves of it, relative to the larger of E_d and the kinetic energy.
    lost: f64,
}

impl<'a> Conservative<'a> {
    fn new(mechanism: &'a dyn Mechanism, state: &State, h: f64) -> Result<Self> {
        let (q, v) = (&state.position, &state.velocity);
        let conservative = Conservative { mechanism, inertia: Inertia::of(mechanism.mass(q))? };
        if mechanism.mass(&conservative.fly(q, v, h).position) != *conservative.inertia.finite_mass()? {
            return Err(conservative.refuse("one mass matrix for all positions"));
        }
        let (at_rest, moving) = (mechanism.force(q, &(v * 0.0)), mechanism.force(q, v));
        let size = moving.amax() + conservative.inertia.mass().largest() * v.norm_squared();
        if (moving - at_rest).amax() > rounding(16, size) {
            return Err(conservative.refuse("forces that do not depend on the velocity"));
        }
        Ok(conservative)
    }

    fn refuse(&self, what: &str) -> Error {
        Error::Unsupported(format!("{}: variational needs {what}", self.mechanism.name()))
    }

    /// ½h M⁻¹F(q).
    fn kick(&self, position: &DVector<f64>, time: f64) -> DVector<f64> {
        self.inertia.solve(&self.mechanism.force(position, &DVector::zeros(self.inertia.size()))) * (0.5 * time)
    }

    /// Verlet's step.
    fn fly(&self, position: &DVector<f64>, velocity: &DVector<f64>, time: f64) -> Part {
        let mean = velocity + self.kick(position, time);
        let end = self.mechanism.integrate(position, &mean, time);
        let potential = self.mechanism.potential_energy(position) + self.mechanism.potential_energy(&end);
        let energy = 0.5 * (mean.dot(&self.inertia.mass().times(&mean)) + potential);
        Part { velocity: mean + self.kick(&end, time), position: end, energy }
    }

    /// The first contact whose gap falls below zero within `time`, and when.
    fn first_hit(&self, position: &DVector<f64>, velocity: &DVector<f64>, time: f64) -> Result<Option<(usize, f64)>> {
        let before = self.mechanism.contacts(position);
        let watched = |s: f64| -> Result<Vec<f64>> {
            let there = self.mechanism.contacts(&self.fly(position, velocity, s).position);
            if there.len() != before.len() {
                return Err(self.refuse("contact candidates that stay the same over a step"));
            }
            let one = |(start, there): (&Contact, Contact)| match start.gap > 0.0 {
                true => there.gap,
                // a body that leaves a contact is watched for its return
                false if s == 0.0 => (&start.jacobian * velocity)[0],
                false => (there.gap - start.gap + rounding(32, there.gap.abs().max(start.gap.abs()))) / s,
            };
            Ok(before.iter().zip(there).map(one).collect())
        };
        let mut behind = watched(0.0)?;
        for look in 1..=LOOKS {
            let [low, high] = [look - 1, look].map(|part| part as f64 / LOOKS as f64 * time);
            let ahead = watched(high)?;
            let mut first: Option<(usize, f64)> = None;
            for k in (0..before.len()).filter(|&k| ahead[k] < 0.0) {
                let when = if behind[k] < 0.0 { low } else { falling_root(|s| Ok(watched(s)?[k]), low, high)? };
                first = first.filter(|&(_, known)| known <= when).or(Some((k, when)));
            }
            if first.is_some() {
                return Ok(first);
            }
            behind = ahead;
        }
        Ok(None)
    }

    /// n of the contact that is hit, which must be elastic and alone, without friction or without anything for it to act against.
    fn normal(&self, hit: usize, touching: &Part, scale: f64) -> Result<DVector<f64>> {
        let contacts = self.mechanism.contacts(&touching.position);
        let approaches = |k: usize| contacts[k].gap <= rounding(64, scale) && (&contacts[k].jacobian * &touching.velocity)[0] < 0.0;
        if (0..contacts.len()).any(|k| k != hit && approaches(k)) {
            return Err(self.refuse("one contact at a time, because its energy decides one impulse only"));
        }
        let Some(contact) = contacts.get(hit) else {
            return Err(self.refuse("contact candidates that stay the same over a step"));
        };
        let normal = contact.jacobian.row(0).transpose();
        let thrown = self.inertia.solve(&normal);
        let slides = |motion: &DVector<f64>| (&contact.jacobian * motion).iter().skip(1).any(|u| u.abs() > rounding(64, motion.amax()));
        let rubs = contact.friction != 0.0 && (slides(&touching.velocity) || slides(&thrown));
        if contact.restitution != 1.0 || rubs {
            let found = format!("e = 1 and no friction at {}: e = {}, μ = {}", contact.label(), contact.restitution, contact.friction);
            return Err(self.refuse(&found));
        }
        Ok(normal)
    }

    /// r \[N·s\] along the normal row that keeps E_d over the rest of the step.
    fn impulse(&self, touching: &Part, normal: &DVector<f64>, rest: f64) -> Result<f64> {
        let thrown = self.inertia.solve(normal);
        let plastic = -normal.dot(&touching.velocity) / normal.dot(&thrown);
        let kept = |impulse: f64| {
            let after = self.fly(&touching.position, &(&touching.velocity + &thrown * impulse), rest);
            Ok(touching.energy - after.energy)
        };
        // twice the plastic impulse reverses the speed; four times leaves with thrice of it, more than any E_d of a small step allows
        let most = 4.0 * plastic;
        if plastic <= 0.0 || kept(plastic)? < 0.0 || kept(most)? >= 0.0 {
            let reason = "no impulse keeps the discrete energy: the contact is grazed within the step; take a smaller step";
            return Err(Error::breakdown("variational", format!("{}: {reason}", self.mechanism.name())));
        }
        falling_root(kept, plastic, most)
    }

    /// The step, and the contact that was hit.
    fn step(&self, state: &State, h: f64) -> Result<(Part, Option<Hit>)> {
        let Some((hit, time)) = self.first_hit(&state.position, &state.velocity, h)? else {
            return Ok((self.fly(&state.position, &state.velocity, h), None));
        };
        let touching = self.fly(&state.position, &state.velocity, time);
        let normal = self.normal(hit, &touching, state.position.amax() + h * state.velocity.amax())?;
        let impulse = self.impulse(&touching, &normal, h - time)?;
        let leaving = &touching.velocity + self.inertia.solve(&normal) * impulse;
        if h > time && self.first_hit(&touching.position, &leaving, h - time)?.is_some() {
            return Err(self.refuse("a step with at most one impact; take a smaller step"));
        }
        let after = self.fly(&touching.position, &leaving, h - time);
        let moving = 0.5 * leaving.dot(&self.inertia.mass().times(&leaving));
        let lost = (after.energy - touching.energy).abs() / moving.max(touching.energy.abs());
        Ok((after, Some(Hit { contact: hit, impulse, lost })))
    }
}

impl Scheme for Variational {
    fn name(&self) -> String {
        "variational".into()
    }

    fn step(&self, _solver: &Certified, start: &Start) -> Result<Step> {
        let Start { mechanism, state, h, .. } = *start;
        StepContext::new(mechanism, state, h)?;
        step(mechanism, state, h)
    }
}

fn step(mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<Step> {
    afford(mechanism, &state.position, f64::INFINITY)?;
    let conservative = Conservative::new(mechanism, state, h)?;
    let (Part { position, velocity, .. }, hit) = conservative.step(state, h)?;
    let rows = mechanism.rows_per_contact();
    let contacts = mechanism.contacts(&position);
    let rule = "discrete energy of the impact";
    let judged =
        |hit: &Hit| StepResidual { rule, residual: "energy", relative: hit.lost, limit: CERTIFY, contact: Some(hit.contact), pair: None };
    let residual = hit.as_ref().map(judged);
    let impulses: Vec<ContactImpulse> = hit
        .into_iter()
        .map(|Hit { contact, impulse, .. }| {
            let along = (0..rows).map(|row| if row == 0 { impulse } else { 0.0 }).collect();
            ContactImpulse { contact, impulse: along, place: contacts.get(contact).and_then(|one| one.place) }
        })
        .collect();
    let assembled = StepProblem {
        problem: None,
        residual: None,
        rejected: None,
        active: impulses.iter().map(|one| one.contact).collect(),
        places: impulses.iter().map(|one| one.place).collect(),
        jacobian: stack([].into_iter(), rows, velocity.len()),
        free_velocity: velocity.clone(),
        effective_mass: Arc::new(conservative.inertia),
    };
    let state = State { time: state.time + h, position, velocity };
    Ok(Step { state, impulses, assembled, solution: None, residual, rejected: None, impacts: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{OscillatorWithStop, Plane, PointMass};
    use crate::schemes::{simulate, step};
    use moreau_contact::solvers::Auto;
    use nalgebra::dvector;

    fn at(position: f64, velocity: f64) -> State {
        State { time: 0.0, position: dvector![position], velocity: dvector![velocity] }
    }

    fn take(mechanism: &dyn Mechanism, from: State, h: f64) -> Result<Step> {
        step(&Variational, &Auto, mechanism, &from, h)
    }

    #[test]
    fn an_impact_changes_the_energy_by_what_the_parabolas_differ_in_and_nothing_else_does() {
        // E_d of a parabola of length τ is E − m g²τ²/8
        let (gravity, h) = (10.0, 0.0625);
        let ball = PointMass::ball_on_floor(2.0, gravity, 1.0);
        let run = simulate(&Variational, &Auto, &ball, at(1.0, 0.0), h, 4000).expect("elastic");
        let mut signs = [0, 0];
        for (pair, impulses) in run.samples.windows(2).zip(&run.impulses) {
            let [height, speed] = [pair[0].position[0], pair[0].velocity[0]];
            let time = (speed + (speed * speed + 2.0 * gravity * height).sqrt()) / gravity;
            let expected = if impulses.is_empty() { 0.0 } else { 2.0 * gravity * gravity * h * (h - 2.0 * time) / 8.0 };
            let gained = ball.energy(&pair[1]) - ball.energy(&pair[0]);
            assert!((gained - expected).abs() <= rounding(1024, 32.0), "{gained} {expected}");
            assert!(pair[1].position[0] >= 0.0);
            signs[usize::from(expected > 0.0)] += usize::from(expected != 0.0);
        }
        assert!(signs[0] > 50 && signs[1] > 50, "impacts early and late in the step: {signs:?}");
    }

    #[test]
    fn a_step_back_undoes_a_step() {
        let spring = OscillatorWithStop::new(2.0, 30.0, 0.0, -0.1, 1.0).expect("valid");
        for velocity in [-2.0, 0.7] {
            let there = take(&spring, at(-0.05, velocity), 0.125).expect("one impact").state;
            let back = take(&spring, State { velocity: -&there.velocity, ..there }, 0.125).expect("one impact").state;
            assert!((back.position[0] + 0.05).abs() <= rounding(1024, 1.0) && (back.velocity[0] + velocity).abs() <= rounding(1024, 8.0));
        }
    }

    #[test]
    fn friction_is_no_matter_where_nothing_slides() {
        let thrown = |sideways: f64| {
            let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 1.0).expect("a plane");
            let ball = PointMass::new("ball", 1.0, dvector![0.0, 0.0, -10.0], vec![ground]).expect("valid");
            let start = State { time: 0.0, position: dvector![0.0, 0.0, 0.1], velocity: dvector![sideways, 0.0, -2.0] };
            take(&ball, start, 0.1)
        };
        assert!(thrown(0.0).expect("straight down").impulses[0].impulse[0] > 0.0);
        assert!(thrown(0.1).expect_err("sliding").to_string().contains("friction"));
    }

    #[test]
    fn what_it_does_not_describe_is_refused() {
        let refused = |mechanism: &dyn Mechanism, from: State, h: f64| take(mechanism, from, h).expect_err("outside its scope").to_string();
        assert!(refused(&PointMass::ball_on_floor(1.0, 10.0, 0.5), at(0.01, -2.0), 0.1).contains("e = 1"));
        let damped = OscillatorWithStop::new(2.0, 30.0, 0.4, -0.1, 1.0).expect("valid");
        assert!(refused(&damped, at(0.3, -1.0), 0.1).contains("velocity"));
        let hopping = PointMass::ball_on_floor(1.0, 10.0, 1.0);
        assert!(refused(&hopping, at(0.01, 0.0), 1.0).contains("smaller"));
    }
}
