//! One probe: what is demanded, and what was seen.

use crate::Refusal;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What came out of asking one thing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Probe {
    /// `subject/what`.
    pub probe: String,
    /// What the protocol demands.
    pub demand: String,
    /// Whether it is met.
    #[serde(flatten)]
    pub outcome: ProbeOutcome,
}

/// The outcome of a probe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "outcome", rename_all = "kebab-case")]
pub enum ProbeOutcome {
    /// The adapter behaves as demanded.
    Ok,
    /// The adapter does not behave as demanded.
    Problem {
        /// What was seen.
        why: String,
        /// What to change.
        cure: String,
    },
    /// The probe was not run.
    Skipped {
        /// Why not.
        why: String,
    },
}

/// What a probe sees: nothing wrong, or another outcome.
pub(super) type Seen = Result<(), ProbeOutcome>;

pub(super) fn probe(name: &'static str, demand: &'static str, seen: Seen) -> Probe {
    let outcome = seen.map_or_else(|outcome| outcome, |()| ProbeOutcome::Ok);
    Probe { probe: name.into(), demand: demand.into(), outcome }
}

/// The probes so far, and who hears which one is asked next.
pub(super) struct Probes<'a> {
    pub(super) done: Vec<Probe>,
    asked: &'a dyn Fn(&str),
}

impl<'a> Probes<'a> {
    /// None yet; `asked` hears the name of each before it waits for the engine.
    pub(super) fn heard_by(asked: &'a dyn Fn(&str)) -> Self {
        Probes { done: Vec::new(), asked }
    }

    /// Tells that the engine is asked for this probe now.
    pub(super) fn begin(&self, name: &str) {
        (self.asked)(name);
    }

    /// A probe that asks the engine.
    pub(super) fn ask(&mut self, name: &'static str, demand: &'static str, look: impl FnOnce() -> Seen) {
        self.begin(name);
        self.push(probe(name, demand, look()));
    }

    /// A probe of what is known.
    pub(super) fn push(&mut self, probe: Probe) {
        self.done.push(probe);
    }
}

pub(super) fn problem(why: impl std::fmt::Display, cure: impl Into<String>) -> ProbeOutcome {
    ProbeOutcome::Problem { why: why.to_string(), cure: cure.into() }
}

pub(super) fn skipped(why: impl Into<String>) -> ProbeOutcome {
    ProbeOutcome::Skipped { why: why.into() }
}

/// Nothing wrong, or a problem.
pub(super) fn demand(met: bool, why: impl FnOnce() -> String, cure: &str) -> Seen {
    if met { Ok(()) } else { Err(problem(why(), cure)) }
}

/// A refusal of a question that the engine may refuse: an honest `unsupported` is no problem.
pub(super) fn refused(refusal: Refusal) -> ProbeOutcome {
    match refusal {
        Refusal::Unsupported(reason) => skipped(format!("unsupported: {reason}")),
        Refusal::Errored(cause) => {
            let cure = "answer the request with a result, or with `unsupported` and the reason; what crashes an engine it tells on \
                        standard error, and one that is slow may be given more by --time-limit";
            problem(cause, cure)
        }
    }
}
