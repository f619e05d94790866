//! A check: one question to an engine, the derivation of what is expected, and the planted mistakes it catches.

pub use crate::description::Level;
use crate::{Bench, Measurement, Reply};

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

impl Expected {
    /// A scheme that has no coefficient of restitution does not answer this check.
    pub const fn without_restitution(scheme: &'static str, check: &'static str) -> Self {
        Expected { scheme, check, verdict: crate::Verdict::Unsupported, why: "the scheme has no coefficient of restitution" }
    }
}

impl Check {
    /// The part of the name before the slash.
    pub fn family(&self) -> &'static str {
        self.name.split('/').next().unwrap_or(self.name)
    }
}
