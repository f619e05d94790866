//! Tests of the runner: order, jobs, an engine without description, repeats and their spread.

use super::*;
use crate::check::Control;
use crate::description::{Friction, Precision};
use crate::{ContactModel, Expectation, Kind, Verdict};
use moreau_contact::problem::{ContactProblem, Solution};
use nalgebra::DVector;

/// Answers contact problems with r = 0; panics when the problem says so.
struct Toy;

impl Engine for Toy {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        if options.contains_key("refuse") {
            return Err(Refusal::errored("no description today"));
        }
        Ok(Description {
            name: "toy".into(),
            version: "1".into(),
            precision: Precision::Double,
            contact_model: ContactModel { kind: Kind::Rigid, law: None, parameters: Default::default() },
            restitution: false,
            friction: Friction::None,
            reports_contacts: false,
            levels: vec![Level::Solve],
            laws: vec![],
            shapes: crate::description::ShapeKind::basic(),
            bodies: crate::description::BodyKind::free(),
            sleeping: None,
            options: options.clone(),
        })
    }

    fn solve(&mut self, problem: &ContactProblem, _options: &Options) -> Reply<Solution> {
        assert_ne!(problem.name(), "panic", "on purpose");
        let zero = DVector::zeros(problem.rows());
        Ok(Solution::new("toy", zero.clone(), zero, 0))
    }
}

const fn check(name: &'static str, level: Level, run: Run) -> Check {
    Check { name, level, question: "", derivation: "", source: "", run, control: Control { passes: "", fails: "" } }
}

fn value(x: f64) -> Vec<Measurement> {
    vec![Measurement::new("x", "s", x, Expectation::at_most(0.1, 0.0, ""))]
}

fn ask(bench: &mut Bench, name: &str) -> Reply<Solution> {
    bench.solve(&one_contact().into_builder().name(name).build().unwrap())
}

static STEP: Check = check("toy/step", Level::Solve, Run::EachStep(|_, h| Ok(value(h))));
static ONCE: Check = check("toy/once", Level::Solve, Run::Once(|bench| ask(bench, "fine").map(|_| value(0.0))));
static PANICS: Check = check("toy/panics", Level::Solve, Run::Once(|bench| ask(bench, "panic").map(|_| value(0.0))));
static MOVES: Check = check("toy/moves", Level::Simulate, Run::Once(|_| Ok(value(0.0))));
static NOTHING: Check = check("toy/nothing", Level::Solve, Run::Once(|_| Ok(Vec::new())));

fn report(jobs: usize) -> Report {
    let checks = vec![&PANICS, &STEP, &ONCE, &MOVES, &NOTHING];
    let plan = Plan { checks, sweep: vec![0.5, 0.05, 0.25], options: Options::new(), jobs, repeats: 1, progress: &|| {} };
    run(&|| Box::new(Toy), &plan).expect("describes itself")
}

#[test]
fn every_check_gets_its_verdict_in_the_order_of_the_question() {
    let verdicts: Vec<_> = report(1).checks.iter().map(|check| (check.check.clone(), check.verdict)).collect();
    let expected = [
        ("toy/panics", Verdict::Errored),
        ("toy/step", Verdict::Fail),
        ("toy/once", Verdict::Pass),
        ("toy/moves", Verdict::Unsupported),
        ("toy/nothing", Verdict::Errored),
    ];
    assert_eq!(verdicts, expected.map(|(name, verdict)| (name.to_string(), verdict)));
    assert_eq!(report(1).checks[1].fails_at, [0.5, 0.25]);
}

/// Reads a sample that nobody gave.
static FAULTY: Check = check("toy/faulty", Level::Solve, Run::EachStep(|_, _| Ok(value([0.0f64; 0].iter().copied().next().unwrap()))));

#[test]
fn a_panic_of_a_check_ends_the_run_and_is_not_the_engine_s() {
    for jobs in [1, 2] {
        let plan = Plan { checks: vec![&ONCE, &FAULTY], sweep: vec![0.5], options: Options::new(), jobs, repeats: 1, progress: &|| {} };
        let panic = catch_unwind(AssertUnwindSafe(|| run(&|| Box::new(Toy), &plan))).expect_err("the check is faulty");
        let told = panic.downcast_ref::<String>().expect("a text");
        assert!(told.starts_with("the check `toy/faulty` panicked at h = 0.5") && told.contains("nothing of the engine"), "{told}");
    }
}

#[test]
fn a_panic_of_an_engine_is_its_answer_and_the_next_check_has_an_engine_again() {
    let report = report(1);
    let told = report.checks[0].reason.as_deref().expect("a cause");
    assert!(told.starts_with("the engine panicked"), "{told}");
    assert_eq!(report.checks[2].verdict, Verdict::Pass);
}

#[test]
fn an_engine_that_panics_when_it_is_made_cannot_be_run() {
    let plan = Plan { checks: vec![&ONCE], sweep: vec![1.0], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    assert!(matches!(run(&|| panic!("no licence"), &plan), Err(Refusal::Errored(_))));
}

#[test]
fn the_number_of_jobs_changes_nothing() {
    assert_eq!(report(1), report(2));
    assert_eq!(report(1), report(50));
}

#[test]
fn whoever_watches_hears_of_every_check_when_it_is_finished_and_what_is_to_come_is_errored() {
    for jobs in [1, 3] {
        let plan =
            Plan { checks: vec![&STEP, &ONCE], sweep: vec![0.05, 0.01], options: Options::new(), jobs, repeats: 1, progress: &|| {} };
        let heard = Mutex::new(Vec::new());
        let watch = |report: &Report, name: &'static str, _: Duration| {
            let finished = report.checks.iter().find(|outcome| outcome.check == name).expect("a check of the plan");
            assert_eq!(finished.verdict, Verdict::Pass);
            let mut heard = heard.lock().unwrap();
            heard.push(name);
            assert_eq!(report.count(Verdict::Errored), 2 - heard.len(), "a run that is cut short must not look like one that passed");
        };
        let report = run_watched(&|| Box::new(Toy), &plan, &watch).expect("describes itself");
        assert_eq!(report.count(Verdict::Pass), 2);
        let mut heard = heard.into_inner().unwrap();
        heard.sort_unstable();
        assert_eq!(heard, ["toy/once", "toy/step"]);
    }
}

#[test]
fn an_engine_without_description_cannot_be_run() {
    let options = [("refuse".to_string(), true.into())].into_iter().collect();
    let plan = Plan { checks: vec![&ONCE], sweep: vec![1.0], options, jobs: 1, repeats: 1, progress: &|| {} };
    assert_eq!(run(&|| Box::new(Toy), &plan).expect_err("refused"), Refusal::errored("no description today"));
}

#[test]
fn repeats_give_the_spread() {
    let plan = Plan { checks: vec![&STEP], sweep: vec![0.05], options: Options::new(), jobs: 1, repeats: 3, progress: &|| {} };
    assert_eq!(plan.tasks(), 3);
    let report = run(&|| Box::new(Toy), &plan).expect("describes itself");
    assert_eq!(report.checks[0].steps[0].measurements[0].spread, 0.0, "the toy is not perturbed");
    let mut measured = value(1.0);
    widen(&mut measured, &value(1.25));
    widen(&mut measured, &value(0.5));
    assert_eq!(measured[0].spread, 0.5);
    widen(&mut measured, &value(0.875));
    assert_eq!(measured[0].spread, 0.5, "the farthest repetition, not the last");
}

/// What the perturbation makes of gravity, in units of it.
static SCATTERS: Check = check(
    "toy/scatters",
    Level::Simulate,
    Run::Once(|bench| {
        let scene = moreau_dynamics::scenes::named("two-ball-impact").map_err(Refusal::errored)?;
        let motion = bench.simulate(&scene, 0.25, 4, 1)?;
        let plain = scene.bodies[0].linear_velocity[0];
        Ok(value((motion.scene.bodies[0].linear_velocity[0] / plain - 1.0) / crate::tolerance::PERTURBATION))
    }),
);

#[test]
fn every_repetition_is_perturbed_farther_than_the_one_before_and_widens_the_spread() {
    for (repeats, spread) in [(1, 0.0), (2, 1.0), (3, 1.0), (4, 2.0), (6, 3.0)] {
        let plan = Plan { checks: vec![&SCATTERS], sweep: vec![0.05], options: Options::new(), jobs: 1, repeats, progress: &|| {} };
        let report = run(&|| Box::new(crate::own::by_name("moreau-jean").expect("listed")), &plan).expect("describes itself");
        let found = report.checks[0].steps[0].measurements[0].spread;
        assert!((found - spread).abs() <= 0.01, "{repeats} repeats: {found}");
    }
}

fn one_contact() -> ContactProblem {
    ContactProblem::new(nalgebra::DMatrix::identity(1, 1), DVector::zeros(1))
        .law(moreau_contact::Law::Frictionless)
        .rows_per_contact(1)
        .build()
        .unwrap()
}
