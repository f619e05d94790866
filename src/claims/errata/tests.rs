//! The errata in Chinese against the claims: who has one, in which order, and that no number of theirs is another one.

use super::*;
use crate::checks::formula::{formulas, html};
use crate::claims::{Claim, ClaimVerdict, SECTIONS, all, find};
use regex::Regex;
use std::collections::BTreeSet;

const TEXT: &str = include_str!("../errata.zh.toml");

/// The ids in the order of the file.
fn ids() -> Vec<&'static str> {
    TEXT.lines().filter_map(|line| line.strip_prefix("[\"")?.strip_suffix("\"]")).collect()
}

fn has_erratum(claim: &Claim) -> bool {
    matches!(claim.verdict, ClaimVerdict::False | ClaimVerdict::Inconsistent | ClaimVerdict::Conditional)
}

fn texts(erratum: &Erratum) -> [(&'static str, &str); 3] {
    [("says", &erratum.says), ("wrong", &erratum.wrong), ("correct", &erratum.correct)]
}

/// Superscript and subscript digits as `^` and `_` with digits, vulgar fractions as a/b, `\frac{a}{b}` as a/b.
fn plain(text: &str) -> String {
    let low = "₀₁₂₃₄₅₆₇₈₉";
    let high = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let vulgar = [('½', " 1/2 "), ('⅓', " 1/3 "), ('⅔', " 2/3 "), ('¼', " 1/4 "), ('¾', " 3/4 ")];
    let digit = |digits: &str, letter| digits.chars().position(|candidate| candidate == letter);
    let mut plain = String::new();
    for letter in text.chars() {
        match (digit(low, letter), digit(high, letter), vulgar.iter().find(|(candidate, _)| *candidate == letter)) {
            (Some(value), _, _) | (_, Some(value), _) => {
                let mark = if digit(low, letter).is_some() { '_' } else { '^' };
                if !plain.trim_end_matches(|last: char| last.is_ascii_digit()).ends_with(mark) {
                    plain.push(mark);
                }
                plain.push_str(&value.to_string());
            }
            (_, _, Some((_, fraction))) => plain.push_str(fraction),
            _ => plain.push(letter),
        }
    }
    Regex::new(r"\\frac\{(\d+)\}\{(\d+)\}").expect("a pattern").replace_all(&plain, " $1/$2 ").into_owned()
}

fn shortened(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// The numbers of a text, each with the zeros at its end cut off: fractions whole, exponents and indices alone, the base of a power of ten
/// not at all.
fn numbers(text: &str) -> BTreeSet<String> {
    let pattern = Regex::new(r"(?:\b10)?[\^_]\{?[-−]?(\d+)|(\d+(?:\.\d+)?)(/\d+(?:\.\d+)?)?").expect("a pattern");
    let mut numbers = BTreeSet::new();
    for found in pattern.captures_iter(&plain(text)) {
        let below = found.get(3).map_or("", |below| below.as_str());
        numbers.extend(found.get(1).map(|power| power.as_str().to_owned()));
        numbers.extend(found.get(2).map(|number| shortened(number.as_str()).to_owned() + below));
    }
    numbers
}

/// The numbers of the English texts of a claim, fractions also in parts, months by their number.
fn english(claim: &Claim) -> BTreeSet<String> {
    let text = [claim.statement(), claim.correct_statement(), claim.argument()].join(" ");
    let months = [("February", "2"), ("March", "3"), ("August", "8"), ("November", "11")];
    let mut whole = numbers(&text);
    whole.extend(months.iter().filter(|(month, _)| text.contains(month)).map(|(_, number)| (*number).to_owned()));
    let parts = whole.iter().flat_map(|number| number.split('/')).map(str::to_owned).collect::<BTreeSet<_>>();
    whole.union(&parts).cloned().collect()
}

/// The numbers of a Chinese text that the English ones of its claim do not have.
fn strange(claim: &Claim, text: &str) -> Vec<String> {
    numbers(text).difference(&english(claim)).cloned().collect()
}

#[test]
fn exactly_the_claims_that_do_not_hold_as_printed_have_an_erratum() {
    let wanted: BTreeSet<&str> = all().filter(|claim| has_erratum(claim)).map(|claim| claim.id).collect();
    let present: BTreeSet<&str> = ERRATA.entries.keys().map(String::as_str).collect();
    let missing: Vec<_> = wanted.difference(&present).collect();
    let superfluous: Vec<_> = present.difference(&wanted).collect();
    assert!(missing.is_empty() && superfluous.is_empty(), "missing {missing:?}, superfluous {superfluous:?}");
    assert!(chinese("S4.copos-plus").is_some() && chinese("S4.copos").is_none());
}

#[test]
fn errata_stand_in_the_order_of_the_chapter() {
    let lines: Vec<_> = ids().into_iter().map(|id| (PLACES.of(id).first().map_or(usize::MAX, |place| place.line), id)).collect();
    assert_eq!(lines.len(), ERRATA.entries.len());
    let turned: Vec<_> = lines.windows(2).filter(|pair| pair[0].0 > pair[1].0).collect();
    assert!(turned.is_empty(), "{turned:?}");
}

/// What keeps a text from being printed: a sentence without its end, a formula that no page can show or that holds Chinese.
fn unprintable(text: &str) -> Option<String> {
    let foreign = |formula: &String| !formula.is_ascii();
    match (html(text), formulas(text)) {
        (Err(error), _) | (_, Err(error)) => Some(error.to_string()),
        (Ok(_), Ok(formulas)) if formulas.iter().any(foreign) => Some(format!("not TeX: {formulas:?}")),
        _ => (!text.trim_end_matches('）').ends_with(['。', '？'])).then(|| "a sentence without its end".into()),
    }
}

#[test]
fn every_text_is_a_sentence_with_formulas_that_a_page_can_show() {
    let all = ERRATA.entries.iter().flat_map(|(id, erratum)| texts(erratum).map(|(field, text)| (id, field, unprintable(text))));
    let wrong: Vec<_> = all.filter(|(.., problem)| problem.is_some()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    for planted in ["", "$x", "$x$", r"$\frac{1}{$。", "$在$。", r"\mu。"] {
        assert!(unprintable(planted).is_some(), "{planted}");
    }
}

#[test]
fn every_number_of_an_erratum_stands_in_the_english_texts_of_its_claim() {
    let mut wrong = Vec::new();
    for (id, erratum) in &ERRATA.entries {
        let claim = find(id).expect("another test names ids that are none");
        wrong.extend(
            texts(erratum)[1..]
                .iter()
                .flat_map(|(field, text)| strange(claim, text).into_iter().map(move |number| format!("{id}, {field}: {number}"))),
        );
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_mistyped_number_is_seen_however_it_is_written() {
    let claim = find("S3.energy-one").expect("a claim");
    let (given, mistyped) = ("$h=1/1000$, 0.04811805 J, $\\frac{1}{6}$", "$h=1/100$, 0.04811850 J, $\\frac{1}{7}$");
    assert_eq!((strange(claim, given), strange(claim, mistyped)), (vec![], vec!["0.0481185".into(), "1/100".into(), "1/7".into()]));
    let powers = find("S6.less-rigid-than-sap").expect("a claim");
    assert_eq!((strange(powers, r"$3.67\times 10^{-4}$"), strange(powers, r"$3.67\times 10^{-7}$")), (vec![], vec!["7".into()]));
}

#[test]
fn every_section_has_a_chinese_title_of_the_chapters_own_words() {
    for section in SECTIONS {
        let title = chinese_section(section.group).unwrap_or_else(|| panic!("{} has no Chinese title", section.group));
        for part in title.split('与').filter(|_| !title.starts_with('§')) {
            assert!(PLACES.headings.iter().any(|heading| heading.title.contains(part)), "{}: {part}", section.group);
        }
    }
    assert_eq!(chinese_section("S7"), Some("§7 冲击律的离散处理"));
    assert!(chinese_section("X").is_none());
    let used = ERRATA.sections.keys().all(|group| SECTIONS.iter().any(|section| section.group == group) && !group.starts_with('S'));
    assert!(used, "{:?}", ERRATA.sections);
}
