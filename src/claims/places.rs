//! Where the chapter says what a claim states, so that a reader of the Chinese text finds the sentence.
//!
//! `references/chapter/places.json`, which `scripts/chapter_places.py` completes from the chapter's text, quotes a clause of each that
//! cuts no formula and no bracket.

use moreau_checks::formula;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// One sentence of the chapter.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// `§0` to `§12`; empty before the first and after the last.
    pub section: String,
    /// The nearest heading above.
    pub heading: String,
    /// Which paragraph below that heading, from 1; 0 is the heading itself.
    pub paragraph: usize,
    /// Line of the chapter as plain text, one paragraph a line, from 1.
    pub line: usize,
    /// How much of the chapter stands before that line \[%\].
    pub percent: usize,
    /// A clause of the sentence, its formulas as TeX between `\\(` and `\\)`.
    pub words: String,
}

/// A heading of the chapter.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heading {
    /// Its line.
    pub line: usize,
    /// `§0` to `§12`; empty before the first and after the last.
    pub section: String,
    /// Its words.
    pub title: String,
    /// How many paragraphs follow until the next one.
    pub paragraphs: usize,
}

/// The text that the places lie in.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chapter {
    /// Lines.
    pub lines: usize,
    /// Characters.
    pub characters: usize,
    /// SHA-256 of the text in UTF-8.
    pub sha256: String,
}

/// Every place, with the outline of the chapter.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Places {
    /// The text.
    pub chapter: Chapter,
    /// Its headings, in order.
    pub headings: Vec<Heading>,
    /// Of each claim the sentences that make it, the main one first.
    pub places: BTreeMap<String, Vec<Place>>,
    /// Claims that the chapter does not make, and why they stand here.
    pub absent: BTreeMap<String, String>,
}

/// All places.
pub static PLACES: LazyLock<Places> =
    LazyLock::new(|| serde_json::from_str(include_str!("../../references/chapter/places.json")).expect("a test reads the embedded file"));

impl Places {
    /// The sentences that make a claim, the main one first; none for what the chapter does not say.
    pub fn of(&self, id: &str) -> &[Place] {
        self.places.get(id).map_or(&[], Vec::as_slice)
    }
}

impl Place {
    /// The words as a text of this crate has them: formulas between dollar signs, and no stars of bold words.
    fn text(&self) -> String {
        self.words.replace("**", "").replace("\\(", "$").replace("\\)", "$")
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let section = if self.section.is_empty() || self.heading.starts_with('§') { String::new() } else { format!("{}, ", self.section) };
        write!(
            f,
            "{section}“{}”, paragraph {} (line {}, {} % of the text): “{}”",
            self.heading,
            self.paragraph,
            self.line,
            self.percent,
            formula::unicode(&self.text()).unwrap_or_else(|_| self.words.clone())
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::all;

    #[test]
    fn every_claim_has_a_place_or_a_reason_why_not_and_no_other_id_has_one() {
        for claim in all() {
            assert_ne!(PLACES.places.contains_key(claim.id), PLACES.absent.contains_key(claim.id), "{}", claim.id);
        }
        let ids: Vec<&str> = all().map(|claim| claim.id).collect();
        assert!(PLACES.places.keys().chain(PLACES.absent.keys()).all(|id| ids.contains(&id.as_str())));
    }

    #[test]
    fn places_lie_below_their_heading() {
        for place in PLACES.places.values().flatten() {
            let above = PLACES.headings.iter().rev().find(|heading| heading.line <= place.line).expect("a heading above");
            assert_eq!((&above.title, &above.section), (&place.heading, &place.section), "{place}");
            assert!(place.paragraph <= above.paragraphs && place.line <= PLACES.chapter.lines && place.percent < 100, "{place}");
        }
    }

    /// What is wrong with a quotation: a formula or a bracket that is cut, or more than a short clause.
    fn fault(words: &str) -> Option<String> {
        let (mut closing, mut rest, mut seen) = (Vec::new(), words, 0);
        while let Some(letter) = rest.chars().next() {
            let mut length = letter.len_utf8();
            if let Some(formula) = rest.strip_prefix("\\(") {
                let Some(end) = formula.find("\\)") else { return Some("a formula does not end".into()) };
                let text = format!("${}$", &formula[..end]);
                match formula::unicode(&text) {
                    Ok(read) => seen += read.chars().count(),
                    Err(error) => return Some(format!("{text} is no formula: {error}")),
                }
                length = end + 4;
            } else if letter == '\\' {
                return Some("a command outside of a formula".into());
            } else if let Some(close) = "()（）[]{}「」《》“”".chars().collect::<Vec<_>>().chunks(2).find(|pair| pair[0] == letter)
            {
                closing.push(close[1]);
            } else if ")）]}」》”".contains(letter) && closing.pop() != Some(letter) {
                return Some(format!("`{letter}` closes nothing"));
            }
            seen += 1;
            rest = &rest[length..];
        }
        let is_paired = ["\"", "`", "**"].iter().all(|mark| words.matches(mark).count() % 2 == 0);
        match (closing.is_empty(), is_paired, (4..=80).contains(&seen)) {
            (true, true, true) => None,
            (true, true, false) => Some(format!("{seen} characters are no short clause")),
            _ => Some("a bracket, a quotation or a bold word does not end".into()),
        }
    }

    #[test]
    fn a_quotation_is_a_short_clause_that_cuts_no_formula_and_no_bracket() {
        for place in PLACES.places.values().flatten() {
            assert_eq!(fault(&place.words), None, "{place}");
        }
        for cut in [
            "设 \\(M(q)\\suc",
            "=\\ell) 的解",
            "each element(of",
            "the cone),sliding",
            "either \"or",
            "结果**系统性不同",
            "短句",
            &"长".repeat(81),
        ] {
            assert!(fault(cut).is_some(), "{cut}");
        }
    }

    #[test]
    fn a_claim_of_a_numbered_section_stands_there() {
        // the order of the schemes is printed in a table of §1, the theorem about SAP in the table of theorems
        let elsewhere = ["S0.orders", "S10.sap-theorem"];
        for claim in all().filter(|claim| claim.section().len() > 1 && claim.section().starts_with('S') && !elsewhere.contains(&claim.id)) {
            let Some(place) = PLACES.of(claim.id).first() else { continue };
            assert_eq!(place.section.trim_start_matches('§'), &claim.section()[1..], "{}", claim.id);
        }
    }

    #[test]
    fn a_place_reads_as_directions() {
        let place = PLACES.of("S3.drift")[0].to_string();
        assert!(place.starts_with("§3, “") && place.contains("line ") && place.contains("% of the text"), "{place}");
    }
}
