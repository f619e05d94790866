//! A finding as a line of text: what was found, what the sentence says of it, how much of the bound it uses.

use crate::checks::{Expectation, Finding, Relation, Voice};
use crate::number::{significant, to_two_digits_of, two_digits, with_unit};
use crate::tolerance::report::BELOW_ALL_THAT_IS_STATED;

/// Characters of a number above which it is rounded for reading; JSON has all of it.
const LONG: usize = 24;

/// A finding in short: its name and the measured value.
pub(super) fn found(finding: &Finding) -> String {
    format!("{}: {}", finding.name, measured(finding))
}

/// The measured value with its unit.
pub(super) fn measured(finding: &Finding) -> String {
    let number = match &finding.exact {
        Some([measured, _]) if measured.chars().count() > LONG => format!("≈ {}", significant(finding.measured)),
        Some([measured, _]) => measured.clone(),
        None => as_precise(finding.measured, finding),
    };
    with_unit(&number, finding.unit)
}

pub(super) fn judged(finding: &Finding) -> String {
    format!("  [{}] {finding}", if finding.holds() { "holds" } else { "FAILS" })
}

/// A finding with what it says about the sentence; as [`judged`], if it is not what was expected.
pub(super) fn told(finding: &Finding) -> String {
    if finding.holds() { bearing(finding) + &used(finding) } else { judged(finding) }
}

/// How much of its bound a finding uses, in two digits.
fn used(finding: &Finding) -> String {
    let share = finding.used().map(|used| format!("; {} of the bound", two_digits(used)));
    share.unwrap_or_default()
}

/// What was expected, with how far the found number may differ.
fn expected(finding: &Finding) -> String {
    format!("expected {}", awaited(finding))
}

/// The same without the word.
pub(super) fn awaited(finding: &Finding) -> String {
    let Expectation { value, tolerance, relation, .. } = finding.expectation;
    match (&finding.exact, relation) {
        (Some(_), _) => said(finding),
        (None, Relation::Equal) => format!("{} ± {}", as_precise(value, finding), two_digits(tolerance)),
        (None, _) => format!("{} {}", relation.sign(), as_precise(value, finding)),
    }
}

/// What a finding says about the sentence: what is expected of it, and what the sentence says where that is something else.
pub(super) fn bearing(finding: &Finding) -> String {
    let found = found(finding);
    if finding.bearing.context {
        return format!("  [beside]   {found} ({})", expected(finding));
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
        Voice::Opinion(point) => format!("an opinion: {point}; {}", expected(finding)),
    };
    format!("  [{direction}] {found} ({said}{where_violated})")
}

/// What the sentence says, rounded for reading, with how far the found number may differ from it.
pub(super) fn stated(finding: &Finding) -> String {
    if says_more_than_rounding(finding) {
        return "more than 0".into();
    }
    let Expectation { tolerance, .. } = finding.expectation;
    let allowance = if finding.exact.is_none() && tolerance > 0.0 { format!(" ± {}", two_digits(tolerance)) } else { String::new() };
    said(finding) + &allowance
}

/// The same without the allowance; a long fraction as a decimal.
fn said(finding: &Finding) -> String {
    let stated = finding.stated();
    if finding.exact.is_some() && stated.chars().count() <= LONG {
        return stated;
    }
    let (relation, value) = relation_and_value(finding);
    let sign = if relation == Relation::Equal { "" } else { relation.sign() };
    format!("{sign} {}", if finding.exact.is_some() { format!("≈ {}", significant(value)) } else { as_precise(value, finding) })
        .trim_start()
        .into()
}

/// How the sentence relates to the found number, by its own words or else by what is expected.
fn relation_and_value(finding: &Finding) -> (Relation, f64) {
    let Expectation { relation, value, .. } = finding.expectation;
    finding.bearing.stated.as_ref().map_or((relation, value), |stated| (stated.relation, stated.value.rounded()))
}

/// Whether the sentence says of what is expected to vanish that it does not: its bound is the rounding, and no number of its own.
fn says_more_than_rounding(finding: &Finding) -> bool {
    let (relation, value) = relation_and_value(finding);
    relation == Relation::AtLeast
        && finding.exact.is_none()
        && finding.expectation.value == 0.0
        && value > 0.0
        && value < BELOW_ALL_THAT_IS_STATED
}

/// A number with as many digits as the bound supports: two of the bound, and six at most.
fn as_precise(number: f64, finding: &Finding) -> String {
    to_two_digits_of(finding.expectation.tolerance, number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_sentence_says_has_as_many_digits_as_what_was_found() {
        assert_eq!(said(&Finding::at_most("x", 1.0, 249.300_678_563, "m")), "≤ 249.301");
        assert_eq!(said(&Finding::count("k", 3, 3)), "3");
        let third = moreau_exact::scalar::ratio(1, 3);
        assert_eq!(said(&Finding::exact("r", &third, &third, "1")), "1/3");
        let long = moreau_exact::scalar::ratio(1, 3_000_000_000_000) * moreau_exact::scalar::ratio(1, 1_000_000_000_000);
        assert_eq!(said(&Finding::exact("r", &long, &long, "1")), "≈ 3.33333e-25");
    }

    #[test]
    fn a_number_has_as_many_digits_as_its_bound_supports() {
        assert_eq!(found(&Finding::equal("x", 0.598_432, 0.5, 0.42, "1")), "x: 0.6");
        assert_eq!(found(&Finding::equal("x", 0.994_472, 1.0, 0.12, "1")), "x: 0.99");
        assert_eq!(found(&Finding::equal("x", 8.7e-19, 0.0, 2.8e-16, "m")), "x: 0 m");
        assert_eq!(found(&Finding::equal("x", 0.003_064_231_234, 0.0, 9.4e-14, "m")), "x: 0.00306423 m");
        assert_eq!(found(&Finding::at_most("x", 3.75e-13, 1e-12, "m")), "x: 3.75e-13 m");
        let nothing = Finding::equal("x", 0.0, 0.0, 1e-13, "m").says_at_least(4e-13);
        assert_eq!(stated(&nothing), "more than 0");
        assert_eq!(stated(&Finding::equal("x", 0.0, 0.0, 1e-13, "m").says_at_least(0.01)), "≥ 0.01 ± 1e-13");
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
}
