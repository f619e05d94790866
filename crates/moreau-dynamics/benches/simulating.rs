//! What a simulation costs: steps per second, allocations per step after warm-up, memory, and the share of the certificates.
//!
//! `cargo bench -p moreau-dynamics --bench simulating` runs all scenes, with `-- stack` those whose name has the word. The share of the
//! certificates is the time of judging every answer once more over the time of the same run, so that a busy machine changes it little.
//! It fails if a step asks for memory more often than docs/benchmarks/simulating.md promises of its scene: new memory, or more of it.
//! It fails if a step of such a scene is rejected, too.
//! Live memory is what the allocator has given out and not got back, measured at the end of each step while its parts are still held.

use moreau_contact::certificate::Judge;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{Auto, AutoWithin, ContactSolver, ProjectedGaussSeidel};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::schemes::{Certified, MoreauJean, run, run_certified};
use nalgebra::DVector;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, Stats, StatsAlloc};
use std::alloc::System;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

#[global_allocator]
static COUNTED: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The default solver, or plain sweeps at first, and how long it and one more judgement of its answers take.
struct Timed {
    found: Mutex<Found>,
    /// How many answers come from [`ROUGH_SWEEPS`] plain sweeps.
    rough: usize,
    /// The largest relative residual that is asked for; as small as possible if none.
    within: Option<f64>,
}

#[derive(Default)]
struct Found {
    judge: Judge,
    solving: Duration,
    judging: Duration,
    answers: usize,
}

/// Sweeps of a step that is not certified.
const ROUGH_SWEEPS: usize = 100;

/// Plain sweeps, none of which is measured.
fn sweeps(sweeps: usize) -> ProjectedGaussSeidel {
    ProjectedGaussSeidel { sweeps, tolerance: -1.0, memory: 0 }
}

impl Timed {
    fn answer(&self, before: usize, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> moreau_exact::Result<Solution> {
        match self.within {
            _ if before < self.rough => sweeps(ROUGH_SWEEPS).solve(problem, warm_start),
            Some(tolerance) => AutoWithin { tolerance }.solve(problem, warm_start),
            None => Auto.solve(problem, warm_start),
        }
    }
}

impl ContactSolver for Timed {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn takes(&self, _law: moreau_contact::problem::Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> moreau_exact::Result<Solution> {
        let mut found = self.found.lock().expect("no other thread panics");
        let begun = Instant::now();
        let solution = self.answer(found.answers, problem, warm_start)?;
        found.solving += begun.elapsed();
        found.answers += 1;
        let begun = Instant::now();
        let judged = found.judge.judge(problem, &solution)?;
        found.judging += begun.elapsed();
        assert!(judged.relative().is_finite(), "{}", problem.name());
        Ok(solution)
    }
}

/// One scene, its step, and how many steps are taken before anything is measured and while it is.
struct Case {
    name: &'static str,
    start: fn() -> (Box<dyn Mechanism>, State),
    h: f64,
    /// Steps by plain sweeps before all others, which are not certified.
    rough: usize,
    warm: usize,
    steps: usize,
    /// What the solver is asked for and the certificate accepts, if it is not the default.
    within: Option<f64>,
    /// Most allocations a step, in the mean, as promised; infinite where nothing is.
    most: f64,
}

impl Default for Case {
    fn default() -> Self {
        Case { name: "", start: || at_rest(&stack()), h: 0.002, rough: 0, warm: 10, steps: 100, within: None, most: f64::INFINITY }
    }
}

fn at_rest(scene: &Scene) -> (Box<dyn Mechanism>, State) {
    scene.spatial_mechanism().expect("bodies in space")
}

/// Numbers of no pattern in [−1, 1).
fn scattered(seed: u64) -> f64 {
    let mixed = (seed ^ (seed >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// A scene under gravity, over the ground, with μ = ½.
fn scene(name: &str, bodies: &[String]) -> Scene {
    rubbing(name, bodies, 0.5)
}

fn rubbing(name: &str, bodies: &[String], friction: f64) -> Scene {
    let text = format!(
        r#"{{"schema": "scene/1", "name": "{name}", "gravity": [0, 0, -9.81], "ground": {{"normal": [0, 0, 1], "offset": 0}},
            "bodies": [{}], "material": {{"friction": {friction}, "restitution": 0}}, "duration": 1}}"#,
        bodies.join(", ")
    );
    Scene::from_json(&text).expect("a valid scene")
}

fn body(name: String, shape: &str, mass: f64, [x, y, z]: [f64; 3]) -> String {
    format!(r#"{{"name": "{name}", {shape}, "mass": {mass}, "position": [{x}, {y}, {z}]}}"#)
}

fn cube(half: f64) -> String {
    format!(r#""box": {{"half_extents": [{half}, {half}, {half}]}}"#)
}

fn ball(radius: f64) -> String {
    format!(r#""sphere": {{"radius": {radius}}}"#)
}

/// Ten cubes of edge 0.1 m on each other, each a few millimetres beside the one below.
fn stack() -> Scene {
    let place = |k: u64| [2e-3 * scattered(2 * k), 2e-3 * scattered(2 * k + 1), 0.05 + 0.1 * k as f64];
    scene("stack", &(0..10).map(|k| body(format!("b{k}"), &cube(0.05), 1.0, place(k))).collect::<Vec<_>>())
}

/// A hundred spheres that fall onto each other, five by five in four layers.
fn heap() -> Scene {
    let place = |k: u64| {
        let [x, y, z] = [k % 5, k / 5 % 5, k / 25].map(|n| n as f64);
        [0.11 * x + 5e-3 * scattered(3 * k), 0.11 * y + 5e-3 * scattered(3 * k + 1), 0.06 + 0.12 * z]
    };
    scene("heap", &(0..100).map(|k| body(format!("s{k}"), &ball(0.05), 0.5, place(k))).collect::<Vec<_>>())
}

/// Spheres at rest on the ground, side by side without touching each other.
fn field() -> Scene {
    let place = |k: u64| [0.21 * (k % 32) as f64, 0.21 * (k / 32) as f64, 0.1];
    scene("field", &(0..1000).map(|k| body(format!("s{k}"), &ball(0.1), 1.0, place(k))).collect::<Vec<_>>())
}

/// A thousand spheres in a box of four heavy walls, in layers that fall into the gaps of those below.
fn pile() -> Scene {
    let (radius, side) = (0.05, 10);
    let spacing = 2.02 * radius;
    let width = 0.5 * spacing * (side as f64 + 0.6);
    let place = |k: u64| {
        let [x, y, z] = [k % side, k / side % side, k / (side * side)].map(|n| n as f64);
        let beside = if (z as u64).is_multiple_of(2) { -0.25 } else { 0.25 };
        let at = |n: f64, seed: u64| spacing * (n + 0.5 + beside) - 0.5 * spacing * side as f64 + 1e-3 * scattered(seed);
        [at(x, 2 * k), at(y, 2 * k + 1), radius * (1.0 + 1.5 * z)]
    };
    let mut bodies: Vec<String> = (0..1000).map(|k| body(format!("s{k}"), &ball(radius), 0.5, place(k))).collect();
    let (half, thick) = (0.6, 0.5);
    for (k, [x, y]) in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].into_iter().enumerate() {
        let extents = if x == 0.0 { [width, thick, half] } else { [thick, width + 2.0 * thick, half] };
        let shape = format!(r#""box": {{"half_extents": {extents:?}}}"#);
        bodies.push(body(format!("wall{k}"), &shape, 1e5, [x * (width + thick), y * (width + thick), half]));
    }
    scene("pile", &bodies)
}

/// A thousand spheres of radii from 45 to 55 mm in a box of four static walls, in layers above the gaps of those below.
fn boxed() -> Vec<String> {
    let (side, spread) = (10, 0.1);
    let spacing = 2.02 * 0.05 * (1.0 + spread);
    let width = 0.5 * spacing * (side as f64 + 0.5);
    let sphere = |k: u64| {
        let [x, y, z] = [k % side, k / side % side, k / (side * side)].map(|n| n as f64);
        let beside = if (z as u64).is_multiple_of(2) { 0.25 } else { 0.75 };
        let at = |n: f64, seed: u64| spacing * (n + beside - 0.5 * side as f64) + 1e-4 * scattered(seed);
        let size = 1.0 + spread * scattered(1_000_003 + k);
        Body::sphere(format!("s{k}"), 0.5 * size.powi(3), 0.05 * size, [at(x, 2 * k), at(y, 2 * k + 1), 0.055 + 0.75 * spacing * z])
    };
    let wall = |x: f64, y: f64| {
        let half = if x == 0.0 { [width, 0.5, 1.0] } else { [0.5, width + 1.0, 1.0] };
        Body::cuboid(format!("wall {x} {y}"), 1.0, half, [x * (width + 0.5), y * (width + 0.5), 1.0]).fixed()
    };
    let walls = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(x, y)| wall(x, y));
    (0..1000).map(sphere).chain(walls).map(|body| serde_json::to_string(&body).expect("numbers")).collect()
}

/// The spheres of [`boxed`] where they have come to rest, with μ = ½. They fall with μ = 0.1 in steps of 5 ms by 50 plain sweeps each,
/// which are not certified, and every tenth step all velocities are halved.
fn settled() -> (Box<dyn Mechanism>, State) {
    let bodies = boxed();
    let (slippery, mut state) = at_rest(&rubbing("settling", &bodies, 0.1));
    for _ in 0..80 {
        state.velocity *= 0.5;
        state.time = 0.0;
        state = run(&MoreauJean::default(), &sweeps(50), &*slippery, state, 0.005, 10, |_| ()).expect("every step has an answer");
    }
    state.time = 0.0;
    (at_rest(&scene("settled", &bodies)).0, state)
}

/// How often memory was asked for.
fn asked(stats: &Stats) -> usize {
    stats.allocations + stats.reallocations
}

/// Runs a scene and prints its line; false if it allocates more often than promised, or a step is rejected where that is promised.
fn measure(Case { name, start, h, rough, warm, steps, within, most }: Case) -> bool {
    let (mechanism, start) = start();
    let timed = Timed { found: Mutex::default(), rough, within };
    let certified = Certified::with_tolerance(&timed, within.unwrap_or(CERTIFY));
    let region = Region::new(COUNTED);
    let (mut begun, mut counted, mut taken, mut slowest) = (Instant::now(), region.change(), 0, 0.0f64);
    let (mut live, mut contacts, mut rejected, mut last) = (0usize, 0, 0, Instant::now());
    run_certified(&MoreauJean::default(), &certified, &*mechanism, start, h, rough + warm + steps, |step| {
        let now = Instant::now();
        taken += 1;
        slowest = slowest.max((now - last).as_secs_f64());
        last = now;
        let given = region.change();
        live = live.max(given.bytes_allocated.saturating_sub(given.bytes_deallocated));
        rejected += usize::from(taken > rough && step.rejected.is_some());
        contacts = step.impulses.len();
        if taken == rough + warm {
            (begun, counted, slowest) = (now, given, 0.0);
            let mut found = timed.found.lock().expect("no other thread panics");
            *found = Found { answers: found.answers, ..Found::default() };
        }
        Ok(())
    })
    .expect("every step has an answer");
    let (all, given) = (begun.elapsed().as_secs_f64(), region.change());
    let Found { solving, judging, .. } = &*timed.found.lock().expect("no other thread panics");
    let each = |count: usize| count as f64 / steps as f64;
    // every answer is judged twice here, once as every simulation does it and once for its time
    let plain = all - judging.as_secs_f64();
    println!(
        "{name:8} {steps:6} {contacts:8} {:10.0} {:12.3} {:11.1} {:10.1} {:12.1} {:8.1} % {:8.1} % {rejected:8}",
        steps as f64 / plain,
        1e3 * slowest,
        each(asked(&given) - asked(&counted)),
        each(given.bytes_allocated - counted.bytes_allocated) / 1e3,
        live as f64 / 1e6,
        100.0 * solving.as_secs_f64() / plain,
        100.0 * judging.as_secs_f64() / plain,
    );
    let found = each(asked(&given) - asked(&counted));
    if found > most {
        eprintln!("{name}: {found:.1} allocations a step, and {most} are promised");
    }
    let is_refused = rejected > 0 && most.is_finite();
    if is_refused {
        eprintln!("{name}: {rejected} steps are rejected, and none is promised");
    }
    found <= most && !is_refused
}

fn main() -> ExitCode {
    let word = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    println!("scene     steps contacts    steps/s  slowest [ms] allocations  kB a step  live [MB]    solver   certificates rejected");
    let cases = [
        Case { name: "stack", steps: 1000, most: 0.3, ..Case::default() },
        Case { name: "at-rest", warm: 1000, steps: 1000, most: 0.1, ..Case::default() },
        Case { name: "heap", start: || at_rest(&heap()), steps: 500, most: 2.8, ..Case::default() },
        Case { name: "field", start: || at_rest(&field()), h: 0.001, most: 0.3, ..Case::default() },
        Case { name: "settled", start: settled, rough: 100, warm: 20, steps: 300, within: Some(1e-6), most: 2.0, ..Case::default() },
        Case { name: "pile", start: || at_rest(&pile()), warm: 50, steps: 50, ..Case::default() },
    ];
    let broken = cases.into_iter().filter(|case| case.name.contains(&word)).map(measure).filter(|kept| !kept).count();
    if broken == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
