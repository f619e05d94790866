//! The stored results of the scoreboard, embedded: it can be shown where there is no checkout.

use crate::Result;
use crate::gate::cause::{self, Cause};
use crate::gate::scoreboard::{Engines, Entry, Standing};

macro_rules! embedded {
    ($folder:literal, $end:literal: $($name:literal,)*) => { &[$(($name, include_str!(concat!("../", $folder, "/", $name, $end)))),*] };
}

/// The list of engines.
const ENGINES: &str = include_str!("../scripts/engines/engines.json");

/// What was found of each, by its name.
const STANDINGS: &[(&str, &str)] = embedded![
    "references/scoreboard", ".json":
    "moreau-jean",
    "stewart-trinkle",
    "anitescu",
    "mujoco",
    "mujoco-elliptic",
    "mujoco-elliptic-impratio10",
    "mujoco-elliptic-impratio100",
    "mujoco-pgs",
    "drake-sap",
    "drake-lagged",
    "drake-similar",
    "drake-tamsi",
    "siconos",
    "siconos-orthonormal",
    "bullet",
    "bullet-box-ground",
    "dart",
    "dart-ode",
    "dart-ode-nsgs",
    "sapien",
    "rapier-0.36",
    "rapier-0.36-coulomb",
    "rapier-0.34",
    "rapier-0.34-coulomb",
    "rapier-0.35-beta",
    "rapier-0.35-beta-box-ground",
    "pinocchio-admm",
    "pinocchio-pgs",
];

/// Why checks are not passed.
const CAUSES: &[(&str, &str)] = embedded![
    "references/scoreboard/causes", ".toml":
    "bullet",
    "dart",
    "drake",
    "mujoco",
    "pinocchio",
    "rapier",
    "sapien",
    "siconos",
];

/// The stored result of every engine of the list, and the causes; an engine without one was never run.
///
/// # Errors
/// If what is embedded cannot be read, which a test excludes.
///
/// ```
/// use moreau::gate::cause;
///
/// let (standings, causes) = moreau::board::stored()?;
/// let rapier = standings.iter().find(|standing| standing.entry.name == "rapier-0.36").and_then(|one| one.report.as_ref());
/// let stack = rapier.expect("stored").checks.iter().find(|outcome| outcome.check == "stack/ten").expect("a check");
/// assert_eq!(stack.verdict.is_bad(), cause::find(&causes, "rapier-0.36", "stack/ten").is_some());
/// # Ok::<(), moreau::Error>(())
/// ```
pub fn stored() -> Result<(Vec<Standing>, Vec<Cause>)> {
    let standing = |entry: Entry| match STANDINGS.iter().find(|(name, _)| *name == entry.name) {
        Some((_, text)) => Standing::from_json(text),
        None => Ok(Standing { entry, report: None, not_run: Some("never".into()) }),
    };
    let standings = Engines::from_json(ENGINES)?.engines.into_iter().map(standing).collect::<Result<Vec<_>>>()?;
    let causes = CAUSES.iter().map(|(_, text)| cause::from_toml(text)).collect::<Result<Vec<_>>>()?;
    Ok((standings, causes.into_iter().flatten().collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The names of the files of a folder with this ending, without it.
    fn names(folder: &str, end: &str) -> Vec<String> {
        let entries = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).expect("the folder is packed");
        let names = entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned());
        let mut names: Vec<_> = names.filter_map(|name| Some(name.strip_suffix(end)?.to_string())).collect();
        names.sort();
        names
    }

    fn sorted(embedded: &[(&str, &str)]) -> Vec<String> {
        let mut names: Vec<_> = embedded.iter().map(|(name, _)| name.to_string()).collect();
        names.sort();
        names
    }

    #[test]
    fn every_stored_result_is_embedded_and_readable() {
        assert_eq!(sorted(STANDINGS), names("references/scoreboard", ".json"));
        assert_eq!(sorted(CAUSES), names("references/scoreboard/causes", ".toml"));
        let (standings, causes) = stored().expect("readable");
        assert!(standings.iter().all(|standing| standing.report.is_some()) && standings.len() >= STANDINGS.len());
        let on_disk = cause::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("references/scoreboard/causes")).expect("readable");
        assert_eq!(causes, on_disk);
    }
}
