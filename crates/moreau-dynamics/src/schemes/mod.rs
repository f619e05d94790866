//! Time-stepping schemes, one per file: each makes one step of a state, most of them by one contact problem ([`waist`]).

use crate::mechanics::{Mechanism, State};
use crate::trajectory::Recording;
use moreau_contact::certificate::StepResidual;
use moreau_contact::memory;
use moreau_contact::solvers::{ContactSolver, watch};
use moreau_exact::{Error, Result};

pub mod anitescu;
pub mod assembly;
mod carried;
mod certified;
mod context;
pub mod euler;
pub mod events;
mod finite;
pub mod generalised_alpha;
pub mod moreau_jean;
pub mod moreau_jean_projection;
mod nearby;
pub mod position_based;
mod projection;
pub mod runge_kutta_flip;
pub mod schatzman_paoli;
mod scheme;
pub mod stewart_trinkle;
mod unmoved;
pub mod variational;
pub mod waist;

pub use anitescu::Anitescu;
use carried::Carried;
pub use certified::{Certified, Rejected};
pub use context::StepContext;
pub use euler::Euler;
pub use events::Events;
pub use generalised_alpha::GeneralisedAlpha;
pub use moreau_contact::contact::Inertia;
use moreau_exact::number::counted;
pub use moreau_jean::{Activation, MoreauJean, RestitutionRule};
pub use moreau_jean_projection::MoreauJeanProjection;
pub use position_based::{PositionBased, Softness};
pub use runge_kutta_flip::RungeKuttaFlip;
pub use schatzman_paoli::SchatzmanPaoli;
pub use scheme::{OwnAnswer, Scheme, Start, Step, StepProblem, StepResult, Waist};
pub use stewart_trinkle::StewartTrinkle;
pub use variational::Variational;
pub use waist::{assembled, carry_over, passes_the_waist};

/// One certified step.
///
/// # Errors
/// Those of [`Scheme::step`].
pub fn step(scheme: &dyn Scheme, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<Step> {
    certified_step(scheme, &Certified::new(solver), &Start { mechanism, state, h, previous: &[] })
}

/// A step with the residuals of all its contact problems.
fn certified_step(scheme: &dyn Scheme, solver: &Certified, start: &Start) -> Result<Step> {
    Ok(judged(scheme.step(solver, start)?, solver))
}

/// The step with what was found about its contact problems.
fn judged(step: Step, solver: &Certified) -> Step {
    let (residual, rejected) = solver.take();
    let own = step.residual.map(|own| StepResidual { limit: solver.tolerance(), ..own });
    // those on the way were held against the default tolerance
    let on_the_way = step.rejected.filter(|_| own.is_some_and(|own| !own.is_accepted()));
    Step { residual: StepResidual::worse_of(own, residual), rejected: rejected.map(Box::new).or(on_the_way), ..step }
}

/// `steps` steps of size h from `initial`, every sample recorded with the residual of its step; sample k lies at time initial.time + k h.
/// Each solve starts from the impulses of the step before at the same contacts.
///
/// # Errors
/// Those of [`run`], or if the recording needs more memory than the limit.
///
/// ```
/// use moreau_contact::solvers::Auto;
/// use moreau_dynamics::mechanics::{PointMass, State};
/// use moreau_dynamics::schemes::{MoreauJean, StewartTrinkle, simulate};
/// use nalgebra::dvector;
///
/// let ball = PointMass::ball_on_floor(1.0, 10.0, 0.5); // m, g, e
/// let start = State { time: 0.0, position: dvector![0.0], velocity: dvector![-3.0] };
/// let bounced = simulate(&MoreauJean::default(), &Auto, &ball, start.clone(), 0.001, 1)?;
/// assert!((bounced.last().velocity[0] - 1.5).abs() < 1e-9);
/// let stopped = simulate(&StewartTrinkle::default(), &Auto, &ball, start, 0.001, 1)?; // it has no restitution
/// assert!(stopped.last().velocity[0].abs() < 1e-9);
/// # Ok::<(), moreau_exact::Error>(())
/// ```
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
    observe: impl FnMut(&Step) -> Result<()>,
) -> Result<Recording> {
    let mut recording = Recording::new(mechanism.name(), scheme.name(), h, initial);
    record_certified(scheme, solver, mechanism, &mut recording, steps, observe)?;
    Ok(recording)
}

/// [`simulate_certified`] onto a recording, from its last state and with its h; the steps that were made before an error stay in it.
///
/// # Errors
/// Those of [`run_certified`]; if the recording would take more memory than is allowed.
pub fn record_certified(
    scheme: &dyn Scheme,
    solver: &Certified,
    mechanism: &dyn Mechanism,
    recording: &mut Recording,
    steps: usize,
    mut observe: impl FnMut(&Step) -> Result<()>,
) -> Result<()> {
    let (initial, h) = (recording.last().clone(), recording.time_step);
    let sample = memory::matrix(initial.position.len() + initial.velocity.len(), 1) + size_of::<State>() as u128;
    memory::require(format_args!("recording {steps} of {}", mechanism.name(), steps = counted(steps, "step")), steps as u128 * sample)?;
    let truncated = scheme.is_truncated() || solver.is_truncated();
    run_certified(scheme, solver, mechanism, initial, h, steps, |step| {
        recording.push_judged(step.state.clone(), step.impulses.clone(), step.residual, step.judgement(truncated));
        recording.locate(step.impacts.as_deref());
        observe(step)
    })
    .map(drop)
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

/// [`run`] with the tolerance of a certifying solver; an error of `observe` ends the motion, and so does the interrupt of who
/// [watches](watch::watched): a step in which a solver was ended early is none, and is not shown.
///
/// # Errors
/// Those of [`step`] and of `observe`; [`moreau_exact::Error::Solver`], a limit, with the number of the step where it was interrupted.
pub fn run_certified(
    scheme: &dyn Scheme,
    solver: &Certified,
    mechanism: &dyn Mechanism,
    initial: State,
    h: f64,
    steps: usize,
    mut observe: impl FnMut(&Step) -> Result<()>,
) -> Result<State> {
    let (start, name) = (initial.time, scheme.name());
    finite::finite(&name, mechanism, 0, &initial)?;
    let mut state = initial;
    let mut carried = Carried::default();
    let mut remembering: Option<Box<dyn Scheme>> = None;
    for k in 1..=steps {
        let current = remembering.as_deref().unwrap_or(scheme);
        let start_of_step = Start { mechanism, state: &state, h, previous: carried.impulses() };
        let made = (!watch::is_over()).then(|| watch::unnoted(|| certified_step(current, solver, &start_of_step)));
        let Some(made) = made.filter(|_| !watch::was_over()) else {
            return Err(Error::limit(name, format!("the motion was ended in step {k} of {steps}")));
        };
        let mut made = made.map_err(|error| unmoved::told(error, &name, mechanism, &state))?;
        let successor = current.successor(mechanism, &state, &made, h)?;
        remembering = successor.or(remembering);
        made.state.time = start + k as f64 * h;
        finite::finite(&name, mechanism, k, &made.state)?;
        observe(&made)?;
        state = made.follow(state, &mut carried);
    }
    Ok(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::named;
    use moreau_contact::certificate::residuals;
    use moreau_contact::problem::{ContactProblem, Solution};
    use moreau_contact::solvers::{Auto, ProjectedGaussSeidel};
    use moreau_contact::tolerance::certificate::CERTIFY;
    use nalgebra::DVector;
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
            assert!((&warm.velocity - &cold.velocity).amax() <= CERTIFY * found.velocity_scale, "{}", problem.name());
            self.warm.fetch_add(warm.iterations, Relaxed);
            self.cold.fetch_add(cold.iterations, Relaxed);
            Ok(warm)
        }
    }

    /// Ends the motion in its third answer: before it looks, or after it looked last.
    struct Ending {
        interrupt: watch::Interrupt,
        answers: AtomicUsize,
        looks_after: bool,
    }

    impl ContactSolver for Ending {
        fn name(&self) -> &'static str {
            "ending"
        }

        fn takes(&self, law: moreau_contact::Law, rows: usize, symmetric: bool) -> bool {
            Auto.takes(law, rows, symmetric)
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let answer = Auto.solve(problem, warm_start)?;
            if self.answers.fetch_add(1, Relaxed) == 2 {
                self.interrupt.now();
                if self.looks_after && watch::is_over() {
                    return Err(Error::limit("ending", "was ended"));
                }
            }
            Ok(answer)
        }
    }

    #[test]
    fn a_motion_that_is_ended_keeps_the_steps_that_were_made_and_no_other() {
        let (mechanism, start) = named("box-stack").and_then(|scene| scene.mechanism()).unwrap();
        let scheme = MoreauJean::default();
        let whole = simulate(&scheme, &Auto, mechanism.as_ref(), start.clone(), 0.01, 5).unwrap();
        for (looks_after, kept) in [(true, 2), (false, 3)] {
            let solver = Ending { interrupt: watch::Interrupt::default(), answers: AtomicUsize::new(0), looks_after };
            let mut recording = Recording::new(mechanism.name(), scheme.name(), 0.01, start.clone());
            let certified = Certified::new(&solver);
            let record = || record_certified(&scheme, &certified, mechanism.as_ref(), &mut recording, 5, |_| Ok(()));
            let (ended, seen) = watch::watched(&solver.interrupt, record);
            let message = ended.unwrap_err().to_string();
            assert!(seen.interrupted && message.contains(&format!("in step {} of 5", kept + 1)), "{message}");
            assert_eq!(recording.samples, whole.samples[..=kept]);
        }
    }

    /// Every bit of every state and impulse of a scene.
    fn bits(name: &str) -> Vec<u64> {
        let (mechanism, start) = named(name).and_then(|scene| scene.mechanism()).unwrap();
        let mut bits = Vec::new();
        run(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.005, 120, |step| {
            bits.extend(step.state.position.iter().chain(&step.state.velocity).map(|x| x.to_bits()));
            bits.extend(step.impulses.iter().flat_map(|one| one.impulse.iter()).map(|r| r.to_bits()));
        })
        .unwrap();
        bits
    }

    #[test]
    fn nothing_of_an_earlier_motion_is_seen_in_the_memory_that_it_left() {
        let fresh = std::thread::spawn(|| bits("box-stack")).join().unwrap();
        assert_eq!(bits("box-stack"), fresh);
        for other in ["rolling-disk", "two-ball-impact", "box-stack"] {
            bits(other);
            assert_eq!(bits("box-stack"), fresh, "after {other}");
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
}
