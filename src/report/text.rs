//! What `verify` prints: one line per claim grouped by section, what is wrong, and a count at the end.

use super::findings::{found, judged};
use crate::checks::Finding;
pub use crate::checks::text::Style;
use crate::claims::{Claim, ClaimVerdict, Figures, JudgedClaim, Kind, SECTIONS, Section, Status, order};
use std::fmt::Write;

/// The report of a run: claims by section, what is wrong, and the count as the last line.
pub fn outcomes(outcomes: &[JudgedClaim], style: Style) -> String {
    let width = id_width(outcomes.iter().map(|outcome| outcome.claim));
    let mut text = String::new();
    let mut group = "";
    for outcome in outcomes {
        open_section(&mut text, &mut group, outcome.claim, style);
        let number = decisive(outcome).map(found).unwrap_or_default();
        let alarm = alarm_word(&outcome.status).map(|word| format!("  {}", style.alarm(word))).unwrap_or_default();
        line(&mut text, &format!("  {}  {number}{alarm}", columns(outcome.claim, width)));
    }
    line(&mut text, "");
    for outcome in outcomes {
        complain(&mut text, outcome, style);
    }
    line(&mut text, &hardness(outcomes));
    line(&mut text, &count(outcomes));
    text
}

/// The claims by section, without running anything.
pub fn list(claims: &[&'static Claim], style: Style) -> String {
    let width = id_width(claims.iter().copied());
    let mut text = String::new();
    let mut group = "";
    for claim in claims {
        open_section(&mut text, &mut group, claim, style);
        line(&mut text, &format!("  {}  {}", columns(claim, width), claim.statement.split_whitespace().collect::<Vec<_>>().join(" ")));
    }
    text
}

/// The lines before the last one of `verify`.
fn hardness(outcomes: &[JudgedClaim]) -> String {
    let figures = Figures::sum(outcomes);
    let are = |count: usize| if count == 1 { "is" } else { "are" };
    format!(
        "{}, {} of which repeat{} another one; of {} the controls move {}; {} {} context\n{} {}: {}",
        counted(figures.claims, "claim"),
        figures.repeats,
        if figures.repeats == 1 { "s" } else { "" },
        counted(figures.deciding, "deciding finding"),
        figures.moved,
        counted(figures.context, "finding"),
        are(figures.context),
        figures.assertions,
        if figures.assertions == 1 { "is an assertion" } else { "are assertions" },
        verdicts(outcomes.iter().filter(|outcome| outcome.claim.kind == Kind::Assertion))
    )
}

/// The last line of `verify`.
fn count(outcomes: &[JudgedClaim]) -> String {
    let contradicted = outcomes.iter().filter(|outcome| outcome.status != Status::Supported).count();
    format!("{}: {}; {contradicted} contradicted", counted(outcomes.len(), "claim"), verdicts(outcomes.iter()))
}

/// The name of a problem between quotation marks, or that it has none.
pub fn quoted(name: &str) -> String {
    if name.is_empty() { "without a name".into() } else { format!("`{name}`") }
}

/// A count with its word, in the plural unless it is one.
pub fn counted(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

/// How many claims have which verdict.
fn verdicts<'a>(outcomes: impl Iterator<Item = &'a JudgedClaim> + Clone) -> String {
    let all = [ClaimVerdict::True, ClaimVerdict::Conditional, ClaimVerdict::False, ClaimVerdict::Inconsistent, ClaimVerdict::Ambiguous];
    let count = |verdict| outcomes.clone().filter(|outcome| outcome.claim.verdict == verdict).count();
    all.map(|verdict| format!("{} {}", count(verdict), verdict.words())).join(", ")
}

fn open_section(text: &mut String, group: &mut &'static str, claim: &'static Claim, style: Style) {
    if claim.section() != *group {
        if !group.is_empty() {
            line(text, "");
        }
        *group = claim.section();
        line(text, &style.heading(section_of(claim).map_or(*group, |section| section.title)));
    }
}

pub(super) fn section_of(claim: &Claim) -> Option<&'static Section> {
    order(claim.section()).map(|order| &SECTIONS[order])
}

fn columns(claim: &Claim, width: usize) -> String {
    format!("{:width$}  {:15}  {:13}", claim.id, claim.verdict.words(), claim.evidence.word())
}

fn id_width<'a>(claims: impl Iterator<Item = &'a Claim>) -> usize {
    claims.map(|claim| claim.id.chars().count()).max().unwrap_or(0)
}

/// The finding that the verdict turns on: the first that refutes the sentence, or, where none does, the first that decides.
fn decisive(outcome: &JudgedClaim) -> Option<&Finding> {
    let mut deciding = outcome.findings.iter().filter(|finding| !finding.bearing.context);
    deciding.clone().find(|finding| !finding.supports()).or_else(|| deciding.next())
}

fn alarm_word(status: &Status) -> Option<&'static str> {
    match status {
        Status::Supported => None,
        Status::Contradicted => Some("CONTRADICTED"),
        Status::ControlPassed => Some("CONTROL PASSED"),
        Status::OtherVerdict(_) => Some("OTHER VERDICT"),
        Status::Failed(_) => Some("FAILED"),
    }
}

/// Says in full what keeps an outcome from being supported.
pub(super) fn complain(text: &mut String, outcome: &JudgedClaim, style: Style) {
    let Some(word) = alarm_word(&outcome.status) else { return };
    let reason = match &outcome.status {
        Status::Failed(reason) => format!("the check could not be carried out: {reason}"),
        Status::ControlPassed => "the control passed too, so the check cannot tell the verdict from its opposite".into(),
        Status::OtherVerdict(found) => format!("the findings say: {found}; recorded is: {}", outcome.claim.verdict.words()),
        Status::Contradicted | Status::Supported => "the evidence speaks against the recorded verdict".into(),
    };
    line(text, &format!("{} {}: {reason}", style.alarm(word), outcome.claim.id));
    outcome.findings.iter().filter(|finding| !finding.holds()).for_each(|finding| line(text, &judged(finding)));
}

pub(super) fn line(text: &mut String, content: &str) {
    writeln!(text, "{}", content.trim_end()).expect("writing to a String cannot fail");
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::claims::{CheckFunction, Evidence, Reading, Severity};

    pub(crate) const CLAIM: Claim = Claim {
        id: "S4.example",
        statement: "one is two",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "one is one",
        argument: "1 ≠ 2",
        controls: &["two is fed through"],
        sources: &["chapter §4"],
        check: CheckFunction {
            run: |reading| Ok(vec![Finding::equal("length", reading.pick(1.0, 2.0), 1.0, 0.0, "m").says(2.0)]),
            path: "moreau::claims::example",
        },
    };

    pub(crate) fn outcome(status: Status) -> JudgedClaim {
        let findings = |reading| (CLAIM.check.run)(reading).expect("the example cannot fail");
        JudgedClaim {
            claim: &CLAIM,
            findings: findings(Reading::Recorded),
            controls: vec![findings(Reading::Control(0))],
            witnesses: Vec::new(),
            status,
            seconds: 0.0,
        }
    }

    const PLAIN: Style = Style { colour: false };

    #[test]
    fn a_supported_claim_is_one_line_under_its_section_and_the_count_is_last() {
        let text = outcomes(&[outcome(Status::Supported)], PLAIN);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[0], "§4 Stewart–Trinkle time-stepping");
        assert_eq!(lines[1], "  S4.example  false as stated  exact          length: 1 m");
        assert_eq!(lines.last(), Some(&"1 claim: 0 true, 0 conditional, 1 false as stated, 0 inconsistent, 0 ambiguous; 0 contradicted"));
    }

    #[test]
    fn whatever_is_not_supported_counts_as_contradicted_and_is_explained_before_the_count() {
        let all = [outcome(Status::Contradicted), outcome(Status::ControlPassed), outcome(Status::Failed("no answer".into()))];
        let text = outcomes(&all, PLAIN);
        assert!(text.ends_with("; 3 contradicted\n"));
        for words in
            ["CONTRADICTED S4.example", "CONTROL PASSED S4.example", "FAILED S4.example: the check could not be carried out: no answer"]
        {
            assert!(text.contains(words), "{words:?} is missing in\n{text}");
        }
    }

    #[test]
    fn the_number_of_a_line_is_that_of_the_finding_the_verdict_turns_on() {
        let mut judged = outcome(Status::Supported);
        let (beside, agrees, refutes) = (Finding::count("a", 1, 1).context(), Finding::count("b", 2, 2), Finding::count("c", 3, 3).says(4));
        judged.findings = vec![beside.clone(), agrees.clone(), refutes];
        assert_eq!(decisive(&judged).map(|finding| finding.name.as_str()), Some("c"));
        judged.findings.pop();
        assert_eq!(decisive(&judged).map(|finding| finding.name.as_str()), Some("b"));
        judged.findings.clear();
        assert!(decisive(&judged).is_none());
    }

    #[test]
    fn colour_appears_only_when_asked_for() {
        assert!(!outcomes(&[outcome(Status::Contradicted)], PLAIN).contains('\u{1b}'));
        assert!(outcomes(&[outcome(Status::Contradicted)], Style { colour: true }).contains("\u{1b}[1;31mCONTRADICTED"));
    }
}
