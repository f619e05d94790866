//! The waist: a step that is one [`ContactProblem`](moreau_contact::ContactProblem), and the adapter that makes a
//! [`Scheme`](super::Scheme) of every type that poses one.
//!
//! ```text
//!     v⁺ = v_free + M̂⁻¹Hᵀr ,   q⁺ = q ⊕ h v̄(v, v⁺)
//! ```
//! A scheme that passes the waist says how the problem is posed ([`Waist::assemble`]) and how the positions follow ([`Waist::advance`]);
//! solving, certifying, warm starts and the choice of the candidates nearby are the same for all. Which schemes pass and which do not, and
//! why, is in `docs/waist.md`.

use super::carried::place_of;
use super::certified::Certified;
use super::context::StepContext;
use super::nearby::Nearby;
use super::scheme::{OwnAnswer, Start, Step, StepProblem, Waist};
use crate::mechanics::{Mechanism, State, afford};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::{ContactImpulse, Place};
use moreau_contact::memory::spare::{self, Lent, Spare};
use moreau_contact::problem::Solution;
use moreau_contact::solvers::ContactSolver;
use moreau_exact::Result;
use nalgebra::DVector;

/// What a scheme poses for a step of size h from a state, with every candidate of the mechanism.
///
/// # Errors
/// Those of [`StepContext::new`] and [`Waist::assemble`].
pub fn assembled(scheme: &dyn Waist, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
    scheme.assemble(&StepContext::new(mechanism, state, h)?)
}

/// The two methods of [`Scheme`](super::Scheme) that are the same for every scheme that passes the [`Waist`].
#[macro_export]
macro_rules! passes_the_waist {
    () => {
        fn step(&self, solver: &$crate::schemes::Certified, start: &$crate::schemes::Start) -> $crate::schemes::StepResult {
            $crate::schemes::waist::step(self, solver, start)
        }

        fn waist(&self) -> Option<&dyn $crate::schemes::Waist> {
            Some(self)
        }
    };
}

pub use passes_the_waist;

/// The configuration after a step, from the velocity after it.
type Advance<'a> = dyn Fn(&StepContext, &StepProblem, &DVector<f64>) -> Result<DVector<f64>> + 'a;

/// The parts of a step that poses one problem. Any solver may answer it.
pub struct Parts<'a> {
    /// Poses the problem.
    pub assemble: &'a dyn Fn(&StepContext) -> Result<StepProblem>,
    /// Answers the problem. There is no answer without a contact.
    pub answer: &'a dyn Fn(&StepContext, &StepProblem) -> Result<Option<OwnAnswer>>,
    /// Forgets what was found about an attempt that became no step.
    pub discard: &'a dyn Fn(),
    /// The next configuration.
    pub advance: &'a Advance<'a>,
}

/// A step through the waist: a solver answers what the scheme poses, starting from the impulses of the step before.
///
/// # Errors
/// Those of [`Waist::assemble`], [`Waist::settle`] and the solver.
pub fn step(scheme: &dyn Waist, solver: &Certified, start: &Start) -> Result<Step> {
    let answer = |at: &StepContext, assembled: &StepProblem| {
        let Some(problem) = &assembled.problem else { return Ok(None) };
        let warm = Lent::from(carry_over(start.previous, &assembled.active, &assembled.places, at.mechanism().rows_per_contact()));
        Ok(Some(OwnAnswer { solution: solver.solve(problem, Some(&warm))?, residual: None }))
    };
    let advance =
        |at: &StepContext, assembled: &StepProblem, velocity: &DVector<f64>| scheme.settle(at, assembled, scheme.advance(at, velocity));
    step_in_parts(
        start,
        &Parts { assemble: &|at| scheme.assemble(at), answer: &answer, discard: &|| drop(solver.take()), advance: &advance },
    )
}

/// A step in its parts, with the contact candidates nearby: as many as the velocities before, without contact and after it can reach.
///
/// # Errors
/// Those of the parts; if the candidates need more memory than the limit.
pub fn step_in_parts(start: &Start, parts: &Parts) -> Result<Step> {
    let Start { mechanism, state, h, .. } = *start;
    let whole = StepContext::new(mechanism, state, h)?;
    let before = mechanism.reach(&state.velocity, h);
    let mut reach = 2.0 * before;
    let ahead = if reach.is_finite() { mechanism.reach(whole.forecast()?, h) } else { f64::INFINITY };
    if reach.is_finite() {
        reach = reach.max(2.0 * ahead);
    }
    loop {
        afford(mechanism, &state.position, reach)?;
        let near = Nearby { mechanism, reach };
        let at = whole.of(&near);
        let assembled = (parts.assemble)(&at)?;
        // without linear forces v_free is the forecast
        let is_ahead = reach.is_finite() && assembled.free_velocity == *whole.forecast()?;
        let needed = before.max(if is_ahead { ahead } else { mechanism.reach(&assembled.free_velocity, h) });
        if needed > reach {
            (parts.discard)();
            reach = 2.0 * needed;
            continue;
        }
        let step = finish(parts, &at, assembled)?;
        let needed = mechanism.reach(&step.state.velocity, h);
        // A bound that is not a number is ignored here; the next step refuses the state that it comes from.
        if needed > reach {
            (parts.discard)();
            reach = 2.0 * needed;
        } else {
            return Ok(step);
        }
    }
}

/// Answers what was assembled and moves on.
fn finish(parts: &Parts, at: &StepContext, mut assembled: StepProblem) -> Result<Step> {
    let (solution, own): (Option<Solution>, _) = match (parts.answer)(at, &assembled)? {
        Some(OwnAnswer { solution, residual }) => (Some(solution), residual),
        None => (None, None),
    };
    let mut velocity = assembled.free_velocity.copied();
    let mut impulses = Vec::new();
    if let Some(solution) = &solution {
        velocity += &*Lent::from(assembled.effective_mass.solved(assembled.jacobian.tr_mul(&solution.impulse)));
        let places = assembled.active.iter().zip(&assembled.places);
        let one = |((&contact, &place), part): ((&usize, &Option<Place>), &[f64])| ContactImpulse { contact, impulse: part.into(), place };
        let parts = solution.impulse.as_slice().chunks(at.mechanism().rows_per_contact());
        impulses = spare::collected(assembled.active.len(), places.zip(parts).map(one));
    }
    let position = (parts.advance)(at, &assembled, &velocity)?;
    let state = State { time: at.state().time + at.h(), position, velocity };
    let residual = StepResidual::worse_of(own, assembled.residual);
    let rejected = assembled.rejected.take();
    Ok(Step { state, impulses, assembled, solution, residual, rejected, impacts: None })
}

/// The previous impulses of the contacts that are active now, zero for the others \[N·s\].
pub fn carry_over(previous: &[ContactImpulse], active: &[usize], places: &[Option<Place>], rows: usize) -> DVector<f64> {
    let (mut start, mut next) = (spare::zeros(rows * active.len()), 0);
    for (k, (contact, place)) in active.iter().zip(places).enumerate() {
        if let Some(at) = place_of(previous, &mut next, *contact, place.as_ref()) {
            start.as_mut_slice()[k * rows..(k + 1) * rows].copy_from_slice(&previous[at].impulse);
        }
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::Scene;
    use crate::schemes::{Anitescu, step};
    use moreau_contact::problem::{ContactProblem, Law};
    use moreau_contact::solvers::Auto;

    /// Answers a single contact a thousandth too hard, which its certificate rejects, and everything else well.
    struct WrongAlone;

    impl ContactSolver for WrongAlone {
        fn name(&self) -> &'static str {
            "wrong alone"
        }

        fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool {
            Auto.takes(law, rows, symmetric)
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let mut solution = Auto.solve(problem, warm_start)?;
            if problem.contacts() == 1 {
                solution.impulse *= 1.001;
                solution.velocity = problem.velocity(&solution.impulse);
            }
            Ok(solution)
        }
    }

    /// Two spheres that overlap by 5 cm, and `third`: a sphere 3 cm above them, which only the pushed one reaches.
    fn pushed(third: bool) -> Step {
        let still = r#""linear_velocity": [0, 0, 0], "angular_velocity": [0, 0, 0]"#;
        let sphere = |name: &str, z: f64| {
            format!(r#"{{"name": "{name}", "mass": 1, "position": [0, 0, {z}], "sphere": {{"radius": 0.1}}, {still}}}"#)
        };
        let mut bodies = vec![sphere("low", 1.0), sphere("high", 1.15)];
        bodies.extend(third.then(|| sphere("above", 1.38)));
        let rest = r#""gravity": [0, 0, 0], "duration": 1, "material": {"friction": 0.3, "restitution": 0}"#;
        let text = format!(r#"{{"schema": "scene/1", "name": "pushed", "bodies": [{}], {rest}}}"#, bodies.join(", "));
        let (mechanism, start) = Scene::from_json(&text).expect("a scene").spatial_mechanism().expect("spheres");
        step(&Anitescu, &WrongAlone, mechanism.as_ref(), &start, 0.001).expect("solved")
    }

    #[test]
    fn an_attempt_that_became_no_step_is_not_judged() {
        assert!(pushed(false).rejected.is_some(), "alone the wrong answer is the step's");
        let step = pushed(true);
        assert_eq!(step.assembled.active.len(), 2, "the pushed sphere reaches the third one");
        assert!(step.rejected.is_none() && step.residual.is_some_and(|residual| residual.is_accepted()), "{:?}", step.residual);
    }

    #[test]
    fn what_was_rejected_on_the_way_is_kept_where_it_rejects_the_step() {
        let again = |tolerance: f64| super::super::judged(pushed(false), &Certified::with_tolerance(&WrongAlone, tolerance));
        assert!(again(1e-8).rejected.is_some());
        let lenient = again(f64::INFINITY);
        assert!(lenient.rejected.is_none() && lenient.residual.is_some_and(|residual| residual.is_accepted()));
    }

    #[test]
    fn impulses_follow_their_contact_and_new_contacts_start_from_zero() {
        let previous =
            [(4, [1.0, 2.0]), (7, [3.0, 4.0])].map(|(contact, impulse)| ContactImpulse { contact, impulse: impulse.into(), place: None });
        assert_eq!(carry_over(&previous, &[3, 7], &[None; 2], 2).as_slice(), [0.0, 0.0, 3.0, 4.0]);
        assert_eq!(carry_over(&[], &[0], &[None], 1).as_slice(), [0.0]);
    }
}
