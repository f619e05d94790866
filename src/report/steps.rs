//! What the certificate says of the steps of a motion: how many it rejects, and the worst of them.

use crate::certificate::{Judgement, StepResidual};
use crate::mechanics::Mechanism;
use crate::number::{significant, with_unit};
use crate::trajectory::Recording;
use schemars::JsonSchema;
use serde::Serialize;

/// The steps of a motion as their certificates see them.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StepSummary {
    /// How many steps there are.
    pub steps: usize,
    /// How many of them had something to solve.
    pub solved: usize,
    /// Steps whose residual exceeds its limit.
    pub rejected: usize,
    /// Steps whose residual exceeds its limit, where the algorithm is a declared number of sweeps.
    pub unconverged: usize,
    /// The step that exceeds its limit most, or comes nearest to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst: Option<WorstStep>,
}

/// The worst step of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WorstStep {
    /// Its number, from 1.
    pub step: usize,
    /// The time at its end \[s\].
    pub time: f64,
    /// The rule that judges the step: `certificate`, or the stopping rule of the scheme's own law.
    pub rule: &'static str,
    /// Which residual.
    pub residual: &'static str,
    /// Its relative size; absent if it is not a number.
    pub relative: Option<f64>,
    /// What is accepted.
    pub limit: f64,
    /// The two bodies, or the number of the contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<String>,
}

impl StepSummary {
    /// The summary of a recorded motion.
    pub fn of(recording: &Recording, mechanism: &dyn Mechanism) -> Self {
        let count = |wanted: Judgement| recording.judgements.iter().filter(|one| **one == wanted).count();
        let mut worst: Option<(usize, StepResidual)> = None;
        for (step, residual) in recording.residuals.iter().enumerate().filter_map(|(k, residual)| Some((k + 1, (*residual)?))) {
            if worst.as_ref().is_none_or(|(_, known)| residual.is_worse_than(known)) {
                worst = Some((step, residual));
            }
        }
        let described = |(step, residual): (usize, StepResidual)| WorstStep {
            step,
            time: recording.samples[step].time,
            rule: residual.rule,
            residual: residual.residual,
            relative: Some(residual.relative).filter(|relative| relative.is_finite()),
            limit: residual.limit,
            contact: contact(&residual, recording, mechanism),
        };
        StepSummary {
            steps: recording.judgements.len(),
            solved: recording.residuals.iter().flatten().count(),
            rejected: count(Judgement::Rejected),
            unconverged: count(Judgement::Unconverged),
            worst: worst.map(described),
        }
    }

    /// One line, two if steps are unconverged by declaration.
    pub fn text(&self) -> String {
        let StepSummary { steps, rejected, unconverged, .. } = self;
        let worst = match &self.worst {
            None => String::new(),
            // it would name a step that is no worse than the others
            Some(worst) if worst.relative == Some(0.0) => ", every residual is 0".into(),
            Some(worst) => format!(", worst {}", worst.text()),
        };
        let line = |what: &str, count: usize, worst: &str| format!("{what}: {count} of {steps}{worst}\n");
        match unconverged {
            0 => line("steps the certificate rejects", *rejected, &worst),
            _ => line("steps unconverged by declaration", *unconverged, &worst),
        }
    }
}

impl WorstStep {
    /// `normal residual 0.9 of its scale (limit 1e-8) in the step to t = 0.35 s, contact box/ground`.
    pub fn text(&self) -> String {
        let relative = self.relative.map_or("no number".into(), significant);
        let rule = if self.rule == "certificate" { String::new() } else { format!(" of the {}", self.rule) };
        let contact = self.contact.as_ref().map(|contact| format!(", contact {contact}")).unwrap_or_default();
        let time = with_unit(&significant(self.time), "s");
        let (residual, limit) = (self.residual, significant(self.limit));
        format!("{residual} residual{rule} {relative} of its scale (limit {limit}) in the step to t = {time}{contact}")
    }
}

/// `box/ground`, or the number of the contact where it has no bodies.
fn contact(residual: &StepResidual, recording: &Recording, mechanism: &dyn Mechanism) -> Option<String> {
    let Some(pair) = residual.pair else { return residual.contact.map(|contact| contact.to_string()) };
    let bodies = mechanism.bodies(&recording.samples[0].position, &recording.samples[0].velocity);
    let name = |body: Option<usize>| body.map_or("ground", |body| bodies.get(body).map_or("?", |body| body.name.as_str()));
    Some(pair.map(name).join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::StepResidual;
    use crate::scenes;

    #[test]
    fn a_step_whose_residual_is_no_number_stays_the_worst_whatever_follows() {
        let (mechanism, start) = scenes::named("bouncing-ball").and_then(|scene| scene.mechanism()).expect("a named scene");
        let mut recording = Recording::new("ball", "any".into(), 0.5, start.clone());
        for relative in [1.0, f64::NAN, 2.0, 3.0] {
            let residual = StepResidual { rule: "certificate", residual: "normal", relative, limit: 1.0, contact: None, pair: None };
            recording.push_judged(start.clone(), Vec::new(), Some(residual), Judgement::of(Some(residual), false));
        }
        let summary = StepSummary::of(&recording, mechanism.as_ref());
        let worst = summary.worst.expect("four residuals");
        assert_eq!((worst.step, worst.relative, summary.rejected), (2, None, 3));
        assert!(worst.text().contains("no number"), "{}", worst.text());
    }

    #[test]
    fn where_every_residual_is_0_no_step_is_named_as_the_worst() {
        let worst = |relative| WorstStep {
            step: 2,
            time: 0.25,
            rule: "certificate",
            residual: "normal",
            relative: Some(relative),
            limit: 1e-8,
            contact: Some("box/ground".into()),
        };
        let text = |worst| StepSummary { steps: 3, solved: 2, rejected: 0, unconverged: 0, worst }.text();
        assert_eq!(text(None), "steps the certificate rejects: 0 of 3\n");
        assert_eq!(text(Some(worst(0.0))), "steps the certificate rejects: 0 of 3, every residual is 0\n");
        let step = "worst normal residual 2e-9 of its scale (limit 1e-8) in the step to t = 0.25 s, contact box/ground";
        assert_eq!(text(Some(worst(2e-9))), format!("steps the certificate rejects: 0 of 3, {step}\n"));
    }
}
