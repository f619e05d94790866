//! Baselines: what an engine's gate found once, so that a build fails when something gets worse.
//!
//! ```text
//!     badness of a value   |v − e| (equal),  v (at most),  −v (at least),   e the prediction of the declared law, else the ideal
//!     worse                badness now > badness then + 4.3 · spread + allowance/1024
//! ```
//! The file is TOML, made by `--save-baseline` and meant to be read, edited and committed; `known_issue` entries are written by hand.

use crate::tolerance::{NEWS, SPREADS};
use crate::{CheckOutcome, Measurement, Report, Verdict};
use jiff::civil::Date;
use moreau_checks::Relation;
use moreau_contact::files::{read_text, write_atomically};
use moreau_exact::number::{significant, with_unit};
use moreau_exact::{Error, Result};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The name and version of the format.
pub const SCHEMA: &str = "gate-baseline/1";

/// A stored run of the gate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// Always `gate-baseline/1`.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: String,
    /// The engine's name.
    pub engine: String,
    /// Its version.
    pub version: String,
    /// The time steps of the sweep \[s\].
    pub sweep: Vec<f64>,
    /// The options that the engine used, as JSON.
    pub options: String,
    /// Failures that are accepted for the time being.
    #[serde(default, rename = "known_issue")]
    pub known_issues: Vec<KnownIssue>,
    /// One entry per check.
    #[serde(default, rename = "check")]
    pub checks: Vec<BaselineCheck>,
}

/// A failure that is known and accepted, with its reason.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KnownIssue {
    /// The check, by name.
    pub check: String,
    /// Why it is accepted.
    pub reason: String,
    /// The first day on which it is no longer accepted, `2027-01-31`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<String>")]
    pub expires: Option<Date>,
}

/// Verdict and values of one check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BaselineCheck {
    /// `family/what`.
    pub name: String,
    /// Its verdict.
    pub verdict: Verdict,
    /// Its values.
    #[serde(default, rename = "value", skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<BaselineValue>,
}

/// One measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BaselineValue {
    /// What was measured.
    pub quantity: String,
    /// h \[s\], if the check has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step: Option<f64>,
    /// The value.
    pub value: f64,
    /// Its spread.
    pub spread: f64,
    /// Its unit.
    pub unit: String,
}

/// One difference between a run and its baseline.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// The check.
    pub check: String,
    /// Better or worse, or accepted.
    pub kind: ChangeKind,
    /// What changed, in words with numbers.
    pub what: String,
}

/// What a change means for a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChangeKind {
    /// Stops the build.
    Regression,
    /// Bad, but accepted by a known issue.
    Known,
    /// The baseline can be tightened.
    Improvement,
}

impl Baseline {
    /// The baseline of a run.
    pub fn of(report: &Report) -> Self {
        Baseline {
            schema: SCHEMA.into(),
            engine: report.engine.name.clone(),
            version: report.engine.version.clone(),
            sweep: report.sweep.clone(),
            options: serde_json::Value::Object(report.engine.options.clone()).to_string(),
            known_issues: Vec::new(),
            checks: report.checks.iter().map(BaselineCheck::of).collect(),
        }
    }

    /// Reads a baseline.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Invalid`] with file, line and field.
    pub fn read(file: &Path) -> Result<Self> {
        let text = read_text(file)?;
        let baseline: Baseline = toml::from_str(&text).map_err(|error| {
            let line = error.span().map_or(String::new(), |span| format!("line {}: ", 1 + text[..span.start].matches('\n').count()));
            let problem = format!("{line}{}", error.message());
            Error::invalid("baseline", problem, "make a new one with `moreau gate --save-baseline FILE`").in_file(file)
        })?;
        if baseline.schema != SCHEMA {
            let problem = format!("is `{}`", baseline.schema);
            return Err(Error::invalid("schema", problem, format!("this program reads `{SCHEMA}`")).in_file(file));
        }
        for issue in &baseline.known_issues {
            if crate::checks::find(&issue.check).is_none() {
                let problem = format!("names the check `{}`, which does not exist", issue.check);
                return Err(Error::invalid("known_issue", problem, "`moreau gate --list` shows every check").in_file(file));
            }
        }
        Ok(baseline)
    }

    /// Writes the baseline, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, file: &Path) -> Result<()> {
        write_atomically(file, self.to_toml()?.as_bytes())
    }

    /// The text of the file.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if a value cannot be written.
    pub fn to_toml(&self) -> Result<String> {
        toml::to_string(self).map_err(|error| Error::Unsupported(format!("cannot write the baseline: {error}")))
    }

    /// What changed from the baseline to a run, as of `today`.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the run is of another engine or lacks a time step of the baseline: nothing could be compared.
    pub fn compare(&self, report: &Report, today: Date) -> Result<Vec<Change>> {
        if self.engine != report.engine.name {
            let problem = format!("is `{}`, but the run is of `{}`", self.engine, report.engine.name);
            return Err(Error::invalid("baseline.engine", problem, "compare an engine with its own baseline"));
        }
        let same_sweep = self.sweep.len() == report.sweep.len() && self.sweep.iter().all(|h| report.sweep.contains(h));
        if !same_sweep {
            let problem = format!("has the time steps {:?}, but the run has {:?}", self.sweep, report.sweep);
            return Err(Error::invalid("baseline.sweep", problem, "run with the same `--quick` or `--steps`"));
        }
        let mut changes = Vec::new();
        for now in &report.checks {
            match self.checks.iter().find(|check| check.name == now.check) {
                Some(then) => changes.extend(then.compare(now)),
                None if now.verdict.is_bad() => {
                    changes.push(change(now, ChangeKind::Regression, "is bad, and the baseline does not have this check".into()))
                }
                None => {}
            }
        }
        for change in &mut changes {
            self.accept(change, today);
        }
        Ok(changes)
    }

    /// What else differs than the engine's answers: its version, its options. Nothing that keeps a run from being compared.
    pub fn notes(&self, report: &Report) -> Vec<String> {
        let mut notes = Vec::new();
        let engine = &report.engine;
        if self.version != engine.version {
            notes.push(format!("the baseline is of {} {}, but the run is of {}", self.engine, self.version, engine.version));
        }
        let then: crate::Options = serde_json::from_str(&self.options).unwrap_or_default();
        let said = |value: Option<&serde_json::Value>| value.map_or("absent".to_string(), ToString::to_string);
        let names: std::collections::BTreeSet<&String> = then.keys().chain(engine.options.keys()).collect();
        for name in names.into_iter().filter(|name| then.get(*name) != engine.options.get(*name)) {
            let [old, new] = [then.get(name), engine.options.get(name)].map(said);
            notes.push(format!("the option {name} was {old} in the baseline and is {new} now"));
        }
        notes
    }

    /// Turns a regression that is a known issue into one, unless it has expired.
    fn accept(&self, change: &mut Change, today: Date) {
        let Some(issue) = self.known_issues.iter().find(|issue| issue.check == change.check) else { return };
        if change.kind != ChangeKind::Regression {
            return;
        }
        match issue.expires {
            Some(day) if day <= today => change.what += &format!("; the known issue “{}” expired on {day}", issue.reason),
            _ => {
                change.kind = ChangeKind::Known;
                change.what += &format!("; known: {}", issue.reason);
            }
        }
    }
}

fn change(now: &CheckOutcome, kind: ChangeKind, what: String) -> Change {
    Change { check: now.check.clone(), kind, what }
}

impl BaselineCheck {
    fn of(outcome: &CheckOutcome) -> Self {
        let values = outcome.steps.iter().flat_map(|step| {
            step.measurements.iter().map(|one| BaselineValue {
                quantity: one.quantity.clone(),
                time_step: step.time_step,
                value: one.value,
                spread: one.spread,
                unit: one.unit.clone(),
            })
        });
        BaselineCheck { name: outcome.check.clone(), verdict: outcome.verdict, values: values.collect() }
    }

    fn compare(&self, now: &CheckOutcome) -> Vec<Change> {
        let words = |verdict: Verdict| verdict.word();
        let mut changes = Vec::new();
        if now.verdict.is_bad() && !self.verdict.is_bad() {
            let reason = now.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
            changes.push(change(now, ChangeKind::Regression, format!("{} instead of {}{reason}", words(now.verdict), words(self.verdict))));
        } else if self.verdict.is_bad() && !now.verdict.is_bad() && now.verdict != Verdict::Unsupported {
            changes.push(change(now, ChangeKind::Improvement, format!("{} instead of {}", words(now.verdict), words(self.verdict))));
        } else if now.verdict == Verdict::Unsupported && self.verdict != Verdict::Unsupported {
            changes.push(change(now, ChangeKind::Regression, format!("unsupported instead of {}", words(self.verdict))));
        }
        for step in &now.steps {
            let known =
                |one: &Measurement| self.values.iter().find(|then| then.quantity == one.quantity && then.time_step == step.time_step);
            let pairs = step.measurements.iter().filter_map(|one| known(one).map(|then| (one, then)));
            changes.extend(pairs.filter_map(|(one, then)| then.compare(one)).map(|(kind, what)| change(now, kind, what)));
        }
        changes
    }
}

impl BaselineValue {
    fn compare(&self, now: &Measurement) -> Option<(ChangeKind, String)> {
        let noise = SPREADS * self.spread.max(now.spread) + NEWS * now.ideal.tolerance;
        let (then_bad, now_bad) = (badness(now, self.value), badness(now, now.value));
        let at = self.time_step.map_or(String::new(), |h| format!(" at h = {} s", significant(h)));
        let value = with_unit(&significant(now.value), &now.unit);
        let numbers = format!("{}{at}: {value} instead of {} (noise {noise:.1e})", now.quantity, significant(self.value));
        if !now_bad.is_finite() || now_bad > then_bad + noise {
            return Some((ChangeKind::Regression, format!("worse: {numbers}")));
        }
        (now_bad < then_bad - noise).then(|| (ChangeKind::Improvement, format!("better: {numbers}")))
    }
}

/// How bad a value is, by the expectation that applies: smaller is better.
fn badness(measurement: &Measurement, value: f64) -> f64 {
    let expectation = measurement.model.as_ref().unwrap_or(&measurement.ideal);
    match expectation.relation {
        Relation::Equal => (value - expectation.value).abs(),
        Relation::AtMost => value,
        Relation::AtLeast => -value,
    }
}

#[cfg(test)]
#[path = "baseline_tests.rs"]
mod tests;
