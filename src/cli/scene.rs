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

/// The error of a scene's mechanism or motion, with the file where the scene is one; an option is nothing of the file.
pub fn in_scene(error: Error, name: &str) -> Error {
    match &error {
        Error::Invalid { field, .. } if !field.starts_with("--") && !scenes::NAMES.contains(&name) && Path::new(name).is_file() => {
            error.in_file(Path::new(name))
        }
        _ => error,
    }
}

/// The steps of a motion.
#[derive(Debug, PartialEq)]
pub struct Steps {
    /// How many.
    pub count: usize,
    /// How long they last together \[s\].
    pub lasts: f64,
    /// That this is another time than the one that was asked for, where it is.
    pub remark: Option<String>,
}

/// How many steps h \[s\] a duration \[s\] has: the nearest whole number, at least one.
pub fn count_steps(duration: f64, step: f64) -> Result<Steps> {
    let step = positive("--step", step)?;
    let steps = (duration / step).round();
    let [h, count, length, end] = [step, steps, duration, steps * step].map(significant);
    // what reads the same is the same but for rounding
    if duration < step && h != length {
        let cure = format!("give a step of at most {length} s, or a longer --duration");
        return Err(Error::invalid("--step", format!("is {h} s, and the motion lasts {length} s, which is less than a step"), cure));
    }
    if steps > STEP_LIMIT as f64 {
        let problem = format!("is {h} s, {count} steps over {length} s");
        let cure = format!("give a longer step or a shorter --duration: at most {STEP_LIMIT} steps are recorded");
        return Err(Error::invalid("--step", problem, cure));
    }
    if end == length {
        return Ok(Steps { count: steps as usize, lasts: duration, remark: None });
    }
    let made = if steps == 1.0 { "1 step is made".into() } else { format!("{count} steps are made") };
    let remark = format!("a duration of {length} s is no whole number of steps of {h} s: {made}, and the motion ends after {end} s");
    Ok(Steps { count: steps as usize, lasts: steps * step, remark: Some(remark) })
}

/// A positive number of seconds.
pub fn positive(option: &str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::invalid(option, format!("is {value}"), "use a positive number of seconds"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_of_steps_are_made_as_they_are_asked_for() {
        for (duration, step, count) in [(1.0, 0.1, 10), (2.0, 1.0 / 60.0, 120), (0.3, 0.1, 3), (1.0, 1.0, 1), (2.0, 0.016_666_67, 120)] {
            assert_eq!(count_steps(duration, step).expect("steps"), Steps { count, lasts: duration, remark: None }, "{duration} {step}");
        }
    }

    #[test]
    fn another_time_than_the_one_asked_for_is_told_with_both_numbers() {
        for (duration, step, count, end) in [(1.0, 0.3, 3, "0.9 s"), (1.0, 0.7, 1, "0.7 s"), (1.0, 0.4, 3, "1.2 s")] {
            let steps = count_steps(duration, step).expect("steps");
            let remark = steps.remark.expect("another time");
            assert_eq!((steps.count, significant(steps.lasts) + " s"), (count, end.to_string()));
            for word in [format!("a duration of {duration} s"), format!("steps of {step} s"), format!("ends after {end}")] {
                assert!(remark.contains(&word), "{word}: {remark}");
            }
        }
        for (duration, step) in [(1.0, 2.0), (1.0, 1.2), (1e-3, 1.0)] {
            let message = count_steps(duration, step).expect_err("less than a step").to_string();
            assert!(message.contains("`--step`") && message.contains("less than a step; give a step of at most"), "{message}");
        }
    }
}
