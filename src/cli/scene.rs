//! What `simulate` and `compare` ask of a scene: its name or file, and its steps.

use super::near::suggestion;
use crate::number::significant;
use crate::scenes::{self, Scene, Staged};
use crate::tolerance::cli::STEP_LIMIT;
use crate::{Error, Result};
use moreau_replicas::staging::for_scheme;
use std::path::Path;

/// A linkage or a scene of bodies, ready to run with a scheme.
pub fn stage(name: &str, argument: &str, scheme: &str) -> Result<Staged> {
    match scenes::linkage(name) {
        Some(linkage) => linkage.staged(),
        None => for_scheme(&find(name, argument)?, scheme),
    }
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
