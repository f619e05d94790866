//! Time-stepping schemes, one per file: each turns one step into a [`ContactProblem`] and its answer into a state.

use crate::mechanics::{Mechanism, State, afford};
use crate::trajectory::{LocatedImpact, Recording};
use moreau_contact::certificate::{Judgement, StepResidual};
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::contact::{ContactImpulse, Place};
use moreau_contact::memory;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::ContactSolver;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use nearby::Nearby;

pub mod anitescu;
pub mod assembly;
mod certified;
pub mod euler;
pub mod events;
pub mod exact_particle;
mod finite;
mod free_motion;
pub mod generalised_alpha;
pub mod moreau_jean;
pub mod moreau_jean_projection;
mod nearby;
pub mod position_based;
pub mod runge_kutta_flip;
pub mod schatzman_paoli;
pub mod stewart_trinkle;
pub mod variational;

pub use anitescu::Anitescu;
pub use certified::{Certified, Rejected};
pub use euler::Euler;
pub use events::Events;
pub use generalised_alpha::GeneralisedAlpha;
pub use moreau_jean::{Activation, MoreauJean, RestitutionRule};
pub use moreau_jean_projection::MoreauJeanProjection;
pub use position_based::{PositionBased, Softness};
pub use runge_kutta_flip::RungeKuttaFlip;
pub use schatzman_paoli::SchatzmanPaoli;
pub use stewart_trinkle::StewartTrinkle;
pub use variational::Variational;

/// What a scheme assembled for one step: the problem of the active contacts, and what turns impulses into velocities.
#[derive(Clone, Debug)]
pub struct StepProblem {
    /// The contact problem of the active contacts; `None` if no contact is active, or if the scheme's law is none of
    /// [`moreau_contact::problem::Law`].
    pub problem: Option<ContactProblem>,
    /// Indices of the active contacts into [`Mechanism::contacts`].
    pub active: Vec<usize>,
    /// Where the active contacts are, one entry per entry of `active`.
    pub places: Vec<Option<Place>>,
    /// M̂, effective mass of the step.
    pub effective_mass: DMatrix<f64>,
    /// v_free = v + h M̂⁻¹F, with the linear part of F as in [`moreau_jean`].
    pub free_velocity: DVector<f64>,
    /// H of the active contacts.
    pub jacobian: DMatrix<f64>,
    /// The worst residual of problems that were solved to assemble this one; none for most schemes.
    pub residual: Option<StepResidual>,
}

/// The impulses of a scheme's own law, and how well its own stopping rule is met.
#[derive(Clone, Debug)]
pub struct OwnAnswer {
    /// Impulses and velocities.
    pub solution: Solution,
    /// The residual of the law.
    pub residual: StepResidual,
}

/// One time-stepping scheme.
pub trait Scheme: Send + Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> String;
    /// Whether the scheme uses the mechanism's coefficients of restitution; without, every impact is plastic or as soft as its contact.
    fn has_restitution(&self) -> bool {
        true
    }
    /// Whether the scheme's algorithm is a declared number of sweeps, so that a step its certificate rejects counts as unconverged.
    fn is_truncated(&self) -> bool {
        false
    }
    /// Assembles the step of size h from a state.
    ///
    /// # Errors
    /// If the mass matrix is not positive definite or the mechanism is outside the scheme's scope.
    fn assemble(&self, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem>;
    /// The step of a scheme that poses several contact problems in it, or none, and therefore takes it by itself; `None` for the others.
    fn own_step(&self, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, h: f64) -> Option<Result<Step>> {
        let _ = (solver, mechanism, state, h);
        None
    }
    /// The impulses of a scheme whose law is no relation between r and y and that therefore assembles no [`ContactProblem`]; none for the
    /// others, whose problem goes to a solver.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Solver`] if the scheme's own iteration breaks down.
    fn own_answer(&self, mechanism: &dyn Mechanism, state: &State, assembled: &StepProblem, h: f64) -> Result<Option<OwnAnswer>> {
        let _ = (mechanism, state, assembled, h);
        Ok(None)
    }
    /// The next configuration from the velocities before and after the step.
    fn advance(&self, mechanism: &dyn Mechanism, state: &State, velocity_post: &DVector<f64>, h: f64) -> DVector<f64>;
    /// The configuration after [`Scheme::advance`], corrected for the contacts that the step held; the same one by default.
    ///
    /// # Errors
    /// If the correction does not come to an end.
    fn settle(&self, mechanism: &dyn Mechanism, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        let _ = (mechanism, assembled);
        Ok(position)
    }
    /// The scheme that makes the next step of a motion, if this one remembers more than the state; `None`: the same scheme again.
    ///
    /// # Errors
    /// If what is to be remembered cannot be computed.
    fn successor(&self, mechanism: &dyn Mechanism, before: &State, step: &Step, h: f64) -> Result<Option<Box<dyn Scheme>>> {
        let _ = (mechanism, before, step, h);
        Ok(None)
    }
}

/// The outcome of one step.
#[derive(Clone, Debug)]
pub struct Step {
    /// The state after the step.
    pub state: State,
    /// Impulses of the active contacts.
    pub impulses: Vec<ContactImpulse>,
    /// What was assembled.
    pub assembled: StepProblem,
    /// The answer, if any contact was active.
    pub solution: Option<Solution>,
    /// The worst residual of everything the step solved; none if it solved nothing.
    pub residual: Option<StepResidual>,
    /// The first contact problem whose answer the certificate rejects.
    pub rejected: Option<Box<Rejected>>,
    /// The impacts within the step, of a scheme that locates them; `None` of the others.
    pub impacts: Option<Vec<LocatedImpact>>,
}

impl Step {
    /// Whether the step is accepted; `truncated` if its scheme or solver declares a number of sweeps.
    pub fn judgement(&self, truncated: bool) -> Judgement {
        Judgement::of(self.residual, truncated)
    }
}

/// One step: v⁺ = v_free + M̂⁻¹Hᵀr, then the scheme's position update.
///
/// # Errors
/// Those of [`Scheme::assemble`] and [`ContactSolver::solve`].
pub fn step(scheme: &dyn Scheme, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<Step> {
    step_after(scheme, &Certified::new(solver), mechanism, state, h, &[])
}

/// A step whose solver starts from the impulses of the step before.
fn step_after(
    scheme: &dyn Scheme,
    solver: &Certified,
    mechanism: &dyn Mechanism,
    state: &State,
    h: f64,
    previous: &[ContactImpulse],
) -> Result<Step> {
    if let Some(step) = scheme.own_step(solver, mechanism, state, h) {
        return Ok(judged(step?, solver));
    }
    let mut reach = 2.0 * mechanism.reach(&state.velocity, h);
    if reach.is_finite() {
        reach = reach.max(2.0 * mechanism.reach(&free_motion::forecast(mechanism, state, h)?, h));
    }
    loop {
        afford(mechanism, &state.position, reach)?;
        let near = Nearby { mechanism, reach };
        let assembled = scheme.assemble(&near, state, h)?;
        let needed = mechanism.reach(&state.velocity, h).max(mechanism.reach(&assembled.free_velocity, h));
        if needed > reach {
            reach = 2.0 * needed;
            continue;
        }
        let step = judged(finish(scheme, solver, &near, state, h, previous, assembled)?, solver);
        let needed = mechanism.reach(&step.state.velocity, h);
        // A bound that is not a number bounds nothing; what it comes from is refused by the next step.
        if needed > reach {
            reach = 2.0 * needed;
        } else {
            return Ok(step);
        }
    }
}

/// The step with what was found about its contact problems.
fn judged(step: Step, solver: &Certified) -> Step {
    let (residual, rejected) = solver.take();
    let own = step.residual.map(|own| StepResidual { limit: solver.tolerance(), ..own });
    Step { residual: StepResidual::worse_of(own, residual), rejected: rejected.map(Box::new), ..step }
}

/// Solves what was assembled and moves on.
fn finish(
    scheme: &dyn Scheme,
    solver: &dyn ContactSolver,
    mechanism: &dyn Mechanism,
    state: &State,
    h: f64,
    previous: &[ContactImpulse],
    assembled: StepProblem,
) -> Result<Step> {
    let rows = mechanism.rows_per_contact();
    let start = carry_over(previous, &assembled.active, &assembled.places, rows);
    let (solution, own) = match &assembled.problem {
        Some(problem) => (Some(solver.solve(problem, Some(&start))?), None),
        None => scheme.own_answer(mechanism, state, &assembled, h)?.map(|answer| (answer.solution, answer.residual)).unzip(),
    };
    let mut velocity = assembled.free_velocity.clone();
    let mut impulses = Vec::new();
    if let Some(solution) = &solution {
        velocity += MassFactor::new(&assembled.effective_mass)?.solve(&assembled.jacobian.tr_mul(&solution.impulse));
        let places = assembled.active.iter().zip(&assembled.places);
        let one =
            |((&contact, &place), part): ((&usize, &Option<Place>), &[f64])| ContactImpulse { contact, impulse: part.to_vec(), place };
        impulses = places.zip(solution.impulse.as_slice().chunks(rows)).map(one).collect();
    }
    let position = scheme.settle(mechanism, &assembled, scheme.advance(mechanism, state, &velocity, h))?;
    let state = State { time: state.time + h, position, velocity };
    let residual = StepResidual::worse_of(own, assembled.residual);
    Ok(Step { state, impulses, assembled, solution, residual, rejected: None, impacts: None })
}

/// The previous impulses of the contacts that are active now, zero for the others \[N·s\].
pub fn carry_over(previous: &[ContactImpulse], active: &[usize], places: &[Option<Place>], rows: usize) -> DVector<f64> {
    let mut start = DVector::zeros(rows * active.len());
    for (k, (contact, place)) in active.iter().zip(places).enumerate() {
        if let Some(known) = previous.iter().find(|known| known.acts_at(*contact, place.as_ref())) {
            start.rows_mut(k * rows, rows).copy_from_slice(&known.impulse);
        }
    }
    start
}

/// `steps` steps of size h from `initial`, every sample recorded with the residual of its step; sample k lies at time initial.time + k h.
/// Each solve starts from the impulses of the step before at the same contacts.
///
/// # Errors
/// Those of [`run`], or if the recording needs more memory than the limit.
pub fn simulate(
    scheme: &dyn Scheme,
    solver: &dyn ContactSolver,
    mechanism: &dyn Mechanism,
    initial: State,
    h: f64,
    steps: usize,
) -> Result<Recording> {
    simulate_certified(scheme, &Certified::new(solver), mechanism, initial, h, steps, |_| Ok(()))
}

/// [`simulate`] with the tolerance of a certifying solver; each step is shown to `observe` too, whose error ends the motion.
///
/// # Errors
/// Those of [`step`] and of `observe`; if the recording would take more memory than is allowed.
pub fn simulate_certified(
    scheme: &dyn Scheme,
    solver: &Certified,
    mechanism: &dyn Mechanism,
    initial: State,
    h: f64,
    steps: usize,
    mut observe: impl FnMut(&Step) -> Result<()>,
) -> Result<Recording> {
    let sample = memory::matrix(initial.position.len() + initial.velocity.len(), 1) + size_of::<State>() as u128;
    memory::require(&format!("recording {steps} steps of {}", mechanism.name()), steps as u128 * sample)?;
    let mut recording = Recording::new(mechanism.name(), scheme.name(), h, initial.clone());
    let truncated = scheme.is_truncated() || solver.is_truncated();
    run_certified(scheme, solver, mechanism, initial, h, steps, |step| {
        recording.push_judged(step.state.clone(), step.impulses.clone(), step.residual, step.judgement(truncated));
        recording.locate(step.impacts.as_deref());
        observe(step)
    })?;
    Ok(recording)
}

/// The motion of [`simulate`], shown step by step to `observe` and not kept; returns the last state.
///
/// # Errors
/// Those of [`step`]; [`moreau_exact::Error::Solver`] where a position, a velocity or the energy is not finite.
pub fn run(
    scheme: &dyn Scheme,
    solver: &dyn ContactSolver,
    mechanism: &dyn Mechanism,
    initial: State,
    h: f64,
    steps: usize,
    mut observe: impl FnMut(&Step),
) -> Result<State> {
    run_certified(scheme, &Certified::new(solver), mechanism, initial, h, steps, |step| {
        observe(step);
        Ok(())
    })
}

/// [`run`] with the tolerance of a certifying solver; an error of `observe` ends the motion.
///
/// # Errors
/// Those of [`step`] and of `observe`.
pub fn run_certified(
    scheme: &dyn Scheme,
    solver: &Certified,
    mechanism: &dyn Mechanism,
    initial: State,
    h: f64,
    steps: usize,
    mut observe: impl FnMut(&Step) -> Result<()>,
) -> Result<State> {
    let start = initial.time;
    finite::finite(&scheme.name(), mechanism, 0, &initial)?;
    let mut state = initial;
    let mut previous = Vec::new();
    let mut remembering: Option<Box<dyn Scheme>> = None;
    for k in 1..=steps {
        let current = remembering.as_deref().unwrap_or(scheme);
        let mut made = step_after(current, solver, mechanism, &state, h, &previous)?;
        let successor = current.successor(mechanism, &state, &made, h)?;
        remembering = successor.or(remembering);
        made.state.time = start + k as f64 * h;
        finite::finite(&scheme.name(), mechanism, k, &made.state)?;
        observe(&made)?;
        (state, previous) = (made.state, made.impulses);
    }
    Ok(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::named;
    use moreau_contact::certificate::residuals;
    use moreau_contact::solvers::ProjectedGaussSeidel;
    use moreau_contact::tolerance::certificate::CERTIFY;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    /// Solves every problem twice, from the given impulses and from zero, and counts the sweeps.
    #[derive(Default)]
    struct Twice {
        warm: AtomicUsize,
        cold: AtomicUsize,
    }

    impl ContactSolver for Twice {
        fn name(&self) -> &'static str {
            "twice"
        }

        fn takes(&self, law: moreau_contact::Law, rows: usize, symmetric: bool) -> bool {
            ProjectedGaussSeidel::default().takes(law, rows, symmetric)
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let warm = ProjectedGaussSeidel::default().solve(problem, warm_start)?;
            let cold = ProjectedGaussSeidel::default().solve(problem, None)?;
            let found = residuals(problem, &warm)?;
            assert!(found.is_solution(CERTIFY) && residuals(problem, &cold)?.is_solution(CERTIFY));
            // several impulses carry the stack, but they all give one velocity
            assert!((&warm.velocity - &cold.velocity).amax() <= CERTIFY * found.velocity_scale, "{}", problem.name);
            self.warm.fetch_add(warm.iterations, Relaxed);
            self.cold.fetch_add(cold.iterations, Relaxed);
            Ok(warm)
        }
    }

    #[test]
    fn the_impulses_of_the_step_before_save_sweeps_and_leave_the_answer() {
        let (mechanism, start) = named("box-stack").and_then(|scene| scene.mechanism()).unwrap();
        let solver = Twice::default();
        simulate(&MoreauJean::default(), &solver, mechanism.as_ref(), start, 0.01, 50).unwrap();
        let (warm, cold) = (solver.warm.into_inner(), solver.cold.into_inner());
        assert!(0 < cold && 2 * warm <= cold, "{warm} sweeps against {cold}");
    }

    #[test]
    fn impulses_follow_their_contact_and_new_contacts_start_from_zero() {
        let previous =
            [(4, [1.0, 2.0]), (7, [3.0, 4.0])].map(|(contact, impulse)| ContactImpulse { contact, impulse: impulse.into(), place: None });
        assert_eq!(carry_over(&previous, &[3, 7], &[None; 2], 2).as_slice(), [0.0, 0.0, 3.0, 4.0]);
        assert_eq!(carry_over(&[], &[0], &[None], 1).as_slice(), [0.0]);
    }
}
