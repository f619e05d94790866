//! The event-driven method behind the interface of the time-stepping schemes: h is the time between samples, not the step of a method.
//!
//! A step of h poses as many impact and force problems as it meets events; see [`crate::event_driven`].
//!
//! # Energy
//! ```text
//!     e = 0, or no friction and one contact:   ΔE ≤ 0   up to the method's tolerances
//! ```
//! Several contacts hit at once with e > 0, and friction beside e > 0, have no theorem (`moreau::checks::energy_balance`).

use super::assembly::stack;
use super::{Certified, Inertia, Scheme, Start, Step, StepProblem};
use crate::event_driven::{Collision, EventDriven};
use crate::trajectory::LocatedImpact;
use moreau_exact::Result;
use std::sync::Arc;

/// Event-driven motion, sampled every h.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Events {
    /// The method.
    pub method: EventDriven,
}

impl Scheme for Events {
    fn name(&self) -> String {
        "event-driven".into()
    }

    fn step(&self, solver: &Certified, start: &Start) -> Result<Step> {
        let Start { mechanism, state, h, .. } = *start;
        let motion = self.method.advance(solver, mechanism, state, h)?;
        let assembled = StepProblem {
            problem: None,
            residual: None,
            rejected: None,
            active: motion.impulses.iter().map(|one| one.contact).collect(),
            places: motion.impulses.iter().map(|one| one.place).collect(),
            jacobian: stack([].into_iter(), mechanism.rows_per_contact(), motion.state.velocity.len()),
            free_velocity: motion.state.velocity.clone(),
            effective_mass: Arc::new(Inertia::of(mechanism.mass(&motion.state.position))?),
        };
        let located = |one: Collision| LocatedImpact { time: state.time + one.elapsed, normal_velocities: one.normal_velocities };
        let impacts = Some(motion.impacts.into_iter().map(located).collect());
        Ok(Step { state: motion.state, impulses: motion.impulses, assembled, solution: None, residual: None, rejected: None, impacts })
    }
}
