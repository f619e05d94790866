//! A check: one question to an engine, the derivation of what is expected, and the planted mistakes it catches.

use crate::{Bench, Measurement, Reply};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a check asks of an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// The motion of scenes.
    Simulate,
    /// Solutions of contact problems.
    Solve,
    /// Projections on friction cones.
    Project,
    /// The engine's own step problems; the gate does not ask for them.
    Dump,
}

/// How a check runs.
#[derive(Clone, Copy)]
pub enum Run {
    /// At every time step h \[s\] of the sweep.
    EachStep(fn(&mut Bench, f64) -> Reply<Vec<Measurement>>),
    /// Once: the question has no time step.
    Once(fn(&mut Bench) -> Reply<Vec<Measurement>>),
}

/// One question, the same for every engine.
pub struct Check {
    /// `family/what`.
    pub name: &'static str,
    /// What it asks for.
    pub level: Level,
    /// The question, in one sentence.
    pub question: &'static str,
    /// Where the expected values and allowances come from: equations, in text.
    pub derivation: &'static str,
    /// Literature or section of the chapter.
    pub source: &'static str,
    /// The measurement.
    pub run: Run,
    /// The control: a reference scheme that must pass, and a planted defect that must fail.
    pub control: Control,
}

/// Shows that a check can pass and can fail.
pub struct Control {
    /// One of our schemes, by its name as an engine.
    pub passes: &'static str,
    /// A planted defect, by name.
    pub fails: &'static str,
}

/// The derived verdict of one of our schemes on a check. What is not listed passes.
pub struct Expected {
    /// `moreau-jean`, `stewart-trinkle` or `anitescu`.
    pub scheme: &'static str,
    /// The check, by name.
    pub check: &'static str,
    /// The verdict that theory demands.
    pub verdict: crate::Verdict,
    /// Why, with the predicted value or bound.
    pub why: &'static str,
}

impl Check {
    /// The part of the name before the slash.
    pub fn family(&self) -> &'static str {
        self.name.split('/').next().unwrap_or(self.name)
    }
}

/// Every check, family by family.
pub fn all() -> impl Iterator<Item = &'static Check> {
    crate::checks::FAMILIES.iter().copied().flatten()
}

/// The check with this name.
pub fn find(name: &str) -> Option<&'static Check> {
    all().find(|check| check.name == name)
}
