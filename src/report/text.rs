//! What `verify` prints: the claims by section, what is wrong, and a count at the end.

use super::findings::{found, judged};
use crate::checks::Finding;
pub use crate::checks::text::{Style, counted};
use crate::claims::{CHAPTER, Claim, ClaimVerdict, Figures, JudgedClaim, Kind, PLACES, SECTIONS, Section, Status, order, title};
use std::fmt::Write;

/// The report of a run: the chapter, the claims by section with their decisive numbers, what is wrong, and the count as the last line.
pub fn outcomes(outcomes: &[JudgedClaim], style: Style) -> String {
    let width = id_width(outcomes.iter().map(|outcome| outcome.claim));
    let mut text = chapter(style);
    let mut group = "";
    for outcome in outcomes {
        open_section(&mut text, &mut group, outcome.claim, style);
        let alarm = alarm_word(&outcome.status).map(|word| format!("  {}", style.alarm(word))).unwrap_or_default();
        line(&mut text, &head(outcome.claim, width, &alarm, style));
        let number = decisive(outcome).map(found).unwrap_or_default();
        line(&mut text, &style.wrapped(BELOW, FURTHER_BELOW, &number));
    }
    line(&mut text, "");
    for outcome in outcomes {
        complain(&mut text, outcome, style);
    }
    line(&mut text, &style.wrapped("", "", EXPLAINED));
    line(&mut text, &style.wrapped("", "", &hardness(outcomes)));
    line(&mut text, &style.wrapped("", "", &count(outcomes)));
    text
}

/// The chapter, and its claims by section with their statements, without running anything.
pub fn list(claims: &[&'static Claim], style: Style) -> String {
    let width = id_width(claims.iter().copied());
    let mut text = chapter(style);
    let mut group = "";
    for claim in claims {
        open_section(&mut text, &mut group, claim, style);
        line(&mut text, &head(claim, width, "", style));
        line(&mut text, &style.wrapped(BELOW, BELOW, &claim.statement()));
    }
    line(&mut text, "");
    line(&mut text, &style.wrapped("", "", &format!("{}. {EXPLAINED}", counted(claims.len(), "claim"))));
    text
}

/// What stands under a claim's line, and the second line of that.
const BELOW: &str = "      ";
const FURTHER_BELOW: &str = "        ";

/// What a list of claims does not show.
const EXPLAINED: &str =
    "`moreau verify --explain ID` explains one: proof or counterexample, numbers, correct statement, controls, sources.";

/// Which text the claims are of.
fn chapter(style: Style) -> String {
    let original = PLACES.headings.first().map_or("", |heading| heading.title.as_str());
    style.wrapped("", "", &format!("Claims of {CHAPTER} ({original})")) + "\n\n"
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

/// Id, verdict, evidence and alarm of a claim, and its title: beside them if there is room, under them otherwise.
fn head(claim: &Claim, width: usize, alarm: &str, style: Style) -> String {
    let (title, evidence) = (title(claim.id), claim.evidence.word());
    let verdict = coloured(claim.verdict, &format!("{:15}", claim.verdict.words()), style);
    let head = format!("  {:width$}  {verdict}  {evidence:13}", claim.id);
    let beside = 2 + width + 2 + 15 + 2 + 13 + 2 + title.chars().count() + alarm.chars().count() <= style.width;
    if beside || title.is_empty() {
        return format!("{head}  {title}{alarm}");
    }
    format!("{}{alarm}\n{}", head.trim_end(), style.wrapped(BELOW, BELOW, title))
}

/// A verdict in its colour.
pub(super) fn coloured(verdict: ClaimVerdict, words: &str, style: Style) -> String {
    match verdict {
        ClaimVerdict::True => style.yes(words),
        ClaimVerdict::False => style.no(words),
        ClaimVerdict::Conditional | ClaimVerdict::Inconsistent | ClaimVerdict::Ambiguous => style.reserved(words),
    }
}

fn id_width<'a>(claims: impl Iterator<Item = &'a Claim>) -> usize {
    claims.map(|claim| claim.id.chars().count()).max().unwrap_or(0)
}

/// The finding that the verdict turns on: the first that refutes the sentence, or, where none does, the first that decides.
pub(super) fn decisive(outcome: &JudgedClaim) -> Option<&Finding> {
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
    let Some((word, reason)) = complaint(outcome) else { return };
    line(text, &style.wrapped("", "  ", &format!("{} {}: {reason}", style.alarm(word), outcome.claim.id)));
    let failing = outcome.findings.iter().filter(|finding| !finding.holds());
    failing.for_each(|finding| line(text, &style.wrapped("", "          ", &judged(finding))));
}

/// What keeps an outcome from being supported: a word and the reason; none for one that is supported.
pub(super) fn complaint(outcome: &JudgedClaim) -> Option<(&'static str, String)> {
    let reason = match &outcome.status {
        Status::Failed(reason) => format!("the check could not be carried out: {reason}"),
        Status::ControlPassed => "the control passed too, so the check cannot tell the verdict from its opposite".into(),
        Status::OtherVerdict(found) => format!("the findings say: {found}; recorded is: {}", outcome.claim.verdict.words()),
        Status::Contradicted | Status::Supported => "the evidence speaks against the recorded verdict".into(),
    };
    Some((alarm_word(&outcome.status)?, reason))
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

    const PLAIN: Style = Style::PLAIN;

    #[test]
    fn a_supported_claim_stands_under_its_section_with_its_number_and_the_count_is_last() {
        let text = outcomes(&[outcome(Status::Supported)], PLAIN);
        let lines: Vec<_> = text.lines().skip_while(|line| !line.starts_with('§')).collect();
        assert_eq!(lines[..3], ["§4 Stewart–Trinkle time-stepping", "  S4.example  false as stated  exact", "      length: 1 m"]);
        assert!(text.starts_with("Claims of ") && text.contains("时步法") && text.contains("verify --explain ID"), "{text}");
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
        let coloured = outcomes(&[outcome(Status::Contradicted)], Style { colour: true, ..PLAIN });
        assert!(coloured.contains("\u{1b}[1;31mCONTRADICTED") && coloured.contains("\u{1b}[31mfalse as stated\u{1b}[0m"), "{coloured}");
    }

    #[test]
    fn no_line_is_wider_than_the_terminal() {
        let all: Vec<&'static Claim> = crate::claims::all().collect();
        for width in [80, 100, 120] {
            let text = list(&all, Style { width, ..PLAIN });
            // a mark over a letter takes no column
            let columns = |line: &str| line.chars().filter(|letter| !('\u{300}'..='\u{36f}').contains(letter)).count();
            // and a path is not broken
            let wide = text.lines().find(|line| columns(line) > width && line.trim().contains(' '));
            assert_eq!(wide, None, "{width}");
            let squeezed = text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(all.iter().all(|claim| squeezed.contains(&claim.statement())), "every statement is shown");
            assert!(!text.contains(['$', '\\']), "formulas are in Unicode");
        }
    }
}
