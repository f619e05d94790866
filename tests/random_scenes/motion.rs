//! One scheme on one scene, step by step: every number finite, every balance kept, every distance within reach of the energy.

use crate::scenario::{Scenario, Staged};
use moreau::Error;
use moreau::checks::energy_balance::reach::Reach;
use moreau::checks::energy_balance::{Balance, Judged, RESIDUAL, Taken};
use moreau::schemes::{self, Scheme, Step};
use moreau::solvers::Auto;
use serde::{Deserialize, Serialize};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    /// Whether a panic of this thread is caught and told by the report.
    pub static CAUGHT: Cell<bool> = const { Cell::new(false) };
}

/// How a scheme did on a scene.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Outcome {
    /// Steps made.
    pub steps: usize,
    /// Steps whose answer the certificate rejects.
    pub rejected: usize,
    /// Largest share of its tolerance by which a finding exceeds its bound; at most 1 where all hold.
    pub ratio: f64,
    /// Largest w of a residual over the step's energies, of steps that the certificate accepts.
    pub work: f64,
    /// Whether the scheme does not take the scene, which it may find out on the way.
    pub refused: bool,
    /// What an error ended the motion.
    pub ended: Option<String>,
    /// What must not be: a panic, a number that is not finite, a finding that does not hold.
    pub failure: Option<String>,
}

/// Runs a scheme on a scene.
pub fn run(name: &str, scenario: &Scenario) -> Outcome {
    let mut outcome = Outcome::default();
    CAUGHT.set(true);
    let result = catch_unwind(AssertUnwindSafe(|| attempt(name, scenario, &mut outcome)));
    CAUGHT.set(false);
    match result {
        Ok(Ok(())) => (),
        Ok(Err(Error::Unsupported(_))) => outcome.refused = true,
        Ok(Err(error)) => outcome.ended = Some(error.to_string()),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
            outcome.failure = Some(format!("panic after {} steps: {}", outcome.steps, text.unwrap_or("of another kind")));
        }
    }
    outcome
}

fn attempt(name: &str, scenario: &Scenario, outcome: &mut Outcome) -> moreau::Result<()> {
    let scheme = schemes::by_name(name, scenario.parameters)?;
    let balance = Balance::of(name, &scenario.parameters)?;
    let Staged { mechanism, start, masses } = scenario.staged();
    let (mut state, mut reach) = (start, None);
    let mut remembering: Option<Box<dyn Scheme>> = None;
    for _ in 0..scenario.steps {
        let current = remembering.as_deref().unwrap_or(scheme.as_ref());
        let step = schemes::step(current, &Auto, mechanism.as_ref(), &state, scenario.h)?;
        outcome.steps += 1;
        if step.state.position.iter().chain(&step.state.velocity).any(|x| !x.is_finite()) {
            outcome.failure = Some(format!("step {}: not finite", outcome.steps));
            return Ok(());
        }
        if !mechanism.energy(&step.state).is_finite() {
            // a spring whose explicit step is unstable: `simulate` ends there with an error
            return Err(Error::breakdown(name, "the energy is not finite"));
        }
        let taken = Taken { mechanism: mechanism.as_ref(), before: &state, step: &step, h: scenario.h };
        let judged = balance.judge(&taken)?;
        let rejected = is_rejected(&step);
        outcome.rejected += usize::from(rejected);
        note(outcome, &judged, rejected, &taken);
        if reach.is_none() {
            reach = Some(Reach::new(&taken)?);
        }
        if let Some(finding) = reach.as_mut().and_then(|reach| reach.after(&taken, &judged, &masses).transpose()).transpose()? {
            keep(outcome, &finding);
        }
        if outcome.failure.is_some() {
            return Ok(());
        }
        remembering = current.successor(mechanism.as_ref(), &state, &step, scenario.h)?.or(remembering);
        state = step.state;
    }
    Ok(())
}

/// Whether the certificate, or the rule of the scheme's own law, rejects what the step solved.
fn is_rejected(step: &Step) -> bool {
    step.residual.is_some_and(|residual| !residual.is_accepted())
}

fn note(outcome: &mut Outcome, judged: &Judged, rejected: bool, taken: &Taken) {
    for finding in &judged.findings {
        // a step that is no solution is counted, not failed; its other bounds hold with its own w
        if finding.name == RESIDUAL && rejected {
            continue;
        }
        keep(outcome, finding);
    }
    if !rejected {
        outcome.work = outcome.work.max(judged.residual / scale(taken));
    }
}

/// T before and after, and what gravity gives in a step.
fn scale(taken: &Taken) -> f64 {
    let Taken { mechanism, before, step, h } = taken;
    let force = mechanism.force(&before.position, &before.velocity.map(|_| 0.0));
    let mass = mechanism.mass_matrix(&before.position);
    let fall: f64 = force.iter().zip(mass.diagonal().iter()).map(|(force, mass)| (h * force).powi(2) / mass).sum();
    mechanism.kinetic_energy(before) + mechanism.kinetic_energy(&step.state) + fall + f64::MIN_POSITIVE
}

fn keep(outcome: &mut Outcome, finding: &moreau::checks::Finding) {
    let (over, tolerance) = (finding.expectation.miss(finding.measured), finding.expectation.tolerance);
    outcome.ratio = outcome.ratio.max(if over == 0.0 { 0.0 } else { over / tolerance });
    if !finding.holds() && outcome.failure.is_none() {
        outcome.failure = Some(format!("step {}: {finding}, tolerance {tolerance:e}", outcome.steps));
    }
}

/// Every scheme on one scene.
pub fn runs(scenario: &Scenario) -> Vec<(&'static str, Outcome)> {
    schemes::NAMES.iter().map(|name| (*name, run(name, scenario))).collect()
}
