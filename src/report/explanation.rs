//! What `verify --explain` prints: one claim in full.

use super::findings::{bearing, told};
use super::text::{coloured, complain, line, section_of};
use crate::checks::text::Style;
use crate::checks::{Finding, Voice};
use crate::claims::{CHAPTER, Claim, ClaimVerdict, JudgedClaim, PLACES, Status, counterpart, derive, is_moved, original};

/// One claim in full: statement, verdict, argument, findings, corrected statement, controls and sources.
pub fn explanation(outcome: &JudgedClaim, style: Style) -> String {
    let claim = outcome.claim;
    let title = section_of(claim).map_or(claim.section(), |section| section.title);
    let mut text = String::new();
    let wrap = |prose: &str| style.wrapped("  ", "  ", prose);
    line(&mut text, &style.wrapped("", "  ", &style.heading(&format!("{} – {title}", claim.id))));
    line(&mut text, &style.wrapped("", "  ", &format!("of {CHAPTER}")));
    let severity = claim.severity.map(|severity| format!(", {}", severity.words())).unwrap_or_default();
    let repeated = original(claim.id).map(|original| format!("; repeats {original}")).unwrap_or_default();
    let verdict = coloured(claim.verdict, claim.verdict.words(), style);
    let verdict = format!("verdict: {verdict}{severity} (evidence: {}; {}{repeated})", claim.evidence.word(), claim.kind.words());
    line(&mut text, &style.wrapped("", "  ", &verdict));
    let mut part = |name: &str, body: &[String]| {
        line(&mut text, &format!("\n{}", style.heading(name)));
        body.iter().for_each(|paragraph| line(&mut text, paragraph));
    };
    part("The chapter says", &[wrap(&claim.statement())]);
    part("Place in the chapter", &places(claim).iter().map(|place| wrap(place)).collect::<Vec<_>>());
    part(if claim.verdict == ClaimVerdict::True { "Proof" } else { "Proof or counterexample" }, &[wrap(&claim.argument())]);
    part("What this run found", &outcome.findings.iter().map(|finding| style.wrapped("", FINDING, &told(finding))).collect::<Vec<_>>());
    part("Correct statement", &[wrap(&claim.correct_statement())]);
    for (place, findings) in outcome.controls.iter().enumerate() {
        part("Control", &control(outcome, place, findings, style));
    }
    part("Sources", &claim.sources.iter().map(|source| wrap(source)).collect::<Vec<_>>());
    part("Check", &[wrap(claim.check.path)]);
    line(&mut text, "");
    complain(&mut text, outcome, style);
    if outcome.status == Status::Supported {
        line(&mut text, "the evidence supports the verdict");
    }
    text
}

/// Where the second line of a finding begins.
const FINDING: &str = "             ";

/// Where the chapter says it, or why it does not.
fn places(claim: &Claim) -> Vec<String> {
    let absent = PLACES.absent.get(claim.id).map(|reason| format!("not in the chapter: {reason}"));
    PLACES.of(claim.id).iter().map(ToString::to_string).chain(absent).collect()
}

/// A control: what it changes, the findings that come out otherwise, those that it does not ask for, and what follows.
fn control(outcome: &JudgedClaim, place: usize, findings: &[Finding], style: Style) -> Vec<String> {
    let deciding = |finding: &&Finding| !finding.bearing.context;
    let (shown, same): (Vec<&Finding>, Vec<&Finding>) =
        findings.iter().partition(|finding| comes_out_otherwise(finding, findings, &outcome.findings));
    let absent = |finding: &&Finding| counterpart(finding, &outcome.findings, findings).is_none();
    let missing: Vec<&str> = outcome.findings.iter().filter(deciding).filter(absent).map(|finding| finding.name.as_str()).collect();
    let wrap = |prose: &str| style.wrapped("  ", "  ", prose);
    let mut lines = vec![wrap(&outcome.claim.controls()[place])];
    lines.extend(shown.iter().map(|finding| style.wrapped("", FINDING, &bearing(&elsewhere(finding)))));
    if same.iter().any(deciding) {
        lines.push("  the other findings come out as above".into());
    }
    if !missing.is_empty() {
        lines.push(wrap(&format!("not asked of this subject: {}", missing.join("; "))));
    }
    lines.push(match (&outcome.status, derive(findings)) {
        (Status::ControlPassed, _) => wrap(&style.alarm("the control was NOT contradicted")),
        (_, Ok(verdict)) if verdict != outcome.claim.verdict => {
            wrap(&format!("with this control the verdict is another one, as it must be: {}", verdict.words()))
        }
        _ => wrap("with this control something else is found, as it must be"),
    });
    lines
}

/// Whether a finding of a control is to be shown: it is moved, bears otherwise on the sentence, is held against another statement of a
/// passage, or stands in the place of none.
pub(super) fn comes_out_otherwise(finding: &Finding, findings: &[Finding], recorded: &[Finding]) -> bool {
    let Some(above) = counterpart(finding, findings, recorded) else { return true };
    let passage = matches!(finding.bearing.voice, Voice::Passage(_));
    let reworded = passage && above.stated() != finding.stated();
    let bears_otherwise = above.supports() != finding.supports() || above.holds() != finding.holds();
    reworded || !finding.bearing.context && bears_otherwise || is_moved(above, recorded, findings)
}

/// A finding of a control: that a condition is not met is said of the recorded instance, not of this one.
pub(super) fn elsewhere(finding: &Finding) -> Finding {
    let mut finding = finding.clone();
    finding.bearing.violated = None;
    finding
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::tests::outcome;

    const PLAIN: Style = Style::PLAIN;

    #[test]
    fn an_explanation_shows_verdict_argument_numbers_correction_control_and_sources() {
        let text = explanation(&outcome(Status::Supported), PLAIN);
        for words in [
            "false as stated",
            "one is two",
            "1 ≠ 2",
            "[refutes ] length: 1 m (the sentence says 2; expected 1 ± 0)",
            "one is one",
            "[supports] length: 2 m (the sentence says 2)",
            "with this control the verdict is another one, as it must be: true",
            "chapter §4",
        ] {
            assert!(text.contains(words), "{words:?} is missing in\n{text}");
        }
    }

    #[test]
    fn a_control_that_passes_is_called_out() {
        let mut outcome = outcome(Status::ControlPassed);
        outcome.controls = vec![outcome.findings.clone()];
        assert!(explanation(&outcome, PLAIN).contains("NOT contradicted"));
    }

    #[test]
    fn no_line_of_an_explanation_is_wider_than_the_terminal() {
        for width in [60, 80] {
            let text = explanation(&outcome(Status::Supported), Style { width, ..PLAIN });
            assert!(text.lines().all(|line| line.chars().count() <= width), "{text}");
        }
    }
}
