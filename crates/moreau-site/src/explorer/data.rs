//! The stored runs as scripts, one per scene, that a page loads from a disk.
//!
//! ```text
//!     moreau.keep("ball", { "bodies": […], "ground": […], "runs": { "anitescu h=1/60 mu=0.5 e=0": {"run": 3, "note": "…"}, … },
//!                           "stored": [ { "h": …, "steps": …, "data": "…" }, { "refused": "…" }, … ] })
//! ```

use super::grid::{Choice, SceneEntry};
use super::run::{Run, compute, posed};
use moreau_dynamics::mechanics::spatial::Shape;
use moreau_dynamics::scenes::Scene;
use moreau_exact::{Error, Result};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// A run that there is, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Stored {
    /// The run.
    Run(Box<Run>),
    /// What the scheme says.
    Refused {
        /// The error, as the command line prints it.
        refused: String,
    },
}

/// The runs of a scene.
#[derive(Serialize)]
pub struct SceneRuns {
    bodies: Vec<Drawn>,
    /// n_x, n_z and c of the plane n·x = c.
    ground: Option<[f64; 3]>,
    runs: BTreeMap<String, Told>,
    stored: Vec<Stored>,
}

/// A body as it is drawn: its name, and radius or half the edges in the plane \[m\].
#[derive(Serialize)]
struct Drawn {
    name: String,
    size: Vec<f64>,
}

/// Which stored run belongs to a point of the grid, the file of its scene, and what was changed for the scheme.
#[derive(Serialize)]
struct Told {
    run: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'static str>,
}

/// What is to be computed: points of the grid that pose the same scene to the same scheme are one.
struct Job {
    choice: Choice,
    scene: Scene,
    points: Vec<(String, Option<&'static str>)>,
}

/// Computes the run of a point of the grid, or stores why there is none.
pub fn stored(choice: &Choice, scene: &Scene) -> Stored {
    match compute(choice, scene) {
        Ok(run) => Stored::Run(Box::new(run)),
        Err(error) => Stored::Refused { refused: error.to_string() },
    }
}

/// The script of each of these scenes by name; `progress` is told how many runs are done, and of how many.
///
/// # Errors
/// If a scene of the table is not valid.
pub fn scripts(scenes: &[SceneEntry], progress: &(dyn Fn(usize, usize) + Sync)) -> Result<Vec<(String, String)>> {
    let scenes = scenes.iter().map(|entry| Ok((entry, jobs(entry)?))).collect::<Result<Vec<_>>>()?;
    let total = scenes.iter().map(|(_, jobs)| jobs.len()).sum();
    let done = AtomicUsize::new(0);
    let run = |job: &Job| {
        let run = stored(&job.choice, &job.scene);
        progress(done.fetch_add(1, Relaxed) + 1, total);
        run
    };
    let script = |(entry, jobs): (&SceneEntry, Vec<Job>)| {
        let stored = jobs.par_iter().map(run).collect();
        Ok((format!("{}.js", entry.id), script(entry, jobs, stored)?))
    };
    scenes.into_iter().map(script).collect()
}

fn jobs(entry: &SceneEntry) -> Result<Vec<Job>> {
    let mut jobs: Vec<Job> = Vec::new();
    for choice in entry.choices() {
        let (scene, note) = posed(&choice)?;
        let same = |job: &&mut Job| {
            let parameters = |one: &Choice| (one.scheme, one.step, one.theta);
            parameters(&job.choice) == parameters(&choice) && job.scene == scene
        };
        let point = (choice.key(), note);
        match jobs.iter_mut().find(same) {
            Some(job) => job.points.push(point),
            None => jobs.push(Job { choice, scene, points: vec![point] }),
        }
    }
    Ok(jobs)
}

fn script(entry: &SceneEntry, jobs: Vec<Job>, stored: Vec<Stored>) -> Result<String> {
    let scene = entry.with(entry.friction[0], entry.restitution[0])?;
    let told = |(run, job): (usize, Job)| job.points.into_iter().map(move |(key, note)| (key, Told { run, note }));
    let runs = SceneRuns {
        bodies: scene.bodies.iter().map(|body| Ok(Drawn { name: body.name.clone(), size: size(body.shape()?) })).collect::<Result<_>>()?,
        ground: scene.ground.map(|ground| [ground.normal[0], ground.normal[2], ground.offset]),
        runs: jobs.into_iter().enumerate().flat_map(told).collect(),
        stored,
    };
    let text = serde_json::to_string(&runs).map_err(Error::from)?;
    Ok(format!("moreau.keep({:?}, {text});\n", entry.id))
}

/// The radius, or half the edges along x and z \[m\].
fn size(shape: Shape) -> Vec<f64> {
    match shape {
        Shape::Sphere { radius } | Shape::Capsule { radius, .. } | Shape::Cylinder { radius, .. } => vec![radius],
        Shape::Box { half_extents: [x, _, z] } => vec![x, z],
    }
}

#[cfg(test)]
mod tests {
    use super::super::code::decode;
    use super::super::grid::SCENES;
    use super::super::run::WIDTHS;
    use super::*;
    use serde_json::Value;
    use std::collections::BTreeSet;
    use std::sync::Mutex;

    #[test]
    fn a_script_holds_every_run_of_its_scene_as_its_program_reads_it() {
        let cradle = SCENES.iter().position(|entry| entry.id == "cradle").expect("it is listed");
        let told = Mutex::new(Vec::new());
        let scripts = scripts(&SCENES[cradle..=cradle], &|done, of| told.lock().expect("no panic").push((done, of))).expect("valid");
        let [(name, text)] = &scripts[..] else { panic!("one scene has one script") };
        let json = text.strip_prefix("moreau.keep(\"cradle\", ").and_then(|rest| rest.strip_suffix(");\n")).expect("one call");
        let value: Value = serde_json::from_str(json).expect("JSON");
        let (runs, stored) = (value["runs"].as_object().expect("runs"), value["stored"].as_array().expect("a list"));
        assert_eq!((name.as_str(), runs.len()), ("cradle.js", SCENES[cradle].choices().len()));
        for (key, told) in runs {
            let run = &stored[told["run"].as_u64().expect("an index") as usize];
            let (steps, contacts) = (run["steps"].as_u64().expect("steps") as usize, run["contacts"].as_array().expect("contacts").len());
            let channels = decode(run["data"].as_str().expect("text"), steps + 1).expect("a run");
            assert_eq!(channels.len(), 5 * WIDTHS[0] + WIDTHS[1] + contacts * WIDTHS[2], "{key}");
            assert!(
                key.contains(&format!(
                    "h={}",
                    if steps == 36 {
                        "1/60"
                    } else if steps == 144 {
                        "1/240"
                    } else {
                        "1/1000"
                    }
                )),
                "{key}"
            );
        }
        let mut told = told.into_inner().expect("no panic");
        told.sort_unstable();
        assert_eq!(told, (1..=stored.len()).map(|done| (done, stored.len())).collect::<Vec<_>>());
    }

    #[test]
    fn every_point_of_the_grid_has_its_run_and_what_does_not_act_is_computed_once() {
        for entry in &SCENES {
            let (jobs, choices) = (jobs(entry).expect("a scene"), entry.choices());
            let told: BTreeSet<_> = jobs.iter().flat_map(|job| &job.points).map(|(key, _)| key.clone()).collect();
            assert_eq!(told, choices.iter().map(Choice::key).collect(), "{}", entry.id);
            assert_eq!(jobs.iter().map(|job| job.points.len()).sum::<usize>(), choices.len(), "{}", entry.id);
            // e acts in Moreau–Jean alone: three values of θ, and four schemes that take e = 0
            let expected = 3 * entry.friction.len() * (3 * entry.restitution.len() + 4);
            assert_eq!(jobs.len(), expected, "{}", entry.id);
        }
        let noted = jobs(&SCENES[0]).expect("the ball");
        let notes = |scheme: &str| {
            let points = noted.iter().filter(|job| job.choice.scheme == scheme).flat_map(|job| &job.points);
            points.filter(|(_, note)| note.is_some()).count()
        };
        assert_eq!((notes("anitescu"), notes("moreau-jean")), (9, 0), "a scheme without restitution says so where e > 0");
    }
}
