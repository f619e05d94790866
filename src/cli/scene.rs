//! What `simulate` and `compare` ask of a scene: its name or file, and its steps.

use super::near::suggestion;
use crate::number::significant;
use crate::scenes::{self, Scene, Staged};
use crate::schemes::Scheme;
use crate::tolerance::cli::STEP_LIMIT;
use crate::{Error, Result};
use std::path::Path;

/// A linkage or a scene of bodies, ready to run with a scheme.
pub fn stage(name: &str, argument: &str, scheme: &str) -> Result<Staged> {
    match scenes::linkage(name) {
        Some(linkage) => linkage.staged(),
        None => for_scheme(&find(name, argument)?, scheme),
    }
}

/// The scene's mechanism. How soft a body rests depends on the number of its contact points, which is that of the body in space.
pub fn for_scheme(scene: &Scene, scheme: &str) -> Result<Staged> {
    let staged = scene.staged()?;
    if scheme != "mujoco" {
        return Ok(staged);
    }
    let (mechanism, start) = scene.spatial_mechanism()?;
    Ok(Staged { mechanism, start, ..staged })
}

/// A built-in scene of bodies by name, anything else as a file; `argument` names where it was given.
pub fn find(name: &str, argument: &str) -> Result<Scene> {
    if scenes::NAMES.contains(&name) {
        return scenes::named(name);
    }
    let file = Path::new(name);
    let looks_like_file = file.extension().is_some() || file.components().count() > 1;
    if !looks_like_file && !file.exists() {
        let names = || scenes::NAMES.into_iter().chain(scenes::LINKAGES.map(|linkage| linkage.name));
        let known = format!("use one of {}, or a file", names().collect::<Vec<_>>().join(", "));
        let cure = suggestion(name, names(), &known);
        return Err(Error::invalid(argument, format!("`{name}` is neither a built-in scene nor a file"), cure));
    }
    Scene::read(file)
}

/// The scene with e of every pair where it is given, and plastic for a scheme that has no restitution, with a note where that changes it.
pub fn plastic_if_needed(mut scene: Scene, scheme: &dyn Scheme, name: &str, restitution: Option<f64>) -> (Scene, Option<&'static str>) {
    let bounces = scene.material.restitution != 0.0 || scene.material.pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e != 0.0));
    let plastic = !scheme.has_restitution() && bounces;
    if let Some(restitution) = if plastic { Some(0.0) } else { restitution } {
        scene.material.restitution = restitution;
        scene.material.pairs.iter_mut().for_each(|pair| pair.restitution = None);
    }
    let note = if name == "mujoco" {
        "soft contact has no restitution: how far a body bounces follows from solref and solimp, not from the scene's e"
    } else {
        "this scheme has no restitution: every impact is plastic, e = 0 in place of the scene's"
    };
    (scene, plastic.then_some(note))
}

/// How many steps h \[s\] a duration \[s\] has.
pub fn count_steps(duration: f64, step: f64) -> Result<usize> {
    let step = positive("--step", step)?;
    let steps = (duration / step).round();
    let [h, count, length] = [step, steps, duration].map(significant);
    if steps < 1.0 {
        return Err(Error::invalid("--step", format!("is {h} s"), format!("the motion lasts {length} s")));
    }
    if steps > STEP_LIMIT as f64 {
        let problem = format!("is {h} s, {count} steps over {length} s");
        return Err(Error::invalid("--step", problem, format!("at most {STEP_LIMIT} steps are recorded")));
    }
    Ok(steps as usize)
}

/// A positive number of seconds.
pub fn positive(option: &str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::invalid(option, format!("is {value}"), "use a positive number of seconds"))
}
