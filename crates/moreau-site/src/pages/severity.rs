//! What has to be corrected by how much is wrong, most severe first: counts, and every entry with a link.

use super::axes::{Axis, Severity};
use super::data::ClaimEntry;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};

const BY_SEVERITY: Words = Words { en: "By severity", zh: "按严重程度" };
const HOW_MANY: Words = Words { en: "How many of each severity", zh: "各严重程度的数量" };

/// Those that claims have, most severe first, with the claims.
fn groups<'a>(claims: &[&'a ClaimEntry]) -> Vec<(Severity, Vec<&'a ClaimEntry>)> {
    let of = |severity| claims.iter().copied().filter(|claim| claim.severity == Some(severity)).collect();
    let groups = Severity::ALL.iter().rev().map(|&severity| (severity, of(severity)));
    groups.filter(|(_, claims): &(_, Vec<_>)| !claims.is_empty()).collect()
}

fn anchor(severity: Severity) -> String {
    format!("severity-{}", severity.key())
}

/// How many claims have which severity, each a link to their list.
pub fn counts(view: &View, claims: &[&ClaimEntry]) -> Markup {
    html! {
        ul.counts aria-label=(view.say(HOW_MANY)) {
            @for (severity, claims) in groups(claims) {
                li { a.id href={ "#" (anchor(severity)) } { b { (claims.len()) } " " (view.say(severity.words())) } }
            }
        }
    }
}

/// The lists, each claim a link to its entry on this page.
pub fn lists(view: &View, claims: &[&ClaimEntry]) -> Markup {
    html! {
        h2 { (view.say(BY_SEVERITY)) }
        @for (severity, claims) in groups(claims) {
            h3 id=(anchor(severity)) { (view.say(severity.words())) (view.aside(&claims.len())) }
            ul.list { @for claim in claims { li { a href={ "#" (claim.id) } { b { (claim.id) } " " (view.title(claim)) } } } }
        }
    }
}
