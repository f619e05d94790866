//! Runs checks over the sweep, on several copies of the engine at once, always with the same report.
//!
//! A task is one check at one time step. Every worker has an engine of its own and takes the next task; the answers are put in order
//! afterwards, so that the number of workers changes nothing but the time.
//!
//! A panic of the engine is an answer of the engine, `errored`. A panic of a check is a mistake of ours: it ends the run, with the
//! name of the check, and nothing is said of the engine.

use crate::guarded::Guarded;
use crate::process::deadline::timed;
use crate::{
    Bench, Check, CheckOutcome, Description, Engine, Level, Measurement, Options, Refusal, Reply, Report, Run, StepOutcome, outcome,
};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// The time steps of the default sweep \[s\].
pub const SWEEP: [f64; 9] = [1.0 / 30.0, 1.0 / 60.0, 0.01, 1.0 / 120.0, 1.0 / 240.0, 0.003, 0.001, 0.0003, 0.0001];

/// The time steps of the quick sweep \[s\].
pub const QUICK: [f64; 3] = [1.0 / 60.0, 1.0 / 240.0, 0.001];

/// What to run and how.
pub struct Plan<'a> {
    /// The checks, in the order of the report.
    pub checks: Vec<&'static Check>,
    /// The time steps \[s\].
    pub sweep: Vec<f64>,
    /// Options for every request.
    pub options: Options,
    /// Engines that run at once, at least 1.
    pub jobs: usize,
    /// How often everything is measured: 1, or more for a spread.
    pub repeats: usize,
    /// Called after each task.
    pub progress: &'a (dyn Fn() + Sync),
}

impl Plan<'_> {
    /// How many tasks there are, counting repetitions.
    pub fn tasks(&self) -> usize {
        tasks(&self.checks, &self.sweep).len() * self.repeats
    }
}

/// One unit of work: a check at one time step, or once.
#[derive(Clone, Copy)]
struct Task {
    check: &'static Check,
    time_step: Option<f64>,
}

/// Runs the plan on engines that `make` makes.
///
/// # Errors
/// [`Refusal`] if the engine does not describe itself: then nothing can be asked.
///
/// # Panics
/// If a check panics, with its name: the mistake is the check's.
///
/// ```
/// use moreau_gate::{Options, Plan, Verdict, checks, own, runner};
///
/// let checks = ["projection/regions", "ball/restitution"].map(|name| checks::find(name).expect("a check")).to_vec();
/// let plan = Plan { checks, sweep: vec![0.01], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
/// let report = runner::run(&|| Box::new(own::by_name("moreau-jean").expect("one of ours")), &plan).expect("it describes itself");
/// assert_eq!((report.count(Verdict::Pass), report.is_bad()), (2, false));
/// ```
pub fn run(make: &(dyn Fn() -> Box<dyn Engine> + Sync), plan: &Plan) -> Reply<Report> {
    run_watched(make, plan, &|_, _, _| {})
}

/// [`run`] with an ear for every check that is finished: the report so far, where the checks to come are errored, the name of the
/// finished check, and the time that its measurements took. It hears one check at a time.
///
/// # Errors
/// Those of [`run`].
///
/// # Panics
/// As [`run`].
pub fn run_watched(
    make: &(dyn Fn() -> Box<dyn Engine> + Sync),
    plan: &Plan,
    watch: &(dyn Fn(&Report, &'static str, Duration) + Sync),
) -> Reply<Report> {
    let description = Guarded::new(make).describe(&plan.options)?;
    let tasks = tasks(&plan.checks, &plan.sweep);
    let (next, answers) = (AtomicUsize::new(0), Mutex::new(vec![None; tasks.len()]));
    std::thread::scope(|scope| {
        let work = || {
            let mut engine = Guarded::new(make);
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                let Some(task) = tasks.get(index) else { return };
                let answer = timed(|| measure(&mut engine, &description, plan, *task));
                let mut answers = answers.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                answers[index] = Some(answer);
                let of_check = tasks.iter().zip(answers.iter()).filter(|(other, _)| other.check.name == task.check.name);
                let times: Option<Vec<Duration>> = of_check.map(|(_, answer)| answer.as_ref().map(|(_, time)| *time)).collect();
                if let Some(times) = times {
                    watch(&so_far(&description, plan, &answers), task.check.name, times.iter().sum());
                }
            }
        };
        let workers: Vec<_> = (0..plan.jobs.clamp(1, tasks.len().max(1))).map(|_| scope.spawn(work)).collect();
        for worker in workers {
            worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        }
    });
    let answers = answers.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    Ok(so_far(&description, plan, &answers))
}

/// The report of the answers there are.
fn so_far(description: &Description, plan: &Plan, answers: &[Option<(StepOutcome, Duration)>]) -> Report {
    let to_come = || StepOutcome::new(None, Err(Refusal::errored("the run has not come to the end of this check")));
    let steps = answers.iter().map(|answer| answer.as_ref().map_or_else(to_come, |(step, _)| step.clone()));
    assemble(description.clone(), plan, steps.collect())
}

/// The tasks of the checks, in the order of the report.
fn tasks(checks: &[&'static Check], sweep: &[f64]) -> Vec<Task> {
    let of = |check: &&'static Check| -> Vec<Task> {
        match check.run {
            Run::EachStep(_) => sweep.iter().map(|h| Task { check, time_step: Some(*h) }).collect(),
            Run::Once(_) => vec![Task { check, time_step: None }],
        }
    };
    checks.iter().flat_map(of).collect()
}

/// A task, repeated as often as the plan says; the repetitions after the first are perturbed and only give the spread.
fn measure(engine: &mut Guarded, description: &Description, plan: &Plan, task: Task) -> StepOutcome {
    let mut attempt = |repeat: usize| {
        let answer = catch_unwind(AssertUnwindSafe(|| perform(engine, description, &plan.options, task, repeat)));
        (plan.progress)();
        answer.unwrap_or_else(|_| {
            let at = task.time_step.map(|h| format!(" at h = {h}")).unwrap_or_default();
            panic!("the check `{}` panicked{at}, as told above: a mistake of the check, which says nothing of the engine", task.check.name)
        })
    };
    let mut first = attempt(0);
    for repeat in 1..plan.repeats {
        if let (Ok(measurements), Ok(others)) = (&mut first, attempt(repeat)) {
            widen(measurements, &others);
        }
    }
    StepOutcome::new(task.time_step, first)
}

/// Records how far repeated values lie from the first ones.
fn widen(measurements: &mut [Measurement], others: &[Measurement]) {
    for (one, other) in measurements.iter_mut().zip(others) {
        one.spread = one.spread.max((one.value - other.value).abs());
    }
}

fn perform(engine: &mut dyn Engine, description: &Description, options: &Options, task: Task, repeat: usize) -> Reply<Vec<Measurement>> {
    if !description.levels.contains(&task.check.level) {
        return Err(Refusal::unsupported(missing_level(task.check.level)));
    }
    let mut bench = Bench::new(engine, description, options).perturbed(repeat);
    let mut measured = match (task.check.run, task.time_step) {
        (Run::EachStep(run), Some(h)) => run(&mut bench, h),
        (Run::Once(run), None) => run(&mut bench),
        _ => Err(Refusal::errored("a check that needs a time step was asked without one")),
    }?;
    measured.extend(bench.wrong_in_any_answer());
    Ok(measured)
}

fn missing_level(level: Level) -> &'static str {
    match level {
        Level::Simulate => "the engine does not simulate",
        Level::Solve => "the engine does not solve contact problems",
        Level::Project => "the engine does not project on friction cones",
        Level::Dump => "the engine does not dump its step problems",
    }
}

fn assemble(engine: Description, plan: &Plan, mut steps: Vec<StepOutcome>) -> Report {
    let mut outcomes = Vec::with_capacity(plan.checks.len());
    for check in &plan.checks {
        let count = match check.run {
            Run::EachStep(_) => plan.sweep.len(),
            Run::Once(_) => 1,
        };
        let rest = steps.split_off(count.min(steps.len()));
        outcomes.push(CheckOutcome::new(check.name, steps));
        steps = rest;
    }
    Report { schema: outcome::SCHEMA.into(), engine, adapter: Vec::new(), sweep: plan.sweep.clone(), checks: outcomes }
}

#[cfg(test)]
#[path = "runner_tests.rs"]
mod tests;
