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

    /// An outcome at h with this verdict, as a check comes to it.
    #[cfg(test)]
    pub(crate) fn planted(h: f64, verdict: Verdict) -> Self {
        use crate::{Expectation, Refusal};
        let value = |value: f64| Measurement::new("x", "m", value, Expectation::equal(0.0, 0.25, "ideal"));
        let answer = match verdict {
            Verdict::Pass => Ok(vec![value(0.0)]),
            Verdict::Difference => Ok(vec![value(1.0).predicted(Some(Expectation::equal(1.0, 0.25, "law")))]),
            Verdict::Fail => Ok(vec![value(1.0)]),
            Verdict::Unsupported => Err(Refusal::unsupported("no friction")),
            Verdict::Errored => Err(Refusal::errored("too late")),
        };
        StepOutcome::new(Some(h), answer)
    }
}
