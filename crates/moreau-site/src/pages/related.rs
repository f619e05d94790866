//! Claims that name one another in their texts.

use super::data::ClaimEntry;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};

const SEE: Words = Words { en: "See also: ", zh: "另见：" };

/// Links to the claims whose ids stand in the texts of this one, and to those that name it.
pub fn see_also(view: &View, claim: &ClaimEntry) -> Markup {
    let others: Vec<&str> = related(&view.report.claims, claim);
    html! { @if !others.is_empty() { p { (view.say(SEE)) (view.claim_links(others.into_iter())) } } }
}

/// Those named by a claim and those that name it, in the order of the chapter.
fn related<'a>(claims: &'a [ClaimEntry], claim: &ClaimEntry) -> Vec<&'a str> {
    let others = claims.iter().filter(|other| other.id != claim.id && (names(claim, &other.id) || names(other, &claim.id)));
    others.map(|other| other.id.as_str()).collect()
}

/// Whether a claim's argument or correction names this id.
fn names(claim: &ClaimEntry, id: &str) -> bool {
    let chinese = claim.erratum.iter().flat_map(|erratum| [&erratum.wrong, &erratum.reads]);
    [&claim.argument, &claim.correct].into_iter().chain(chinese).any(|text| stands_in(id, text))
}

/// Whether an id stands in a text as a word of its own, outside of formulas: `S4.a` stands neither in `S4.a-b` nor in `$S4.a$`.
fn stands_in(id: &str, text: &str) -> bool {
    let part_of_id = |letter: char| letter.is_ascii_alphanumeric() || letter == '-' || letter == '^' || letter == '_';
    text.split('$').step_by(2).any(|prose| {
        prose.match_indices(id).any(|(at, _)| {
            let (before, after) = (&prose[..at], &prose[at + id.len()..]);
            let goes_on = after.strip_prefix('.').unwrap_or(after).starts_with(part_of_id);
            !before.ends_with(|letter| part_of_id(letter) || letter == '.') && !goes_on
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_named_as_a_word_of_its_own() {
        for text in ["(see S4.copos-plus)", "S4.copos-plus.", "falls with S4.copos-plus: it", "见S4.copos-plus。"] {
            assert!(stands_in("S4.copos-plus", text), "{text}");
            assert!(!stands_in("S4.copos", text), "{text}");
        }
        assert!(stands_in("R6", "as in R6, or") && stands_in("M3", "M3"));
        for text in ["$R6$", "R60", "xR6", "in R6.name", "R6-x"] {
            assert!(!stands_in("R6", text), "{text}");
        }
    }
}
