//! What `verify --explain` prints: one claim in full.

use super::findings::{bearing, told};
use super::text::{complain, line, section_of};
use crate::checks::text::Style;
use crate::checks::{Finding, Voice};
use crate::claims::{Claim, ClaimVerdict, JudgedClaim, PLACES, Status, counterpart, derive, is_moved, original};

/// Columns of wrapped prose.
const WIDTH: usize = 100;

/// One claim in full: statement, verdict, argument, findings, corrected statement, controls and sources.
pub fn explanation(outcome: &JudgedClaim, style: Style) -> String {
    let claim = outcome.claim;
    let title = section_of(claim).map_or(claim.section(), |section| section.title);
    let mut text = String::new();
    line(&mut text, &style.heading(&format!("{} – {title}", claim.id)));
    let severity = claim.severity.map(|severity| format!(", {}", severity.words())).unwrap_or_default();
    let repeated = original(claim.id).map(|original| format!("; repeats {original}")).unwrap_or_default();
    line(
        &mut text,
        &format!("verdict: {}{severity} (evidence: {}; {}{repeated})", claim.verdict.words(), claim.evidence.word(), claim.kind.words()),
    );
    let mut part = |name: &str, body: &[String]| {
        line(&mut text, &format!("\n{}", style.heading(name)));
        body.iter().for_each(|paragraph| line(&mut text, paragraph));
    };
    part("The chapter says", &[wrap(claim.statement)]);
    part("Place in the chapter", &places(claim));
    part(if claim.verdict == ClaimVerdict::True { "Proof" } else { "Proof or counterexample" }, &[wrap(claim.argument)]);
    part("What this run found", &outcome.findings.iter().map(told).collect::<Vec<_>>());
    part("Correct statement", &[wrap(claim.correct_statement)]);
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

/// Where the chapter says it, or why it does not.
fn places(claim: &Claim) -> Vec<String> {
    let absent = PLACES.absent.get(claim.id).map(|reason| wrap(&format!("not in the chapter: {reason}")));
    PLACES.of(claim.id).iter().map(|place| wrap(&place.to_string())).chain(absent).collect()
}

/// A control: what it changes, the findings that come out otherwise, those that it does not ask for, and what follows.
fn control(outcome: &JudgedClaim, place: usize, findings: &[Finding], style: Style) -> Vec<String> {
    let deciding = |finding: &&Finding| !finding.bearing.context;
    let (shown, same): (Vec<&Finding>, Vec<&Finding>) =
        findings.iter().partition(|finding| comes_out_otherwise(finding, findings, &outcome.findings));
    let absent = |finding: &&Finding| counterpart(finding, &outcome.findings, findings).is_none();
    let missing: Vec<&str> = outcome.findings.iter().filter(deciding).filter(absent).map(|finding| finding.name.as_str()).collect();
    let mut lines = vec![wrap(outcome.claim.controls[place])];
    lines.extend(shown.iter().map(|finding| bearing(&elsewhere(finding))));
    if same.iter().any(deciding) {
        lines.push("  the other findings come out as above".into());
    }
    if !missing.is_empty() {
        lines.push(wrap(&format!("not asked of this subject: {}", missing.join("; "))));
    }
    lines.push(match (&outcome.status, derive(findings)) {
        (Status::ControlPassed, _) => format!("  {}", style.alarm("the control was NOT contradicted")),
        (_, Ok(verdict)) if verdict != outcome.claim.verdict => {
            format!("  with this control the verdict is another one, as it must be: {}", verdict.words())
        }
        _ => "  with this control something else is found, as it must be".into(),
    });
    lines
}

/// Whether a finding of a control is to be shown: it is moved, bears otherwise on the sentence, is held against another statement of a
/// passage, or stands in the place of none.
fn comes_out_otherwise(finding: &Finding, findings: &[Finding], recorded: &[Finding]) -> bool {
    let Some(above) = counterpart(finding, findings, recorded) else { return true };
    let passage = matches!(finding.bearing.voice, Voice::Passage(_));
    let reworded = passage && above.stated() != finding.stated();
    let bears_otherwise = above.supports() != finding.supports() || above.holds() != finding.holds();
    reworded || !finding.bearing.context && bears_otherwise || is_moved(above, recorded, findings)
}

/// A finding of a control: that a condition is not met is said of the recorded instance, not of this one.
fn elsewhere(finding: &Finding) -> Finding {
    let mut finding = finding.clone();
    finding.bearing.violated = None;
    finding
}

/// Breaks prose at spaces into indented lines; its own line breaks stay.
fn wrap(prose: &str) -> String {
    let mut lines = Vec::new();
    for paragraph in prose.lines() {
        let mut current = String::new();
        for word in paragraph.split_whitespace() {
            if !current.is_empty() && current.chars().count() + 1 + word.chars().count() > WIDTH {
                lines.push(std::mem::take(&mut current));
            }
            if !current.is_empty() {
                current.push(' ');
            }
            current.push_str(word);
        }
        lines.push(current);
    }
    lines.iter().map(|line| format!("  {line}")).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::tests::outcome;

    const PLAIN: Style = Style { colour: false };

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
    fn prose_is_wrapped_at_spaces_and_keeps_its_line_breaks() {
        let long = "word ".repeat(50);
        assert!(wrap(&long).lines().all(|line| line.chars().count() <= WIDTH + 2));
        assert_eq!(wrap("a\nb"), "  a\n  b");
    }
}
