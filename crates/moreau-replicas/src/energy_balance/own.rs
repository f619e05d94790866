//! The balances of schemes that pose no contact problem for a step.
//!
//! ```text
//!     variational:    |ΔE| ≤ h²FᵀM⁻¹F/8 ,  0 without an impact                      constant force
//!     event-driven:   ΔE ≤ 0 up to the method's own tolerances                      e = 0, or no friction and one contact
//! ```
//! **Variational.** E_d of a parabola of length τ is E − τ²FᵀM⁻¹F/8 and the same on both sides of an impact after τ: ΔE = h(h −
//! 2τ)FᵀM⁻¹F/8.
//! **Event-driven.** Flight keeps E, sliding loses, and an impact with y = u⁺ + e min(u_n⁻, 0) n does not gain with e = 0, nor where one
//! contact alone is hit without friction: ΔT = −½(1−e²) u_n²/W. Several contacts hit at once with e > 0, or friction beside e > 0, have no
//! theorem.

use crate::energy_balance::exchange::norm;
use crate::energy_balance::{Judged, TOTAL, Taken};
use crate::tolerance::energy_balance as tolerance;
use moreau_checks::Finding;
use moreau_contact::contact::ContactImpulse;
use moreau_contact::contact::delassus::MassFactor;
use moreau_exact::Result;
use nalgebra::DVector;

/// The force F at zero velocity, if F and M are the same at both ends of the step.
fn constant_force(taken: &Taken) -> Option<DVector<f64>> {
    let (mechanism, from, to) = (taken.mechanism, &taken.before.position, &taken.step.state.position);
    let at_rest = DVector::zeros(taken.before.velocity.len());
    let force = mechanism.force(from, &at_rest);
    let same = mechanism.mass_matrix(from) == mechanism.mass_matrix(to) && mechanism.force(to, &at_rest) == force;
    (same && mechanism.linear_force().is_none()).then_some(force)
}

fn changed(taken: &Taken) -> f64 {
    taken.mechanism.energy(&taken.step.state) - taken.mechanism.energy(taken.before)
}

/// Nothing to be found, no theorem.
fn silent() -> Judged {
    Judged { findings: Vec::new(), residual: 0.0, gain: None, rise: None }
}

/// The balance of the variational integrator.
pub(super) fn variational(taken: &Taken) -> Result<Judged> {
    let Some(force) = constant_force(taken) else { return Ok(silent()) };
    let mass = taken.mechanism.mass_matrix(&taken.before.position);
    let fall = taken.h * taken.h * force.dot(&MassFactor::new(&mass)?.solve(&force));
    let (before, after) = (taken.before, &taken.step.state);
    let speeds = norm(&mass, &before.velocity).powi(2) + norm(&mass, &after.velocity).powi(2);
    let heights = force.abs().sum() * (before.position.amax() + after.position.amax());
    let tolerance = tolerance::variational(speeds + heights + fall);
    let bound = if taken.step.impulses.is_empty() { 0.0 } else { fall / 8.0 };
    let findings = vec![Finding::equal(TOTAL, changed(taken), 0.0, bound + tolerance, "J")];
    // an elastic impact within the step reverses a speed that the force may have raised by h F
    Ok(Judged { findings, residual: 0.0, gain: Some(bound + tolerance), rise: Some(bound + tolerance) })
}

/// Whether the theorem of the event-driven method covers these impulses.
fn covered(taken: &Taken, impulses: &[ContactImpulse]) -> bool {
    let contacts = taken.mechanism.contacts(&taken.before.position);
    let plastic = contacts.iter().all(|contact| contact.restitution == 0.0);
    let smooth = contacts.iter().all(|contact| contact.friction == 0.0);
    plastic || (smooth && impulses.len() <= 1)
}

/// The balance of the event-driven method.
pub(super) fn events(taken: &Taken) -> Result<Judged> {
    let force = constant_force(taken);
    let (Some(force), true) = (force, covered(taken, &taken.step.impulses)) else { return Ok(silent()) };
    let (before, after) = (taken.before, &taken.step.state);
    let mass = taken.mechanism.mass_matrix(&before.position);
    let speed = before.velocity.amax().max(after.velocity.amax());
    let momentum = (&mass * &before.velocity).abs().sum().max((&mass * &after.velocity).abs().sum());
    let position = before.position.amax().max(after.position.amax());
    let tolerance = tolerance::events(position, speed, force.abs().sum(), momentum);
    let findings = vec![Finding::at_most_within(TOTAL, changed(taken), 0.0, tolerance, "J")];
    Ok(Judged { findings, residual: 0.0, gain: Some(tolerance), rise: Some(tolerance) })
}

/// A scheme without a theorem.
pub(super) fn nothing() -> Judged {
    silent()
}
