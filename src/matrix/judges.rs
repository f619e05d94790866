//! Planted mistakes in the judgement of a claim, which decides from findings and controls whether the recorded verdict is supported.

use crate::Result;
use crate::checks::Finding;
use crate::checks::planted::{Family, Kind, Planted};
use crate::claims::{ClaimVerdict, Status, conclude, derive};

/// What the findings of a claim and of its controls say of a recorded verdict.
pub type Concludes = fn(ClaimVerdict, &[Finding], &[Vec<Finding>]) -> Status;

/// Judgements, held against claims whose judgement is known.
pub static JUDGES: Family<Concludes> = Family {
    reference: conclude,
    checks: &[("claims/judgement", judgement)],
    planted: &[
        planted("claims/passed-control-ignored", "does not look at what a control says", |verdict, findings, controls| {
            match conclude(verdict, findings, controls) {
                Status::ControlPassed => Status::Supported,
                other => other,
            }
        }),
        planted("claims/nothing-found-is-support", "takes a check that finds nothing for support", |verdict, findings, controls| {
            if findings.is_empty() { Status::Supported } else { conclude(verdict, findings, controls) }
        }),
        planted(
            "claims/control-that-finds-nothing",
            "takes a control that finds nothing for one that bites",
            |verdict, findings, controls| {
                let found: Vec<_> = controls.iter().filter(|control| !control.is_empty()).cloned().collect();
                if found.len() < controls.len() { Status::Supported } else { conclude(verdict, findings, controls) }
            },
        ),
        planted(
            "claims/failing-finding-ignored",
            "does not look whether what was measured is as expected",
            |verdict, findings, controls| match conclude(verdict, findings, controls) {
                Status::Contradicted => Status::Supported,
                other => other,
            },
        ),
        planted(
            "claims/recorded-verdict-believed",
            "takes the recorded verdict, whatever the findings say of the sentence",
            |verdict, findings, controls| match conclude(verdict, findings, controls) {
                Status::OtherVerdict(_) => Status::Supported,
                other => other,
            },
        ),
        planted(
            "claims/false-for-conditional",
            "takes a refutation where the omitted condition is violated for one of the sentence",
            |verdict, findings, controls| {
                let unconditional = |finding: &Finding| {
                    let mut finding = finding.clone();
                    finding.bearing.violated = None;
                    finding
                };
                let findings: Vec<_> = findings.iter().map(unconditional).collect();
                conclude(verdict, &findings, controls)
            },
        ),
        planted("claims/context-decides", "lets what is told beside the sentence decide", |verdict, findings, controls| {
            let deciding = |finding: &Finding| {
                let mut finding = finding.clone();
                finding.bearing.context = false;
                finding
            };
            let findings: Vec<_> = findings.iter().map(deciding).collect();
            if derive(&findings) == Ok(verdict) { conclude(verdict, &findings, controls) } else { Status::OtherVerdict(String::new()) }
        }),
        planted(
            "claims/control-with-its-own-words",
            "takes another verdict of a control that comes from other words of the sentence alone for one of another subject",
            |verdict, findings, controls| match conclude(verdict, findings, controls) {
                Status::ControlPassed if controls.iter().all(|control| bites(verdict, control)) => Status::Supported,
                other => other,
            },
        ),
        planted(
            "claims/passages-reworded",
            "takes a control in which two passages say the same for one in which what is found bears them out",
            |verdict, findings, controls| match conclude(verdict, findings, controls) {
                Status::ControlPassed if verdict == ClaimVerdict::Inconsistent && bites(verdict, &controls[0]) => Status::Supported,
                other => other,
            },
        ),
        planted("claims/first-control-alone", "does not look at any control but the first", |verdict, findings, controls| {
            conclude(verdict, findings, &controls[..controls.len().min(1)])
        }),
    ],
};

/// Whether a control leads to another verdict by what it expects and states itself, and contradicts a finding.
fn bites(verdict: ClaimVerdict, control: &[Finding]) -> bool {
    !control.is_empty() && derive(control) != Ok(verdict) && !control.iter().all(Finding::holds)
}

const fn planted(name: &'static str, mistake: &'static str, subject: Concludes) -> Planted<Concludes> {
    Planted { name, mistake, kind: Kind::Certificate, subject }
}

/// Claims made of findings “x is 1”, each with the judgement that it must have.
fn judgement(subject: &Concludes) -> Result<Vec<Finding>> {
    let found = |value: usize| Finding::count("x", value, 1);
    let named = |name: &str, value: usize| Finding::count(name, value, 1);
    let (right, wrong) = (vec![found(1)], vec![vec![found(2)]]);
    let refuted = vec![found(1).says(2)];
    let conditional = vec![found(1), named("y", 1).says(2).violating("c")];
    let beside = vec![found(1), named("y", 1).says(2).context()];
    // the second control moves what the first one moves, and nothing else
    let twice = [vec![found(2)], vec![found(2)]];
    // the same refutation, of another number by another word
    let reworded = [vec![found(3).says(3)]];
    let passages =
        |value: usize, one: usize, other: usize| vec![found(value).says(one).passage("§1"), found(value).says(other).passage("§2")];
    let of = |verdict, findings: &[Finding], controls: &[Vec<Finding>]| subject(verdict, findings, controls);
    let is = |what: &str, found: Status, expected: fn(&Status) -> bool| Finding::decision(what, expected(&found), true);
    Ok(vec![
        is("a true claim", of(ClaimVerdict::True, &right, &wrong), |status| *status == Status::Supported),
        is("a false claim", of(ClaimVerdict::False, &refuted, &[vec![found(2).says(2)]]), |status| *status != Status::ControlPassed),
        is("a conditional claim", of(ClaimVerdict::Conditional, &conditional, &wrong), |status| *status == Status::Supported),
        is("context beside a true claim", of(ClaimVerdict::True, &beside, &wrong), |status| *status == Status::Supported),
        is("a control that passed", of(ClaimVerdict::True, &right, std::slice::from_ref(&right)), |status| {
            *status == Status::ControlPassed
        }),
        is("two controls of one effect", of(ClaimVerdict::True, &right, &twice), |status| *status == Status::ControlPassed),
        is("a control with other words", of(ClaimVerdict::False, &refuted, &reworded), |status| *status == Status::ControlPassed),
        is("two passages", of(ClaimVerdict::Inconsistent, &passages(1, 1, 2), &[passages(0, 0, 0)]), |status| *status == Status::Supported),
        is("two passages reworded", of(ClaimVerdict::Inconsistent, &passages(1, 1, 2), &[passages(2, 3, 3)]), |status| {
            *status == Status::ControlPassed
        }),
        is("a check that finds nothing", of(ClaimVerdict::True, &[], &wrong), |status| matches!(status, Status::Failed(_))),
        is("a control that finds nothing", of(ClaimVerdict::True, &right, &[vec![]]), |status| matches!(status, Status::Failed(_))),
        is("another finding than expected", of(ClaimVerdict::True, &wrong[0], &wrong), |status| *status == Status::Contradicted),
        is("another verdict than recorded", of(ClaimVerdict::True, &refuted, &wrong), |status| matches!(status, Status::OtherVerdict(_))),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_judgement_of_claims_passes_its_check_and_every_wrong_one_does_not() {
        assert_eq!(JUDGES.failing(&JUDGES.reference).expect("judged"), Vec::new());
        for trial in JUDGES.trials() {
            assert!(!(trial.caught_by)().expect("judged").is_empty(), "{} is not caught", trial.name);
        }
    }
}
