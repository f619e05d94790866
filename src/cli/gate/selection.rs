//! What the arguments select: checks, time steps, options.

use super::Arguments;
use crate::cli::near::suggestion;
use crate::cli::number::number;
use crate::gate::{Check, Level, Options, checks, runner};
use crate::{Error, Result};

/// The selected checks, in the order of the registry.
pub fn checks(arguments: &Arguments) -> Result<Vec<&'static Check>> {
    for (option, names) in [("--only", &arguments.only), ("--skip", &arguments.skip)] {
        if names.iter().any(|name| name.trim().is_empty()) {
            // it is contained in every name
            return Err(Error::invalid(option, "has an empty name", "name checks or parts of their names, separated by commas"));
        }
    }
    for name in arguments.only.iter().chain(&arguments.skip) {
        if !checks::all().any(|check| check.name.contains(name.as_str())) {
            let cure = suggestion(name, checks::all().map(|check| check.name), "`moreau gate --list` shows every check");
            return Err(Error::Unsupported(format!("no check contains `{name}`; {cure}")));
        }
    }
    let is_of_files = !arguments.trajectory.is_empty() || arguments.write_scenes.is_some();
    let level = match (arguments.solver, arguments.projection) {
        (true, _) => Some(Level::Solve),
        (_, true) => Some(Level::Project),
        _ if is_of_files => Some(Level::Simulate),
        _ => None,
    };
    let named = |list: &[String], check: &Check| list.iter().any(|name| check.name.contains(name.as_str()));
    let is_chosen = |check: &Check| (arguments.only.is_empty() || named(&arguments.only, check)) && !named(&arguments.skip, check);
    let chosen: Vec<_> = checks::all().filter(|check| is_chosen(check)).collect();
    let selected: Vec<_> = chosen.iter().copied().filter(|check| level.is_none_or(|level| check.level == level)).collect();
    let is_of_motions = selected.iter().any(|check| check.level == Level::Simulate);
    if arguments.write_scenes.is_some() && !chosen.is_empty() && !is_of_motions {
        let problem = "has no scene to write: contact solvers and cone projections are not judged by files";
        let cure = "judge them as a program, `moreau gate --solver -- COMMAND`, or choose checks of motions with `--only`";
        return Err(Error::invalid("--write-scenes", problem, cure));
    }
    if selected.is_empty() {
        return Err(none_left(arguments));
    }
    Ok(selected)
}

/// The options that left no check.
fn none_left(arguments: &Arguments) -> Error {
    let asked = [
        ("--only", !arguments.only.is_empty()),
        ("--skip", !arguments.skip.is_empty()),
        ("--solver", arguments.solver),
        ("--projection", arguments.projection),
        ("--trajectory", !arguments.trajectory.is_empty()),
        ("--write-scenes", arguments.write_scenes.is_some()),
    ];
    let options: Vec<&str> = asked.into_iter().filter_map(|(option, is_asked)| is_asked.then_some(option)).collect();
    let problem = if options.len() > 1 { "leave no check together" } else { "leaves no check" };
    Error::invalid(options.join("` and `"), problem, "`moreau gate --list` shows every check with its level")
}

/// The time steps of the sweep \[s\].
pub fn sweep(arguments: &Arguments) -> Result<Vec<f64>> {
    if arguments.quick {
        return Ok(runner::QUICK.to_vec());
    }
    if arguments.steps.is_empty() {
        return Ok(runner::SWEEP.to_vec());
    }
    let steps = arguments.steps.iter().map(|text| step(text)).collect::<Result<Vec<_>>>()?;
    match steps.iter().enumerate().find(|(k, h)| steps[..*k].contains(h)) {
        Some((_, twice)) => Err(Error::invalid("--steps", format!("has {twice} twice"), "name each time step once")),
        None => Ok(steps),
    }
}

/// A number of seconds, also as a fraction `1/240`.
fn step(text: &str) -> Result<f64> {
    number(text)
        .filter(|h| h.is_finite() && *h > 0.0)
        .ok_or_else(|| Error::invalid("--steps", format!("has `{text}`"), "use positive seconds, such as 0.001 or 1/240"))
}

/// The options for every request.
pub fn options(arguments: &Arguments) -> Result<Options> {
    let mut options = Options::new();
    for text in &arguments.options {
        let (name, value) = text.split_once('=').ok_or_else(|| Error::invalid("--option", format!("is `{text}`"), "use NAME=VALUE"))?;
        let value = serde_json::from_str(value).unwrap_or_else(|_| value.into());
        if options.insert(name.into(), value).is_some() {
            return Err(Error::invalid("--option", format!("names `{name}` twice"), "give each option once"));
        }
    }
    Ok(options)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_numbers_or_fractions() {
        assert_eq!(step("1/240").ok(), Some(1.0 / 240.0));
        assert_eq!(step("0.001").ok(), Some(0.001));
        for wrong in ["0", "-1", "1/0", "x", "nan", "1/2/3", ""] {
            assert!(step(wrong).is_err(), "{wrong}");
        }
    }
}
