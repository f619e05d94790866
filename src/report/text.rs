//! What `verify` prints: one line per claim grouped by section, a count at the end, and the explanation of one claim.

pub use crate::checks::text::Style;
use crate::checks::{Expectation, Finding, Relation, Voice};
use crate::claims::{
    Claim, ClaimVerdict, Figures, JudgedClaim, Kind, PLACES, SECTIONS, Section, Status, counterpart, derive, is_moved, order, original,
};
use crate::number::{significant, two_digits, with_unit};
use std::fmt::Write;

/// Columns of wrapped prose.
const WIDTH: usize = 100;

/// Characters of a number above which it is rounded for reading; JSON has all of it.
const LONG: usize = 24;

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

/// The lines before the last one of `verify`.
fn hardness(outcomes: &[JudgedClaim]) -> String {
    let figures = Figures::sum(outcomes);
    format!(
        "{} claims, {} of which repeat another one; of {} deciding findings the controls move {}; \
         {} findings are context\n{} are assertions: {}",
        figures.claims,
        figures.repeats,
        figures.deciding,
        figures.moved,
        figures.context,
        figures.assertions,
        verdicts(outcomes.iter().filter(|outcome| outcome.claim.kind == Kind::Assertion))
    )
}

/// The last line of `verify`.
fn count(outcomes: &[JudgedClaim]) -> String {
    let contradicted = outcomes.iter().filter(|outcome| outcome.status != Status::Supported).count();
    let claims = if outcomes.len() == 1 { "claim" } else { "claims" };
    format!("{} {claims}: {}; {contradicted} contradicted", outcomes.len(), verdicts(outcomes.iter()))
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

fn section_of(claim: &Claim) -> Option<&'static Section> {
    order(claim.section()).map(|order| &SECTIONS[order])
}

fn columns(claim: &Claim, width: usize) -> String {
    format!("{:width$}  {:15}  {:13}", claim.id, claim.verdict.words(), claim.evidence.word())
}

fn id_width<'a>(claims: impl Iterator<Item = &'a Claim>) -> usize {
    claims.map(|claim| claim.id.chars().count()).max().unwrap_or(0)
}

/// What the sentence says, rounded for reading, with how far the found number may differ from it.
fn stated(finding: &Finding) -> String {
    let Expectation { tolerance, .. } = finding.expectation;
    let allowance = if finding.exact.is_none() && tolerance > 0.0 { format!(" ± {}", two_digits(tolerance)) } else { String::new() };
    said(finding) + &allowance
}

/// The same without the allowance.
fn said(finding: &Finding) -> String {
    let stated = finding.stated();
    let number = stated.trim_start_matches(['≤', '≥', '=', ' ']);
    let sign = &stated[..stated.len() - number.len()];
    match number.parse::<f64>() {
        Ok(rounded) if finding.exact.is_none() => format!("{sign}{}", significant(rounded)),
        _ if number.chars().count() <= LONG => stated.clone(),
        Ok(rounded) => format!("{sign}{}", significant(rounded)),
        Err(_) => format!("{sign}{}…", number.chars().take(LONG).collect::<String>()),
    }
}

/// The finding that the verdict turns on: the first that refutes the sentence, or, where none does, the first that decides.
fn decisive(outcome: &JudgedClaim) -> Option<&Finding> {
    let mut deciding = outcome.findings.iter().filter(|finding| !finding.bearing.context);
    deciding.clone().find(|finding| !finding.supports()).or_else(|| deciding.next())
}

/// A finding in short: its name and the measured value.
fn found(finding: &Finding) -> String {
    let number = match &finding.exact {
        Some([measured, _]) if measured.chars().count() > LONG => format!("≈ {}", significant(finding.measured)),
        Some([measured, _]) => measured.clone(),
        None => significant(finding.measured),
    };
    format!("{}: {}", finding.name, with_unit(&number, finding.unit))
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
fn complain(text: &mut String, outcome: &JudgedClaim, style: Style) {
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

/// A control: what it changes, the findings that come out otherwise, and what follows.
fn control(outcome: &JudgedClaim, place: usize, findings: &[Finding], style: Style) -> Vec<String> {
    let recorded = |finding: &Finding| counterpart(finding, findings, &outcome.findings);
    let moved = |finding: &&Finding| recorded(finding).is_some_and(|recorded| is_moved(recorded, &outcome.findings, findings));
    // what a passage says follows from the instance, another one here
    let reworded = |finding: &&Finding| {
        let passage = matches!(finding.bearing.voice, Voice::Passage(_));
        passage && recorded(finding).is_some_and(|recorded| recorded.stated() != finding.stated())
    };
    let shown: Vec<&Finding> = findings.iter().filter(|finding| moved(finding) || reworded(finding)).collect();
    let deciding = findings.iter().filter(|finding| !finding.bearing.context).count();
    let mut lines = vec![wrap(outcome.claim.controls[place])];
    lines.extend(shown.iter().map(|finding| bearing(&elsewhere(finding))));
    if shown.iter().filter(|finding| !finding.bearing.context).count() < deciding {
        lines.push("  the other findings come out as above".into());
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

/// A finding of a control: that a condition is not met is said of the recorded instance, not of this one.
fn elsewhere(finding: &Finding) -> Finding {
    let mut finding = finding.clone();
    finding.bearing.violated = None;
    finding
}

fn judged(finding: &Finding) -> String {
    format!("  [{}] {finding}", if finding.holds() { "holds" } else { "FAILS" })
}

/// A finding with what it says about the sentence; as [`judged`], if it is not what was expected.
fn told(finding: &Finding) -> String {
    if finding.holds() { bearing(finding) + &used(finding) } else { judged(finding) }
}

/// How much of its bound a finding uses, in two digits.
fn used(finding: &Finding) -> String {
    let share = finding.used().map(|used| format!("; {} of the bound", two_digits(used)));
    share.unwrap_or_default()
}

/// What was expected, with how far the found number may differ.
fn expected(finding: &Finding) -> String {
    let Expectation { value, tolerance, relation, .. } = finding.expectation;
    match (&finding.exact, relation) {
        (Some(_), _) => format!("expected {}", said(finding)),
        (None, Relation::Equal) => format!("expected {} ± {}", significant(value), two_digits(tolerance)),
        (None, _) => format!("expected {} {}", relation.sign(), significant(value)),
    }
}

/// What a finding says about the sentence: what is expected of it, and what the sentence says where that is something else.
fn bearing(finding: &Finding) -> String {
    let found = found(finding);
    if finding.bearing.context {
        return format!("  [beside]   {found}");
    }
    let direction = if finding.supports() { "supports" } else { "refutes " };
    let where_violated = finding.bearing.violated.map(|condition| format!("; not met here: {condition}")).unwrap_or_default();
    let said = match finding.bearing.voice {
        Voice::Sentence if finding.bearing.stated.is_none() => expected(finding),
        Voice::Sentence if finding.exact.is_none() && finding.holds() => {
            format!("the sentence says {}; {}", stated(finding), expected(finding))
        }
        Voice::Sentence => format!("the sentence says {}", stated(finding)),
        Voice::Passage(passage) => format!("{passage} says {}", stated(finding)),
        Voice::Reading(reading) => format!("in the reading “{reading}”: {}", stated(finding)),
        Voice::Opinion(point) => format!("an opinion: {point}"),
    };
    format!("  [{direction}] {found} ({said}{where_violated})")
}

fn line(text: &mut String, content: &str) {
    writeln!(text, "{}", content.trim_end()).expect("writing to a String cannot fail");
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
    fn what_the_sentence_says_has_as_many_digits_as_what_was_found() {
        assert_eq!(said(&Finding::at_most("x", 1.0, 249.300_678_563, "m")), "≤ 249.301");
        assert_eq!(said(&Finding::count("k", 3, 3)), "3");
        let third = moreau_exact::scalar::ratio(1, 3);
        assert_eq!(said(&Finding::exact("r", &third, &third, "1")), "1/3");
    }

    #[test]
    fn a_finding_shows_what_is_expected_and_the_sentence_is_quoted_only_where_it_says_something_else() {
        let line = |finding: &Finding| bearing(finding).trim().to_string();
        assert_eq!(line(&Finding::equal("x", 1.0, 1.5, 0.75, "m")), "[supports] x: 1 m (expected 1.5 ± 0.75)");
        assert_eq!(line(&Finding::at_most("x", 1.0, 1.5, "1").violating("c")), "[supports] x: 1 (expected ≤ 1.5; not met here: c)");
        assert_eq!(line(&Finding::at_most("x", 1.0, 1.5, "1").says(3.0)), "[refutes ] x: 1 (the sentence says 3; expected ≤ 1.5)");
        assert_eq!(line(&Finding::decision("x", false, false).says(true)), "[refutes ] x: false (the sentence says true)");
        assert_eq!(line(&Finding::count("x", 2, 2)), "[supports] x: 2 (expected 2)");
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
