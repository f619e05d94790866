//! All claims in the chapter's order, and how one is judged.

use super::moved::{counterpart, held_against_recorded, is_moved};
use super::{Claim, ClaimVerdict, Reading, derive, group_of};
use crate::checks::{Finding, Voice};
use moreau_exact::witness::{Witness, collect};
use serde::Serialize;
use std::time::Instant;

/// Whether the evidence supports the recorded verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Every finding holds, and the control was contradicted.
    Supported,
    /// A finding fails: the evidence speaks against the recorded verdict.
    Contradicted,
    /// A control passed as well, leads to the same verdict, or moves nothing that another one does not: the check cannot tell the verdict
    /// from its opposite.
    ControlPassed,
    /// What the findings say of the sentence is another verdict than the recorded one; in words.
    OtherVerdict(String),
    /// The check could not be carried out.
    Failed(String),
}

/// The judgement of one claim.
pub struct JudgedClaim {
    /// The claim.
    pub claim: &'static Claim,
    /// Findings of the recorded reading.
    pub findings: Vec<Finding>,
    /// Findings of each control.
    pub controls: Vec<Vec<Finding>>,
    /// Witnesses of the exact decisions of the recorded reading, each once; none unless [`judge_with_witnesses`] was asked.
    pub witnesses: Vec<Witness>,
    /// The conclusion.
    pub status: Status,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// Every registered claim, in the chapter's order.
pub fn all() -> impl Iterator<Item = &'static Claim> {
    let sections: [&[&[Claim]]; 16] = [
        super::front::CLAIMS,
        super::s0::CLAIMS,
        super::s1::CLAIMS,
        super::s2::CLAIMS,
        super::s3::CLAIMS,
        super::s4::CLAIMS,
        super::s5::CLAIMS,
        super::s6::CLAIMS,
        super::s7::CLAIMS,
        super::s8::CLAIMS,
        super::s9::CLAIMS,
        super::s10::CLAIMS,
        super::s11::CLAIMS,
        super::s12::CLAIMS,
        super::manual::CLAIMS,
        super::v::CLAIMS,
    ];
    sections.into_iter().flatten().copied().flatten()
}

/// The claim with this id.
///
/// ```
/// use moreau::claims::{self, ClaimVerdict};
///
/// let claim = claims::find("S12.qplus").expect("registered");
/// assert_eq!((claim.verdict, claim.section()), (ClaimVerdict::False, "S12"));
/// assert!(claims::find("S12.nothing").is_none());
/// ```
pub fn find(id: &str) -> Option<&'static Claim> {
    all().find(|claim| claim.id.eq_ignore_ascii_case(id))
}

/// Whether an id lies in a group given by dot-separated parts: `S4` holds `S4.sigma` but not `S40.x`, and `R` holds `R6`.
pub fn matches_group(id: &str, group: &str) -> bool {
    let mut parts = id.split('.');
    let same = |part: &str, wanted: &str| part.eq_ignore_ascii_case(wanted);
    same(group, group_of(id)) || group.split('.').all(|wanted| parts.next().is_some_and(|part| same(part, wanted)))
}

/// Runs the check of a claim on the recorded reading and on its controls.
pub fn judge(claim: &'static Claim) -> JudgedClaim {
    judged(claim, |run| (run(), Vec::new()))
}

/// The same, with the witnesses of the exact decisions that the check made of the recorded reading.
pub fn judge_with_witnesses(claim: &'static Claim) -> JudgedClaim {
    judged(claim, |run| collect(run))
}

fn judged(claim: &'static Claim, record: impl FnOnce(&dyn Fn() -> crate::Result<Vec<Finding>>) -> Recorded) -> JudgedClaim {
    let start = Instant::now();
    let (recorded, all) = record(&|| (claim.check.run)(Reading::Recorded));
    let controls = (0..claim.controls.len()).map(|place| (claim.check.run)(Reading::Control(place))).collect::<crate::Result<Vec<_>>>();
    let status = match (&recorded, &controls) {
        (Err(error), _) => Status::Failed(error.to_string()),
        (_, Err(error)) => Status::Failed(format!("control: {error}")),
        (Ok(findings), Ok(controls)) => conclude(claim.verdict, findings, controls),
    };
    let mut witnesses: Vec<Witness> = Vec::new();
    for witness in all {
        if !witnesses.contains(&witness) {
            witnesses.push(witness);
        }
    }
    JudgedClaim {
        claim,
        findings: recorded.unwrap_or_default(),
        controls: controls.unwrap_or_default(),
        witnesses,
        status,
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// What the recorded reading found, and the witnesses that were kept.
type Recorded = (crate::Result<Vec<Finding>>, Vec<Witness>);

/// What the findings of the claim and of its controls say of the recorded verdict.
pub fn conclude(verdict: ClaimVerdict, findings: &[Finding], controls: &[Vec<Finding>]) -> Status {
    if findings.is_empty() || controls.is_empty() || controls.iter().any(Vec::is_empty) {
        return Status::Failed("the check found nothing".into());
    }
    if !findings.iter().all(Finding::holds) {
        return Status::Contradicted;
    }
    match derive(findings) {
        Ok(found) if found != verdict => return Status::OtherVerdict(found.words().into()),
        Err(problem) => return Status::OtherVerdict(problem.into()),
        _ => {}
    }
    let first = &controls[0];
    let passed = same_verdict(verdict, findings, first) || !bites(verdict, findings, first) || first.iter().all(Finding::holds);
    if passed || controls.len() > 1 && idle(findings, controls) { Status::ControlPassed } else { Status::Supported }
}

/// Whether the first control moves a deciding finding; of passages, whether it is an instance of which they state something else.
fn bites(verdict: ClaimVerdict, findings: &[Finding], control: &[Finding]) -> bool {
    let reworded = |finding: &Finding| counterpart(finding, findings, control).is_some_and(|other| other.stated() != finding.stated());
    let of_passages = |finding: &Finding| verdict == ClaimVerdict::Inconsistent && is_passage(finding) && reworded(finding);
    findings.iter().any(|finding| !finding.bearing.context && (is_moved(finding, findings, control) || of_passages(finding)))
}

fn is_passage(finding: &Finding) -> bool {
    matches!(finding.bearing.voice, Voice::Passage(_))
}

/// Whether a control leads to the recorded verdict too, by what it expects and states itself or by what the recorded check does. Opinions
/// stay opinions. What two passages state must be borne out by what the control finds: there they agree, with the number and with
/// each other.
fn same_verdict(verdict: ClaimVerdict, findings: &[Finding], control: &[Finding]) -> bool {
    let opinion = |finding: &Finding| matches!(finding.bearing.voice, Voice::Opinion(_));
    match verdict {
        ClaimVerdict::Ambiguous if findings.iter().any(opinion) => false,
        ClaimVerdict::Inconsistent => !control.iter().filter(|finding| is_passage(finding)).all(Finding::supports),
        _ => [control, &held_against_recorded(findings, control)].into_iter().any(|all| derive(all) == Ok(verdict)),
    }
}

/// Whether a control after the first moves no deciding finding but those that one before it moves.
fn idle(findings: &[Finding], controls: &[Vec<Finding>]) -> bool {
    let moved = |control: &[Finding]| {
        let moves = |finding: &&Finding| !finding.bearing.context && is_moved(finding, findings, control);
        findings.iter().filter(moves).map(std::ptr::from_ref).collect::<Vec<_>>()
    };
    let mut before = moved(&controls[0]);
    controls[1..].iter().any(|control| {
        let now = moved(control);
        let nothing_new = now.iter().all(|finding| before.contains(finding));
        before.extend(now);
        nothing_new
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::REPEATS;
    use std::collections::HashSet;

    fn found(measured: usize) -> Finding {
        Finding::count("k", measured, 1)
    }

    #[test]
    fn a_verdict_that_does_not_follow_from_the_findings_is_not_supported() {
        let (refuting, supporting) = ([found(1).says(2)], [found(1)]);
        assert_eq!(conclude(ClaimVerdict::False, &refuting, &[vec![found(2).says(2)]]), Status::Supported);
        assert!(matches!(conclude(ClaimVerdict::True, &refuting, &[vec![found(2)]]), Status::OtherVerdict(_)));
        assert!(matches!(conclude(ClaimVerdict::False, &supporting, &[vec![found(2)]]), Status::OtherVerdict(_)));
        assert!(matches!(conclude(ClaimVerdict::True, &[found(1).context()], &[vec![found(2)]]), Status::OtherVerdict(_)));
    }

    #[test]
    fn a_control_that_passes_or_leads_to_the_same_verdict_is_reported() {
        assert_eq!(conclude(ClaimVerdict::True, &[found(1)], &[vec![found(1)]]), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::True, &[found(1)], &[vec![found(1)]]), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::False, &[found(1).says(2)], &[vec![found(3).says(2)]]), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::True, &[found(1)], &[vec![found(1), found(2).context()]]), Status::ControlPassed);
    }

    #[test]
    fn a_control_that_changes_what_is_expected_or_said_is_reported() {
        let conclude = |verdict, recorded: Finding, control: Finding| conclude(verdict, &[recorded], &[vec![control]]);
        let count = Finding::count;
        assert_eq!(conclude(ClaimVerdict::True, found(1), count("k", 1, 2)), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::False, found(1).says(2), found(1).says(1)), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::False, found(1).says(2), count("k", 3, 1).says(3)), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::False, found(1).says(2), count("k", 2, 2).says(2)), Status::ControlPassed);
        assert_eq!(conclude(ClaimVerdict::False, found(1).says(2), found(2).says(2)), Status::Supported);
        // another name, a number that is none, context alone
        assert_eq!(conclude(ClaimVerdict::False, found(1).says(2), count("other", 2, 1)), Status::ControlPassed);
        let nan = |value: f64| Finding::equal("x", value, 1.0, 0.0, "m");
        assert_eq!(conclude(ClaimVerdict::True, nan(1.0), nan(f64::NAN)), Status::ControlPassed);
        let beside = |value: usize| vec![found(1).says(2).opinion("taste"), count("c", value, 1).context()];
        assert_eq!(super::conclude(ClaimVerdict::Ambiguous, &beside(1), &[beside(2)]), Status::ControlPassed);
    }

    #[test]
    fn in_the_control_of_passages_both_are_borne_out() {
        let passages = |found: usize, one: usize, other: usize| {
            let finding = Finding::count("k", found, 1);
            vec![finding.clone().says(one).passage("§1"), finding.says(other).passage("§2")]
        };
        let conclude = |control: Vec<Finding>| conclude(ClaimVerdict::Inconsistent, &passages(1, 1, 2), &[control]);
        assert_eq!(conclude(passages(0, 0, 0)), Status::Supported);
        assert_eq!(conclude(passages(1, 2, 2)), Status::ControlPassed);
        assert_eq!(conclude(passages(0, 0, 2)), Status::ControlPassed);
        assert_eq!(conclude(passages(1, 1, 1)), Status::ControlPassed);
        assert_eq!(conclude(vec![Finding::count("other", 2, 1)]), Status::ControlPassed);
    }

    #[test]
    fn a_further_control_moves_a_deciding_finding_that_none_before_it_moves() {
        let findings = |a, b| vec![Finding::count("a", a, 1), Finding::count("b", b, 1)];
        let conclude = |controls: &[Vec<Finding>]| conclude(ClaimVerdict::True, &findings(1, 1), controls);
        assert_eq!(conclude(&[findings(2, 1), findings(1, 2)]), Status::Supported);
        assert_eq!(conclude(&[findings(2, 1), findings(2, 1)]), Status::ControlPassed);
        assert_eq!(conclude(&[findings(1, 1), findings(1, 2)]), Status::ControlPassed);
        assert_eq!(conclude(&[findings(2, 1), findings(1, 2), findings(2, 1)]), Status::ControlPassed, "not only the one before it");
        assert_eq!(conclude(&[findings(2, 1), findings(1, 2), vec![]]), Status::Failed("the check found nothing".into()));
    }

    #[test]
    fn nothing_found_and_a_finding_that_fails_are_reported() {
        assert!(matches!(conclude(ClaimVerdict::True, &[], &[vec![found(2)]]), Status::Failed(_)));
        assert!(matches!(conclude(ClaimVerdict::True, &[found(1)], &[vec![]]), Status::Failed(_)));
        assert_eq!(conclude(ClaimVerdict::True, &[found(2)], &[vec![found(2)]]), Status::Contradicted);
    }

    /// A claim with two controls and another check.
    fn planted(run: fn(Reading) -> crate::Result<Vec<Finding>>) -> JudgedClaim {
        let check = super::super::CheckFunction { run, path: "planted" };
        let model = find("S4.copos-plus").expect("the claim is registered");
        judge(Box::leak(Box::new(Claim { check, verdict: ClaimVerdict::True, controls: &["one", "other"], ..*model })))
    }

    fn failed(why: &str) -> crate::Result<Vec<Finding>> {
        Err(crate::Error::Unsupported(why.into()))
    }

    #[test]
    fn an_error_in_the_check_or_in_any_control_is_a_failure() {
        fn pair(a: usize, b: usize) -> crate::Result<Vec<Finding>> {
            Ok(vec![Finding::count("a", a, 1), Finding::count("b", b, 1)])
        }
        fn sound(reading: Reading) -> crate::Result<Vec<Finding>> {
            pair(reading.only(0).pick(1, 2), reading.only(1).pick(1, 2))
        }
        fn fails(reading: Reading, under: Reading) -> crate::Result<Vec<Finding>> {
            if reading == under { failed("planted") } else { sound(reading) }
        }
        assert_eq!(planted(sound).status, Status::Supported);
        let of = |judged: JudgedClaim| match judged.status {
            Status::Failed(why) => why,
            other => panic!("{other:?}"),
        };
        let recorded = of(planted(|reading| fails(reading, Reading::Recorded)));
        assert!(recorded.contains("planted") && !recorded.contains("control"), "{recorded}");
        let [first, second] =
            [of(planted(|reading| fails(reading, Reading::Control(0)))), of(planted(|reading| fails(reading, Reading::Control(1))))];
        for control in [first, second] {
            assert!(control.starts_with("control: ") && control.contains("planted"), "{control}");
        }
    }

    #[test]
    fn groups_match_whole_parts_only() {
        assert!(matches_group("S1.weakstar", "S1"));
        assert!(!matches_group("S12.step", "S1"));
        assert!(matches_group("S12.step", "S12.step"));
        assert!(!matches_group("S12.step", "S12.step.more"));
        assert!(!matches_group("S12.step", "S12.st"));
    }

    #[test]
    fn an_id_without_a_dot_belongs_to_the_letters_before_its_number() {
        assert!(matches_group("R6", "R") && matches_group("R6", "R6"));
        assert!(!matches_group("R16", "R1") && !matches_group("R1", "R16"));
        assert!(!matches_group("S12.step", "S"));
        assert_eq!([group_of("R6"), group_of("S12.step")], ["R", "S12"]);
    }

    #[test]
    fn a_severity_is_given_for_what_does_not_hold_and_for_nothing_else() {
        for claim in all() {
            let fails = matches!(claim.verdict, ClaimVerdict::Conditional | ClaimVerdict::False | ClaimVerdict::Inconsistent);
            assert_eq!(claim.severity.is_some(), fails, "{}", claim.id);
        }
    }

    #[test]
    fn a_repetition_has_the_verdict_of_its_original_which_repeats_nothing() {
        for (repetition, original) in REPEATS {
            let verdict = |id: &str| find(id).unwrap_or_else(|| panic!("no claim {id}")).verdict;
            assert_eq!(verdict(repetition), verdict(original), "{repetition} repeats {original}");
            assert!(REPEATS.iter().all(|(other, _)| other != original), "{original} is a repetition itself");
            assert_eq!(REPEATS.iter().filter(|(other, _)| other == repetition).count(), 1, "{repetition}");
        }
    }

    #[test]
    fn ids_are_unique_and_texts_are_present() {
        let mut seen = HashSet::new();
        for claim in all() {
            assert!(seen.insert(claim.id), "{} is registered twice", claim.id);
            let texts = [claim.statement, claim.correct_statement, claim.argument];
            assert!(texts.iter().chain(claim.controls).all(|text| text.len() > 3), "{} lacks a text", claim.id);
            assert!(!claim.controls.is_empty(), "{} lacks a control", claim.id);
            assert!(!claim.sources.is_empty(), "{} lacks a source", claim.id);
        }
    }
}
