//! A stored file as JSON, and the part every file has: who made it, with which version, script and options.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::tolerance::references as tolerance;
use nalgebra::DVector;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The engine versions the repository pins.
pub const VERSIONS: [(&str, &str); 6] =
    [("mujoco", "3.17.0"), ("drake", "1.51.1"), ("bullet", "3.2.7"), ("pinocchio", "4.1.0"), ("dart", "6.20.0"), ("rapier", "0.36.1")];

/// One stored file.
pub struct Document {
    /// The file's text.
    pub text: String,
    /// Its content.
    pub value: Value,
    /// Its name.
    pub name: String,
}

impl Document {
    /// Reads a file.
    pub fn read(file: &Path) -> Result<Self, Failed> {
        let text = std::fs::read_to_string(file)?;
        let value = serde_json::from_str(&text)?;
        Ok(Document { text, value, name: file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default() })
    }

    /// The format's name.
    pub fn schema(&self) -> &str {
        self.value["schema"].as_str().unwrap_or("")
    }

    /// The configuration's name, for instance `newton-elliptic`.
    pub fn config(&self) -> &str {
        self.value["provenance"]["config"].as_str().unwrap_or("")
    }

    /// `mujoco`, `drake`, ….
    pub fn engine(&self) -> &str {
        self.value["provenance"]["engine"].as_str().unwrap_or("")
    }

    /// A number under `provenance`, `native`, …
    pub fn number(&self, path: &[&str]) -> Result<f64, Failed> {
        number(path.iter().fold(&self.value, |value, key| &value[key])).ok_or_else(|| format!("no number at {path:?}").into())
    }

    /// A vector at a path.
    pub fn vector(&self, path: &[&str]) -> Result<DVector<f64>, Failed> {
        vector(path.iter().fold(&self.value, |value, key| &value[key])).ok_or_else(|| format!("no vector at {path:?}").into())
    }

    /// How far the engine itself determines a kind of number (`bodies/position`, …) of size at most `size`: rounding amplified as
    /// measured when the file was made, and the effect of the engine's stopping tolerance, also measured then.
    pub fn accuracy(&self, kind: &str, size: f64) -> Result<f64, Failed> {
        let stored = &self.value["provenance"]["sensitivity"][kind];
        let [amplification, stopping] = [0, 1].map(|k| number(&stored[k]).ok_or_else(|| format!("no sensitivity of {kind}")));
        let steps = self.number(&["provenance", "steps"])?;
        Ok(tolerance::stored_number(amplification?, stopping?, steps, size))
    }

    /// Engine, pinned version, script, scene, options and step are stored, and the file's name repeats configuration and scene.
    pub fn provenance(&self) -> Result<Vec<Finding>, Failed> {
        let provenance = &self.value["provenance"];
        let version = VERSIONS.iter().find(|(engine, _)| *engine == self.engine()).map_or("", |(_, version)| version);
        let stored = |key: &str| provenance[key].as_str().unwrap_or("");
        let scene = stored("scene").trim_start_matches("scenes/").trim_end_matches(".json").to_string();
        let prefix = format!("{scene}__{}__h", self.config());
        let present = ["options", "sensitivity"].iter().all(|key| provenance[key].is_object())
            && ["time_step", "steps", "script_version"].iter().all(|key| provenance[key].is_number());
        Ok(vec![
            Finding::decision("the engine's version is the pinned one", stored("version") == version && !version.is_empty(), true),
            Finding::decision(
                "script, scene and request are named",
                ["script", "scene", "request"].iter().all(|key| !stored(key).is_empty()),
                true,
            ),
            Finding::decision("options, step, number of steps and sensitivity are stored", present, true),
            Finding::decision("the file is named after its scene and configuration", self.name.starts_with(&prefix), true),
        ])
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_f64()
}

fn vector(value: &Value) -> Option<DVector<f64>> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    numbers.map(DVector::from_vec)
}

/// The stored files of one engine, in alphabetical order.
pub fn stored(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.sort();
    files
}
