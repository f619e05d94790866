//! What a check says of an engine at one time step.

use crate::{Measurement, Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A check at one time step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StepOutcome {
    /// h \[s\]; absent if the question has no time step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step: Option<f64>,
    /// The worst verdict of its measurements.
    pub verdict: Verdict,
    /// The reason of `unsupported` or the cause of `errored`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// What was measured.
    pub measurements: Vec<Measurement>,
}

impl StepOutcome {
    /// The outcome of a run of a check.
    pub fn new(time_step: Option<f64>, answer: crate::Reply<Vec<Measurement>>) -> Self {
        match answer {
            Ok(measurements) if measurements.is_empty() => {
                StepOutcome { time_step, verdict: Verdict::Errored, reason: Some("the check measured nothing".into()), measurements }
            }
            Ok(measurements) => {
                let verdict = measurements.iter().map(Measurement::verdict).max().unwrap_or(Verdict::Errored);
                StepOutcome { time_step, verdict, reason: None, measurements }
            }
            Err(crate::Refusal::Unsupported(reason)) => {
                StepOutcome { time_step, verdict: Verdict::Unsupported, reason: Some(reason), measurements: Vec::new() }
            }
            Err(crate::Refusal::Errored(cause)) => {
                StepOutcome { time_step, verdict: Verdict::Errored, reason: Some(cause), measurements: Vec::new() }
            }
        }
    }
}
