//! A judged claim as the pages show it: numbers rounded as in the terminal, verdicts as they were judged.

use crate::checks::{Finding, Voice};
use crate::claims::{Claim, ClaimVerdict, JudgedClaim, PLACES, Place, derive, errata, original, title_in_tex};
use crate::claims::{Evidence as Grade, Kind as Sentence, Severity as Wrong};
use crate::number::two_digits;
use crate::report::explanation::{comes_out_otherwise, elsewhere};
use crate::report::findings::{awaited, measured, stated};
use crate::report::text::{complaint, decisive};
use moreau_site::pages::axes::{Evidence, Kind, Role, Severity, Verdict};
use moreau_site::pages::data::{ClaimEntry, ControlEntry, Erratum, FindingEntry, PlaceEntry, Voice as Said};

/// The claim with what was found.
pub fn entry(outcome: &JudgedClaim) -> ClaimEntry {
    let claim = outcome.claim;
    let all = |findings: &[Finding]| findings.iter().map(finding).collect();
    ClaimEntry {
        id: claim.id.into(),
        group: claim.section().into(),
        title: title_in_tex(claim.id).into(),
        statement: claim.statement.into(),
        plain: [claim.statement(), claim.correct_statement()],
        verdict: verdict(claim.verdict),
        kind: kind(claim.kind),
        severity: claim.severity.map(severity),
        evidence: evidence(claim.evidence),
        repeats: original(claim.id).map(String::from),
        alarm: complaint(outcome).map(|(word, reason)| format!("{word}: {reason}")),
        deciding: decisive(outcome).map(finding),
        findings: all(&outcome.findings),
        argument: claim.argument.into(),
        correct: claim.correct_statement.into(),
        controls: outcome.controls.iter().enumerate().map(|(place, findings)| control(outcome, place, findings)).collect(),
        places: PLACES.of(claim.id).iter().map(place).collect(),
        absent: absent(claim),
        sources: claim.sources.iter().map(ToString::to_string).collect(),
        check: claim.check.path.into(),
        erratum: errata::chinese(claim.id).map(erratum),
    }
}

fn erratum(erratum: &errata::Erratum) -> Erratum {
    Erratum { says: erratum.says.clone(), wrong: erratum.wrong.clone(), reads: erratum.correct.clone() }
}

fn absent(claim: &Claim) -> Option<String> {
    PLACES.absent.get(claim.id).cloned()
}

fn place(place: &Place) -> PlaceEntry {
    PlaceEntry {
        section: place.section.clone(),
        heading: place.heading.clone(),
        paragraph: place.paragraph,
        line: place.line,
        percent: place.percent,
        words: place.words.clone(),
    }
}

fn finding(finding: &Finding) -> FindingEntry {
    let bearing = &finding.bearing;
    let voice = match bearing.voice {
        Voice::Sentence => None,
        Voice::Passage(passage) => Some(Said::Passage(passage.into())),
        Voice::Reading(reading) => Some(Said::Reading(reading.into())),
        Voice::Opinion(point) => Some(Said::Opinion(point.into())),
    };
    let quoted = bearing.stated.is_some() || matches!(bearing.voice, Voice::Passage(_) | Voice::Reading(_));
    FindingEntry {
        role: role(finding),
        name: finding.name.clone(),
        found: measured(finding),
        expected: awaited(finding),
        stated: (quoted && !bearing.context).then(|| stated(finding)),
        voice,
        violated: bearing.violated.map(String::from),
        used: finding.used().map(two_digits),
    }
}

fn role(finding: &Finding) -> Role {
    match (finding.holds(), finding.bearing.context, finding.supports()) {
        (false, _, _) => Role::Fails,
        (_, true, _) => Role::Context,
        (_, _, true) => Role::Supports,
        (_, _, false) => Role::Refutes,
    }
}

/// A control with the findings that come out otherwise. What it expects is that of the recorded subject, so that none of them fails.
fn control(outcome: &JudgedClaim, place: usize, findings: &[Finding]) -> ControlEntry {
    let shown = findings.iter().filter(|finding| comes_out_otherwise(finding, findings, &outcome.findings));
    let entry = |one: &Finding| {
        let one = elsewhere(one);
        let role = match (one.bearing.context, one.supports()) {
            (true, _) => Role::Context,
            (_, true) => Role::Supports,
            (_, false) => Role::Refutes,
        };
        FindingEntry { role, ..finding(&one) }
    };
    ControlEntry {
        subject: outcome.claim.controls[place].into(),
        verdict: derive(findings).ok().filter(|found| *found != outcome.claim.verdict).map(verdict),
        findings: shown.map(entry).collect(),
    }
}

fn verdict(verdict: ClaimVerdict) -> Verdict {
    match verdict {
        ClaimVerdict::True => Verdict::True,
        ClaimVerdict::Conditional => Verdict::Conditional,
        ClaimVerdict::False => Verdict::False,
        ClaimVerdict::Inconsistent => Verdict::Inconsistent,
        ClaimVerdict::Ambiguous => Verdict::Ambiguous,
    }
}

fn kind(kind: Sentence) -> Kind {
    match kind {
        Sentence::Assertion => Kind::Assertion,
        Sentence::Exercise => Kind::Exercise,
        Sentence::Definition => Kind::Definition,
        Sentence::Citation => Kind::Citation,
        Sentence::Path => Kind::Path,
        Sentence::Advice => Kind::Advice,
        Sentence::Opinion => Kind::Opinion,
    }
}

fn severity(severity: Wrong) -> Severity {
    match severity {
        Wrong::Misprint => Severity::Misprint,
        Wrong::WrongReason => Severity::WrongReason,
        Wrong::MissingHypothesis => Severity::MissingHypothesis,
        Wrong::WrongStatement => Severity::WrongStatement,
        Wrong::BrokenTheorem => Severity::BrokenTheorem,
    }
}

fn evidence(evidence: Grade) -> Evidence {
    match evidence {
        Grade::Exact => Evidence::Exact,
        Grade::Certified => Evidence::Certified,
        Grade::Measured => Evidence::Measured,
        Grade::Cited => Evidence::Cited,
        Grade::NotDecidable => Evidence::NotDecidable,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::Status;
    use crate::report::text::tests::outcome;
    use moreau_site::pages::axes::Axis;

    #[test]
    fn a_claim_is_shown_with_its_deciding_finding_and_its_control() {
        let entry = entry(&outcome(Status::Supported));
        assert_eq!((entry.verdict, entry.severity, entry.alarm.as_deref()), (Verdict::False, Some(Severity::WrongStatement), None));
        let deciding = entry.deciding.expect("one decides");
        assert_eq!((deciding.role, deciding.found.as_str(), deciding.stated.as_deref()), (Role::Refutes, "1 m", Some("2")));
        assert_eq!((entry.controls[0].verdict, entry.controls[0].findings[0].role), (Some(Verdict::True), Role::Supports));
    }

    #[test]
    fn what_is_not_supported_says_why() {
        for (status, word) in [
            (Status::Contradicted, "CONTRADICTED"),
            (Status::ControlPassed, "CONTROL PASSED"),
            (Status::OtherVerdict("true".into()), "OTHER VERDICT"),
            (Status::Failed("no answer".into()), "no answer"),
        ] {
            let alarm = entry(&outcome(status)).alarm.expect("an alarm");
            assert!(alarm.contains(word), "{alarm}");
        }
    }

    #[test]
    fn the_words_of_the_pages_are_those_of_the_terminal() {
        for claim in crate::claims::all() {
            assert_eq!(verdict(claim.verdict).words().en, claim.verdict.words());
            assert_eq!(kind(claim.kind).words().en, claim.kind.words());
            assert_eq!(claim.severity.map(|wrong| severity(wrong).words().en), claim.severity.map(Wrong::words));
            assert_eq!(evidence(claim.evidence).words().en, claim.evidence.word());
        }
    }
}
