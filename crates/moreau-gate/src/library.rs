//! Stored trajectories as an engine: a simulator that cannot be started here is judged by the files it left.
//!
//! A request is answered by the file with the same scene – gravity, ground, bodies, material; names and descriptions of scenes do not
//! matter – and the same time step, if it has the samples that are asked for. Of several files the longest one that has them answers,
//! and of those that are equally long the one with the most samples; two that differ only in their motions answer nothing.

use crate::tolerance::SAME_TIME;
use crate::{Description, Engine, Options, Refusal, Reply};
use moreau_contact::files::{read_object, read_text};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::{Error, Result};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How the reason begins for which a stored motion does not answer.
pub const LACKS_SAMPLES: &str = "the stored trajectory of";

/// How the reason begins where there is no motion of a scene at a time step.
pub const NOT_STORED: &str = "no stored trajectory of";

/// Trajectories of one engine.
#[derive(Clone)]
pub struct Library {
    description: Description,
    trajectories: Arc<Vec<Trajectory>>,
}

impl Library {
    /// Reads the files; all must be of one engine and version. `description` tells its contact model.
    ///
    /// # Errors
    /// Those of [`Trajectory::read`]; [`Error::Invalid`] if there is no file or the engines differ.
    pub fn read(files: &[PathBuf], description: Option<Description>) -> Result<Self> {
        let trajectories = files.iter().map(|file| Trajectory::read(file)).collect::<Result<Vec<_>>>()?;
        let first =
            trajectories.first().ok_or_else(|| Error::invalid("--trajectory", "names no file", "give one or more files trajectory/1"))?;
        for (file, trajectory) in files.iter().zip(&trajectories) {
            if (&trajectory.engine.name, &trajectory.engine.version) != (&first.engine.name, &first.engine.version) {
                let problem = format!("is of {} {}", trajectory.engine.name, trajectory.engine.version);
                let cure =
                    format!("judge each engine by itself; {} is of {} {}", files[0].display(), first.engine.name, first.engine.version);
                return Err(Error::invalid("engine", problem, cure).in_file(file));
            }
        }
        let description = description.unwrap_or_else(|| undeclared(first, &trajectories));
        Ok(Library { description, trajectories: Arc::new(trajectories) })
    }

    /// The stored trajectories.
    pub fn trajectories(&self) -> &[Trajectory] {
        &self.trajectories
    }
}

/// What can be said of an engine that did not describe itself: it is held to Coulomb–Signorini.
fn undeclared(first: &Trajectory, all: &[Trajectory]) -> Description {
    use crate::description::{BodyKind, Friction, Precision, ShapeKind};
    Description {
        name: first.engine.name.clone(),
        version: first.engine.version.clone(),
        precision: Precision::Double,
        contact_model: crate::ContactModel { kind: crate::Kind::Rigid, law: Some("coulomb".into()), parameters: Default::default() },
        restitution: true,
        friction: Friction::Cone,
        reports_contacts: all.iter().any(|trajectory| !trajectory.contacts.is_empty()),
        levels: vec![crate::Level::Simulate],
        laws: Vec::new(),
        shapes: ShapeKind::ALL.to_vec(),
        bodies: BodyKind::ALL.to_vec(),
        sleeping: None,
        options: first.engine.options.clone(),
    }
}

impl Engine for Library {
    fn describe(&mut self, _options: &Options) -> Reply<Description> {
        Ok(self.description.clone())
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, _options: &Options) -> Reply<Trajectory> {
        let is_of = |stored: &&Trajectory| same_step(stored, time_step) && same_scene(&stored.scene, scene);
        let mut matching: Vec<&Trajectory> = self.trajectories.iter().filter(is_of).collect();
        matching.sort_by(|one, other| length(other).partial_cmp(&length(one)).unwrap_or(std::cmp::Ordering::Equal));
        let longest = matching.first().ok_or_else(|| {
            Refusal::unsupported(format!("{NOT_STORED} the scene `{}` at h = {time_step} s (see `moreau gate --write-scenes`)", scene.name))
        })?;
        let steps = (scene.duration / time_step).round() as usize;
        let answer_of =
            |stored: &&Trajectory| resampled(stored, scene, time_step, steps, sample_every).map(|answer| (length(stored), answer));
        let mut answers = matching.iter().filter_map(answer_of);
        let (chosen, answer) = answers.next().ok_or_else(|| {
            Refusal::unsupported(format!(
                "{LACKS_SAMPLES} `{}` lacks samples: every {sample_every} steps up to {} s; its last one is at {} s",
                scene.name,
                scene.duration,
                length(longest).0
            ))
        })?;
        if answers.any(|(other, of_other)| other == chosen && of_other.bodies != answer.bodies) {
            let problem = format!("two stored trajectories of the scene `{}` at h = {time_step} s are equally long and differ", scene.name);
            return Err(Refusal::errored(format!("{problem}: give one of them")));
        }
        Ok(answer)
    }
}

/// How long a motion is, \[s\], and how many samples it has.
fn length(stored: &Trajectory) -> (f64, usize) {
    (stored.times.last().copied().unwrap_or_default(), stored.times.len())
}

fn same_step(stored: &Trajectory, time_step: f64) -> bool {
    (stored.time_step - time_step).abs() <= SAME_TIME * time_step
}

fn same_scene(stored: &Scene, asked: &Scene) -> bool {
    let ground = |scene: &Scene| scene.ground.map(|ground| (ground.normal, ground.offset));
    stored.gravity == asked.gravity && ground(stored) == ground(asked) && stored.bodies == asked.bodies && stored.material == asked.material
}

/// The samples that are asked for out of those that are stored; contact impulses are summed over the longer intervals.
fn resampled(stored: &Trajectory, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Option<Trajectory> {
    let wanted = (0..=steps / sample_every).map(|k| (k * sample_every) as f64 * time_step);
    let place = |time: f64| stored.times.iter().position(|t| (t - time).abs() <= SAME_TIME * scene.duration);
    let places: Vec<usize> = wanted.map(place).collect::<Option<_>>()?;
    let pick = |list: &Vec<[f64; 3]>| places.iter().map(|&k| list[k]).collect::<Vec<_>>();
    let mut picked = stored.clone();
    picked.scene = scene.clone();
    picked.times = places.iter().map(|&k| stored.times[k]).collect();
    for (track, old) in picked.bodies.iter_mut().zip(&stored.bodies) {
        track.position = pick(&old.position);
        track.orientation = places.iter().map(|&k| old.orientation[k]).collect();
        track.linear_velocity = pick(&old.linear_velocity);
        track.angular_velocity = pick(&old.angular_velocity);
    }
    // a contact at stored sample k belongs to the first picked sample at or after k
    picked.contacts.retain_mut(|contact| match places.iter().position(|&k| k >= contact.sample) {
        Some(sample) => {
            contact.sample = sample;
            true
        }
        None => false,
    });
    Some(picked)
}

/// The scenes that checks ask for, as files a simulator can be run on elsewhere.
pub struct Requests {
    /// The engine that answers each request, so that checks with several requests can go on.
    pub inner: Box<dyn Engine>,
    /// What the simulator says of itself that is run elsewhere, for it decides what is asked; that of `inner` without it.
    pub description: Option<Description>,
    /// What was asked: scene, h \[s\], `sample_every`.
    pub asked: Arc<std::sync::Mutex<Vec<(Scene, f64, usize)>>>,
}

impl Engine for Requests {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.description.clone().map_or_else(|| self.inner.describe(options), Ok)
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        if let Ok(mut asked) = self.asked.lock() {
            asked.push((scene.clone(), time_step, sample_every));
        }
        self.inner.simulate(scene, time_step, sample_every, options)
    }
}

/// Reads the description that goes with stored trajectories.
///
/// # Errors
/// [`Error::Read`], or [`Error::Invalid`] with the field and the file's name.
pub fn read_description(file: &Path) -> Result<Description> {
    let text = read_text(file)?;
    let read = read_object::<Description>(&text, "description").and_then(|description| description.validate().map(|()| description));
    read.map_err(|error| error.in_file(file))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_dynamics::scenes::{Ground, named};

    /// A motion of two balls over eight steps of h = 1/8 s.
    fn stored() -> Trajectory {
        let scene = Scene { duration: 1.0, ..named("two-ball-impact").expect("built in") };
        crate::own::by_name("moreau-jean").expect("listed").simulate(&scene, 0.125, 1, &Options::new()).expect("simulates")
    }

    fn of(stored: Trajectory) -> Library {
        all_of(vec![stored])
    }

    fn all_of(stored: Vec<Trajectory>) -> Library {
        Library { description: undeclared(&stored[0], &stored), trajectories: Arc::new(stored) }
    }

    /// The first samples of a motion, or every other one.
    fn part(whole: &Trajectory, count: usize, every: usize) -> Trajectory {
        let scene = Scene { duration: 0.125 * (count * every) as f64, ..whole.scene.clone() };
        resampled(whole, &scene, 0.125, count * every, every).expect("it has them")
    }

    #[test]
    fn of_several_files_the_longest_that_has_the_samples_answers_in_any_order() {
        let (right, mut whole, scene) = (stored(), stored(), stored().scene);
        // a mistake that the others do not have
        whole.bodies[0].position[4][1] = 7.0;
        let parts = [part(&right, 4, 1), part(&right, 4, 2), whole];
        for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            let mut library = all_of(order.map(|k| parts[k].clone()).to_vec());
            for (every, duration) in [(1, 1.0), (4, 1.0), (1, 0.5)] {
                let asked = Scene { duration, ..scene.clone() };
                let answer = library.simulate(&asked, 0.125, every, &Options::new()).unwrap_or_else(|told| panic!("{order:?}: {told}"));
                assert!(answer.bodies[0].position.iter().any(|place| place[1] == 7.0), "{order:?}: every {every}, {duration} s");
            }
            // one that is longer but has too few samples is no answer, and hides none
            let mut library = all_of(order.map(|k| [parts[0].clone(), parts[1].clone(), parts[0].clone()][k].clone()).to_vec());
            assert!(library.simulate(&Scene { duration: 0.5, ..scene.clone() }, 0.125, 1, &Options::new()).is_ok(), "{order:?}");
        }
    }

    #[test]
    fn two_files_that_are_equally_long_and_differ_answer_nothing_in_any_order() {
        let (right, mut wrong) = (stored(), stored());
        wrong.bodies[0].position[8][1] = 7.0;
        for pair in [vec![right.clone(), wrong.clone()], vec![wrong, right.clone()]] {
            let told = all_of(pair).simulate(&right.scene, 0.125, 1, &Options::new()).expect_err("which one?").to_string();
            assert!(told.contains("equally long and differ: give one of them"), "{told}");
        }
        let twice = all_of(vec![right.clone(), right.clone()]).simulate(&right.scene, 0.125, 1, &Options::new());
        assert!(twice.is_ok(), "the same file twice");
    }

    #[test]
    fn a_request_is_answered_by_the_file_of_the_same_scene_and_step_only() {
        let (mut library, scene) = (of(stored()), stored().scene);
        let mut is_answered = |scene: &Scene, h: f64, every: usize| library.simulate(scene, h, every, &Options::new()).is_ok();
        assert!(is_answered(&scene, 0.125, 1) && is_answered(&scene, 0.125, 4));
        let renamed = Scene { name: "another name".into(), description: "of the same".into(), ..scene.clone() };
        assert!(is_answered(&renamed, 0.125, 1));
        assert!(!is_answered(&scene, 0.25, 1) && !is_answered(&Scene { duration: 2.0, ..scene.clone() }, 0.125, 1));
        type Change = fn(&mut Scene);
        let others: [Change; 5] = [
            |scene| scene.gravity[1] += 1.0,
            |scene| scene.ground = Some(Ground { normal: [0.0, 0.0, 1.0], offset: -9.0 }),
            |scene| scene.bodies[1].mass *= 2.0,
            |scene| scene.material.restitution = 0.25,
            |scene| scene.material.friction += 0.25,
        ];
        for (index, change) in others.iter().enumerate() {
            let mut other = scene.clone();
            change(&mut other);
            assert!(!is_answered(&other, 0.125, 1), "{index}");
        }
    }

    #[test]
    fn a_contact_is_told_with_the_sample_that_ends_its_interval_and_not_after_the_last() {
        let mut whole = stored();
        let contact = moreau_dynamics::trajectory::ContactRecord {
            sample: 0,
            bodies: [0, 1].map(|k| whole.scene.bodies[k].name.clone()),
            normal: [1.0, 0.0, 0.0],
            impulse: [1.0, 0.0, 0.0],
        };
        whole.contacts = (1..=8).map(|sample| moreau_dynamics::trajectory::ContactRecord { sample, ..contact.clone() }).collect();
        let picked = |every: usize, duration: f64| {
            let scene = Scene { duration, ..whole.scene.clone() };
            let answer = of(whole.clone()).simulate(&scene, 0.125, every, &Options::new()).expect("stored");
            (answer.times, answer.contacts.iter().map(|contact| contact.sample).collect::<Vec<_>>())
        };
        assert_eq!(picked(1, 1.0).1, [1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(picked(4, 1.0), (vec![0.0, 0.5, 1.0], vec![1, 1, 1, 1, 2, 2, 2, 2]));
        assert_eq!(picked(2, 0.5), (vec![0.0, 0.25, 0.5], vec![1, 1, 2, 2]));
    }
}
