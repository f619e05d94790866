//! Baselines: what an engine's gate found once, so that a build fails when something gets worse.
//!
//! ```text
//!     badness of a value   |v − e| (equal),  max(0, v − e) (at most),  max(0, e − v) (at least)
//!                          e the prediction of the declared law, else the ideal
//!     worse                badness now > badness then + max(4.3 · spread + allowance/1024, 8ε), or bad where the baseline
//!                          has no such value
//! ```
//! The file is TOML, made by `--save-baseline` and meant to be read, edited and committed; `known_issue` entries are written by hand.

mod known_issue;
mod reading;

use crate::audit::AUDITS;
use crate::tolerance::{LAST_DIGITS, NEWS, SPREADS};
use crate::{CheckOutcome, Measurement, Report, StepOutcome, Verdict};
use jiff::civil::Date;
pub use known_issue::KnownIssue;
use moreau_contact::files::write_atomically;
use moreau_exact::number::{counted, significant, with_unit};
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

    /// The part of it that is about these time steps; the same where one of them is not in it.
    pub fn at(&self, steps: &[f64]) -> Self {
        if !steps.iter().all(|h| self.sweep.contains(h)) {
            return self.clone();
        }
        let here = |value: &&BaselineValue| value.time_step.is_none_or(|h| steps.contains(&h));
        let part = |check: &BaselineCheck| BaselineCheck { values: check.values.iter().filter(here).cloned().collect(), ..check.clone() };
        Baseline { sweep: steps.to_vec(), checks: self.checks.iter().map(part).collect(), ..self.clone() }
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
    ///
    /// ```
    /// use jiff::civil::date;
    /// use moreau_gate::baseline::{Baseline, ChangeKind};
    /// use moreau_gate::{Options, Plan, Verdict, checks, own, runner};
    ///
    /// let checks = vec![checks::find("projection/regions").expect("a check")];
    /// let plan = Plan { checks, sweep: vec![0.01], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    /// let mut report = runner::run(&|| Box::new(own::by_name("moreau-jean").expect("one of ours")), &plan).expect("it describes itself");
    /// let baseline = Baseline::of(&report);
    /// assert!(baseline.compare(&report, date(2026, 1, 1))?.is_empty());
    /// report.checks[0].verdict = Verdict::Fail; // what passed before
    /// assert_eq!(baseline.compare(&report, date(2026, 1, 1))?[0].kind, ChangeKind::Regression);
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn compare(&self, report: &Report, today: Date) -> Result<Vec<Change>> {
        self.require_engine(&report.engine.name)?;
        self.require_sweep(&report.sweep)?;
        let mut changes = Vec::new();
        for now in &report.checks {
            let found = self.found(now).into_iter().map(|(change, values)| self.accepted(change, &values, today));
            let found: Vec<Change> = found.collect();
            let is_worse = found.iter().any(|change| change.kind == ChangeKind::Regression);
            changes.extend(found);
            changes.extend(self.overdue(now, today).filter(|_| !is_worse));
        }
        let is_there = |check: &BaselineCheck| report.checks.iter().any(|now| now.check == check.name);
        let unknown = self.checks.iter().filter(|check| crate::checks::find(&check.name).is_none() && !is_there(check));
        changes.extend(unknown.map(BaselineCheck::missing));
        Ok(changes)
    }

    /// What changed of a check, and the values of which each change speaks, before any of it is accepted.
    fn found<'a>(&self, now: &'a CheckOutcome) -> Vec<(Change, Vec<Value<'a>>)> {
        match self.checks.iter().find(|check| check.name == now.check) {
            Some(then) => then.compare(now),
            None if now.verdict.is_bad() => {
                vec![(change(now, ChangeKind::Regression, "is bad, and the baseline does not have this check".into()), bad(now))]
            }
            None => Vec::new(),
        }
    }

    /// That a check is as bad as the baseline has it, and what accepted that has expired: a baseline that was saved again meanwhile has the
    /// failure as its own.
    fn overdue(&self, now: &CheckOutcome, today: Date) -> Option<Change> {
        let values = bad(now);
        let covering = |known: &dyn Fn(&KnownIssue) -> bool| {
            let issues: Vec<&KnownIssue> = self.known_issues.iter().filter(|issue| known(issue)).collect();
            issues.iter().all(|issue| issue.has_expired(today)).then(|| issues.first().copied()).flatten()
        };
        let of_value = |(step, one): &Value| covering(&|issue| issue.covers(&now.check, *step, one));
        let issue = if values.is_empty() && now.verdict.is_bad() {
            covering(&|issue| issue.check == now.check && issue.is_general())
        } else {
            values.iter().find_map(of_value)
        }?;
        let day = issue.expires.map(|day| day.to_string()).unwrap_or_default();
        let what = format!("{} as in the baseline; the known issue “{}” expired on {day}", now.verdict.word(), issue.reason);
        Some(change(now, ChangeKind::Regression, what))
    }

    /// Refuses to be compared with another engine, in the name of the one that describes itself so.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn require_engine(&self, name: &str) -> Result<()> {
        if self.engine == name {
            return Ok(());
        }
        let problem = format!("is `{}`, but the run is of `{name}`", self.engine);
        Err(Error::invalid("baseline.engine", problem, "compare an engine with its own baseline"))
    }

    /// Refuses to be compared with a run of these time steps and checks, before it is made: of other steps, or where it has no such check,
    /// so that nothing would ever be worse.
    ///
    /// # Errors
    /// [`Error::Invalid`] that names the field.
    pub fn require_run(&self, sweep: &[f64], checks: &[&str]) -> Result<()> {
        self.require_sweep(sweep)?;
        if checks.iter().any(|name| self.checks.iter().any(|then| then.name == **name)) {
            return Ok(());
        }
        let problem = format!("has none of the checks of this run, {} in number", checks.len());
        Err(Error::invalid("baseline.check", problem, "run with the `--only` that it was made with, or make a new one"))
    }

    fn require_sweep(&self, sweep: &[f64]) -> Result<()> {
        if self.sweep.len() == sweep.len() && self.sweep.iter().all(|h| sweep.contains(h)) {
            return Ok(());
        }
        let problem = format!("has the time steps {:?}, but the run has {sweep:?}", self.sweep);
        Err(Error::invalid("baseline.sweep", problem, "run with the same `--quick` or `--steps`"))
    }

    /// What else differs than the engine's answers: its version, its options, and what else was measured. Nothing that keeps a run from
    /// being compared.
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
        let pairs = report.checks.iter().filter_map(|now| Some((self.checks.iter().find(|check| check.name == now.check)?, now)));
        notes.extend(pairs.filter_map(|(then, now)| then.unmatched(now)));
        let is_new = |now: &&CheckOutcome| now.verdict != Verdict::Unsupported && self.checks.iter().all(|check| check.name != now.check);
        let new: Vec<&str> = report.checks.iter().filter(is_new).map(|now| now.check.as_str()).collect();
        if let Some(first) = new.first() {
            let count = counted(new.len(), "check");
            notes.push(format!("the baseline lacks {count} of this run, such as {first}: compared with nothing until you make a new one"));
        }
        notes.extend(self.known_issues.iter().filter_map(|issue| self.idle(issue, report)));
        notes
    }

    /// That a known issue covers nothing that is bad or worse in this run, which has its check and answers it: it is mended, or the
    /// quantity or step is another one.
    fn idle(&self, issue: &KnownIssue, report: &Report) -> Option<String> {
        let now = report.checks.iter().find(|now| now.check == issue.check)?;
        let is_at = |step: &StepOutcome, h: f64| step.time_step.is_some_and(|at| significant(h) == significant(at));
        let is_asked = |step: &&StepOutcome| issue.time_step.is_none_or(|h| is_at(step, h));
        let covers = |(step, one): &Value| issue.covers(&now.check, *step, one);
        let is_covered = bad(now).iter().any(covers)
            || self.found(now).iter().filter(|(change, _)| change.kind == ChangeKind::Regression).any(|(_, values)| match &values[..] {
                [] => issue.is_general(),
                values => values.iter().any(covers),
            });
        let is_open = now.steps.iter().filter(is_asked).any(|step| step.measurements.is_empty());
        (!is_covered && !is_open).then(|| format!("{} covers nothing that is bad in this run: correct or delete it", issue.named()))
    }

    /// A regression as a known issue, if each of its values is one that has not expired; without values, if the whole check is one.
    fn accepted(&self, mut change: Change, values: &[Value], today: Date) -> Change {
        if change.kind != ChangeKind::Regression {
            return change;
        }
        let of = |known: &dyn Fn(&KnownIssue) -> bool| self.known_issues.iter().filter(|issue| known(issue)).collect::<Vec<_>>();
        let covering: Vec<Vec<&KnownIssue>> = if values.is_empty() {
            vec![of(&|issue| issue.check == change.check && issue.is_general())]
        } else {
            values.iter().map(|(step, one)| of(&|issue| issue.covers(&change.check, *step, one))).collect()
        };
        let expired = |issue: &&&KnownIssue| issue.has_expired(today);
        let holding: Vec<Option<&&KnownIssue>> = covering.iter().map(|issues| issues.iter().find(|issue| !expired(issue))).collect();
        if let Some(Some(first)) = holding.first().filter(|_| holding.iter().all(Option::is_some)) {
            change.kind = ChangeKind::Known;
            change.what += &format!("; known: {}", first.reason);
        } else if let Some(issue) = covering.iter().flatten().find(expired) {
            let day = issue.expires.map(|day| day.to_string()).unwrap_or_default();
            change.what += &format!("; the known issue “{}” expired on {day}", issue.reason);
        }
        change
    }
}

/// A value with its h.
type Value<'a> = (Option<f64>, &'a Measurement);

/// The values at which a check is bad.
fn bad(now: &CheckOutcome) -> Vec<Value<'_>> {
    let values = now.steps.iter().flat_map(|step| step.measurements.iter().map(|one| (step.time_step, one)));
    values.filter(|(_, one)| one.verdict().is_bad()).collect()
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

    /// That a check of the baseline is none of this gate's, or one of a file that was not given.
    fn missing(&self) -> Change {
        let what = match self.name.strip_prefix(AUDITS) {
            Some(file) => format!("is in the baseline, but no file `{file}` is judged: give it to `--trajectory`, or make a new baseline"),
            None => "is in the baseline, but this gate has no such check: make a new baseline".into(),
        };
        Change { check: self.name.clone(), kind: ChangeKind::Regression, what }
    }

    /// The value that one of a run is compared with.
    fn partner(&self, step: Option<f64>, one: &Measurement) -> Option<&BaselineValue> {
        self.values.iter().find(|then| then.quantity == one.quantity && then.time_step == step)
    }

    /// That values of the run, or of the baseline at time steps that the run of this check does not have, are compared with nothing.
    fn unmatched(&self, now: &CheckOutcome) -> Option<String> {
        let values = now.steps.iter().flat_map(|step| step.measurements.iter().map(|one| (step.time_step, one)));
        let new = values.filter(|(step, one)| self.partner(*step, one).is_none()).count();
        let is_old = |then: &&BaselineValue| now.steps.iter().all(|step| step.time_step != then.time_step);
        let old = self.values.iter().filter(is_old).count();
        let of = |count: usize, place: &str| (count > 0).then(|| format!("{} in the {place} only", counted(count, "value")));
        let told: Vec<String> = [of(new, "run"), of(old, "baseline")].into_iter().flatten().collect();
        let told = told.join(" and ");
        (!told.is_empty()).then(|| format!("{} has {told}, compared with nothing: make a new baseline", self.name))
    }

    /// What changed, and the values of which it speaks.
    fn compare<'a>(&self, now: &'a CheckOutcome) -> Vec<(Change, Vec<Value<'a>>)> {
        let words = |verdict: Verdict| verdict.word();
        let mut changes = Vec::new();
        if now.verdict.is_bad() && !self.verdict.is_bad() {
            let reason = now.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
            let what = format!("{} instead of {}{reason}", words(now.verdict), words(self.verdict));
            changes.push((change(now, ChangeKind::Regression, what), bad(now)));
        } else if self.verdict.is_bad() && !now.verdict.is_bad() && now.verdict != Verdict::Unsupported {
            let what = format!("{} instead of {}", words(now.verdict), words(self.verdict));
            changes.push((change(now, ChangeKind::Improvement, what), Vec::new()));
        } else if now.verdict == Verdict::Unsupported && self.verdict != Verdict::Unsupported {
            changes.push((change(now, ChangeKind::Regression, format!("unsupported instead of {}", words(self.verdict))), Vec::new()));
        }
        if changes.is_empty() {
            changes.extend(self.news(now));
        }
        for step in &now.steps {
            let pairs = step.measurements.iter().filter_map(|one| Some((one, self.partner(step.time_step, one)?)));
            let told = pairs.filter_map(|(one, then)| then.compare(one).map(|(kind, what)| (change(now, kind, what), one)));
            changes.extend(told.map(|(change, one)| (change, vec![(step.time_step, one)])));
            if let Some(lost) = self.lost(step).filter(|_| !step.measurements.is_empty() || changes.is_empty()) {
                changes.push((change(now, ChangeKind::Regression, lost), Vec::new()));
            }
        }
        if self.is_apart(now) && changes.iter().all(|(change, _)| change.kind != ChangeKind::Regression) {
            let what = "none of its values has a partner in the baseline: make a new baseline".into();
            changes.push((change(now, ChangeKind::Regression, what), Vec::new()));
        }
        changes
    }

    /// The bad values that the baseline does not have: what every answer is asked has a value only where it is wrong.
    fn news<'a>(&self, now: &'a CheckOutcome) -> Option<(Change, Vec<Value<'a>>)> {
        let bad: Vec<Value<'a>> = bad(now).into_iter().filter(|(step, one)| self.partner(*step, one).is_none()).collect();
        let told: Vec<String> = bad
            .iter()
            .map(|(step, one)| format!("{}{}: {}", one.quantity, at(*step), with_unit(&significant(one.value), &one.unit)))
            .collect();
        (!bad.is_empty()).then(|| (change(now, ChangeKind::Regression, format!("bad, and not in the baseline: {}", told.join("; "))), bad))
    }

    /// Whether both have values, of which none could be compared.
    fn is_apart(&self, now: &CheckOutcome) -> bool {
        let mut values = now.steps.iter().flat_map(|step| step.measurements.iter().map(|one| (step.time_step, one))).peekable();
        !self.values.is_empty() && values.peek().is_some() && values.all(|(step, one)| self.partner(step, one).is_none())
    }

    /// What this time step no longer measures.
    fn lost(&self, step: &StepOutcome) -> Option<String> {
        let measured = |then: &&BaselineValue| step.measurements.iter().any(|now| now.quantity == then.quantity);
        let lost = self.values.iter().filter(|then| then.time_step == step.time_step && !measured(then));
        let lost: Vec<&str> = lost.map(|then| then.quantity.as_str()).collect();
        let why = step.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
        (!lost.is_empty()).then(|| format!("no longer measured{}: {}{why}", at(step.time_step), lost.join(", ")))
    }
}

impl BaselineValue {
    fn compare(&self, now: &Measurement) -> Option<(ChangeKind, String)> {
        let noise = LAST_DIGITS.max(SPREADS * self.spread.max(now.spread) + NEWS * now.ideal.tolerance);
        let (then_bad, now_bad) = (badness(now, self.value), badness(now, now.value));
        let at = at(self.time_step);
        if self.unit != now.unit {
            let units = format!("in the unit “{}” instead of “{}”", now.unit, self.unit);
            return Some((ChangeKind::Regression, format!("{}{at} is {units}: make a new baseline", now.quantity)));
        }
        // as many digits as tell the two apart
        let same = significant(now.value) == significant(self.value);
        let [value, then] = [now.value, self.value].map(|value| if same { format!("{value:e}") } else { significant(value) });
        let numbers = format!("{}{at}: {} instead of {then} (noise {noise:.1e})", now.quantity, with_unit(&value, &now.unit));
        if !now_bad.is_finite() || now_bad > then_bad + noise {
            return Some((ChangeKind::Regression, format!("worse: {numbers}")));
        }
        (now_bad < then_bad - noise).then(|| (ChangeKind::Improvement, format!("better: {numbers}")))
    }
}

fn at(time_step: Option<f64>) -> String {
    time_step.map_or(String::new(), |h| format!(" at h = {} s", significant(h)))
}

/// How bad a value is: its distance from the expectation that applies.
fn badness(measurement: &Measurement, value: f64) -> f64 {
    measurement.model.as_ref().unwrap_or(&measurement.ideal).miss(value)
}

#[cfg(test)]
mod tests;
