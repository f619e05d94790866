//! What certifying every step costs: the time of the certificates over the time of the whole simulation. A step that the certificate
//! rejects ends the bench.
//!
//! `cargo bench -p moreau-dynamics --bench certifying`; the shares are of one run, so that a busy machine changes them little.

use moreau_contact::certificate::Judge;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{Auto, ContactSolver};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::schemes::{MoreauJean, simulate};
use nalgebra::DVector;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The default solver, with every problem and its answer kept.
#[derive(Default)]
struct Kept(Mutex<Vec<(ContactProblem, Solution)>>);

impl ContactSolver for Kept {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn takes(&self, _law: moreau_contact::problem::Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> moreau_exact::Result<Solution> {
        let solution = Auto.solve(problem, warm_start)?;
        self.0.lock().expect("no other thread panics").push((problem.clone(), solution.clone()));
        Ok(solution)
    }
}

/// n cubes of edge 0.2 m, the first thrown and turning, the others above it, falling onto each other.
fn cubes(n: usize) -> Scene {
    let bodies: Vec<String> = (0..n)
        .map(|k| {
            let (x, z) = (0.02 * k as f64, 0.3 + 0.3 * k as f64);
            format!(
                r#"{{"name": "c{k}", "box": {{"half_extents": [0.1, 0.1, 0.1]}}, "mass": 1,
                    "position": [{x}, 0, {z}], "angular_velocity": [3, 2, 1]}}"#
            )
        })
        .collect();
    let text = format!(
        r#"{{"schema": "scene/1", "name": "cubes", "gravity": [0, 0, -9.81], "ground": {{"normal": [0, 0, 1], "offset": 0}}, "bodies": [{}],
            "material": {{"friction": 0.5, "restitution": 0.2}}, "duration": 2.5}}"#,
        bodies.join(", ")
    );
    Scene::from_json(&text).expect("a valid scene")
}

/// Steps, contacts, time of the simulation and of its certificates.
fn measured(n: usize) -> (usize, usize, Duration, Duration) {
    let (h, steps) = (0.005, 500);
    let (mechanism, initial) = cubes(n).spatial_mechanism().expect("cubes are bodies in space");
    let begun = Instant::now();
    simulate(&MoreauJean::default(), &Auto, &*mechanism, initial.clone(), h, steps).expect("it runs");
    let all = begun.elapsed();
    let kept = Kept::default();
    simulate(&MoreauJean::default(), &kept, &*mechanism, initial, h, steps).expect("it runs");
    let kept = kept.0.into_inner().expect("no other thread panics");
    let mut judge = Judge::default();
    let begun = Instant::now();
    for (problem, solution) in &kept {
        let judged = judge.judge(problem, solution).expect("it fits");
        assert!(judged.relative() <= CERTIFY, "{}: {:e}", problem.name(), judged.relative());
    }
    (kept.len(), kept.iter().map(|(problem, _)| problem.contacts()).max().unwrap_or(0), all, begun.elapsed())
}

fn main() {
    println!("cubes  problems  contacts  simulation [ms]  certificates [ms]  share");
    for n in [1, 2, 4, 8] {
        let (problems, contacts, all, certified) = measured(n);
        let share = 100.0 * certified.as_secs_f64() / all.as_secs_f64();
        println!(
            "{n:5}  {problems:8}  {contacts:8}  {:15.2}  {:17.3}  {share:4.1} %",
            1e3 * all.as_secs_f64(),
            1e3 * certified.as_secs_f64()
        );
    }
}
