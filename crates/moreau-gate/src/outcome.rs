//! What the gate reports: every check at every time step, with verdicts that can be compared with a baseline.

use crate::conformance::Probe;
pub use crate::step_outcome::StepOutcome;
use crate::{Description, Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The name and version of the format.
pub const SCHEMA: &str = "gate-report/1";

/// Everything the gate found out about one engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Report {
    /// Always `gate-report/1`.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: String,
    /// The engine's own description.
    pub engine: Description,
    /// What the probes of `moreau protocol-check` find wrong with what the engine reports of motions and contacts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub adapter: Vec<Probe>,
    /// The time steps of the sweep \[s\].
    pub sweep: Vec<f64>,
    /// One outcome per check, in the order of the registry.
    pub checks: Vec<CheckOutcome>,
}

/// One check of one engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckOutcome {
    /// `family/what`.
    pub check: String,
    /// The worst verdict of its steps.
    pub verdict: Verdict,
    /// The reason of `unsupported` or the cause of `errored`, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The time steps at which it is bad \[s\].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fails_at: Vec<f64>,
    /// How its deviations depend on h.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trends: Vec<crate::trend::Trend>,
    /// Step by step.
    pub steps: Vec<StepOutcome>,
}

impl CheckOutcome {
    /// The outcome of a check from those of its steps: the worst verdict, with the reason that belongs to it.
    pub fn new(check: &str, steps: Vec<StepOutcome>) -> Self {
        let verdict = steps.iter().map(|step| step.verdict).max().unwrap_or(Verdict::Errored);
        let reason = steps.iter().find(|step| step.verdict == verdict).and_then(|step| step.reason.clone());
        let fails_at = steps.iter().filter(|step| step.verdict.is_bad()).filter_map(|step| step.time_step).collect();
        let trends = crate::trend::trends(&steps);
        CheckOutcome { check: check.into(), verdict, reason, fails_at, trends, steps }
    }
}

impl Report {
    /// Whether any check is bad.
    pub fn is_bad(&self) -> bool {
        self.checks.iter().any(|check| check.verdict.is_bad())
    }

    /// The adapter's mistakes that may explain why a check is bad: those about contacts for a check of impulses, the others for every one.
    pub fn explaining(&self, outcome: &CheckOutcome) -> impl Iterator<Item = &Probe> {
        let is_bad = outcome.verdict.is_bad();
        let of_impulses = outcome.check.starts_with("contact/") || outcome.check.ends_with("/momentum");
        self.adapter.iter().filter(move |probe| is_bad && (of_impulses || !probe.probe.starts_with("contacts/")))
    }

    /// How many checks have this verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.checks.iter().filter(|check| check.verdict == verdict).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, own};

    #[test]
    fn the_adapter_explains_what_is_bad_and_of_contacts_only_impulses() {
        let engine = own::by_name("moreau-jean").expect("listed").describe(&Options::new()).expect("describes itself");
        let probe = |name: &str| Probe {
            probe: name.into(),
            demand: "is right".into(),
            outcome: crate::conformance::ProbeOutcome::Problem { why: "is wrong".into(), cure: "another".into() },
        };
        let adapter = vec![probe("motion/turns"), probe("contacts/impulses")];
        let report = Report { schema: SCHEMA.into(), engine, adapter, sweep: vec![0.5], checks: Vec::new() };
        let told = |check: &str, verdict: Verdict| -> Vec<String> {
            report.explaining(&CheckOutcome::new(check, vec![StepOutcome::planted(0.5, verdict)])).map(|one| one.probe.clone()).collect()
        };
        assert_eq!(told("contact/pairs", Verdict::Fail), ["motion/turns", "contacts/impulses"]);
        assert_eq!(told("tumbling/momentum", Verdict::Errored), ["motion/turns", "contacts/impulses"]);
        assert_eq!(told("pair/central", Verdict::Fail), ["motion/turns"]);
        for verdict in [Verdict::Pass, Verdict::Difference, Verdict::Unsupported] {
            assert_eq!(told("contact/pairs", verdict), [""; 0], "{verdict:?}");
        }
    }

    #[test]
    fn the_worst_step_decides_wherever_it_stands_and_gives_its_reason() {
        use Verdict::{Difference, Errored, Fail, Pass, Unsupported};
        let cases: [(Verdict, &[f64], Option<&str>); 4] =
            [(Fail, &[0.5], None), (Errored, &[0.5], Some("too late")), (Difference, &[], None), (Pass, &[], None)];
        for (worst, fails_at, reason) in cases {
            for place in 0..3 {
                let mut verdicts = [Unsupported; 3];
                verdicts[place] = worst;
                let times = [0, 1, 2].map(|k| if k == place { 0.5 } else { 0.25 });
                let outcome = CheckOutcome::new("made-up/check", (0..3).map(|k| StepOutcome::planted(times[k], verdicts[k])).collect());
                assert_eq!((outcome.verdict, outcome.fails_at.as_slice(), outcome.reason.as_deref()), (worst, fails_at, reason), "{place}");
            }
        }
    }
}
