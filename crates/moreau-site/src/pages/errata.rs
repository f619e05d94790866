//! The errata sheet for the author of the chapter: place, printed words, what is wrong, how it should read, how much is wrong.

use super::axes::Verdict;
use super::claim::{PLACE, places, standing};
use super::data::ClaimEntry;
use super::frame::document;
use super::section::title;
use super::severity;
use super::view::View;
use crate::words::{Language, Words};
use maud::{Markup, html};

const TITLE: Words = Words { en: "Errata", zh: "勘误表" };
const LEAD: Words = Words {
    en: "For the author of the chapter: {0} sentences that are false as printed, exclude one another, or need a condition that is not \
         printed, in the order of the text. What is said more than once stands once, with the other places. {1} have been counted with \
         the sentence that they repeat.",
    zh: "供本章作者使用：共 {0} 处，包括如所述不成立、自相矛盾或缺少必要条件的句子，按正文顺序排列。多次出现的说法只列一次，并注明其他位置；另有 {1} 处为重复，已并入原句。",
};
const PRINTED: Words = Words { en: "Printed", zh: "本章的说法" };
const IN_ENGLISH: Words = Words { en: "Printed, in English", zh: "本章的说法（英文陈述）" };
const WRONG: Words = Words { en: "What is wrong", zh: "问题所在" };
const READS: Words = Words { en: "How it should read", zh: "应当表述为" };
const AGAIN: Words = Words { en: "The same is said in", zh: "同样的说法又见于" };
const PROVED: Words = Words { en: "Numbers and proof: ", zh: "数据与证明：" };

/// The page.
pub fn page(view: &View) -> String {
    let wrong: Vec<&ClaimEntry> = view.report.claims.iter().filter(|claim| claim.verdict.needs_correction()).collect();
    let (again, own): (Vec<&ClaimEntry>, Vec<&ClaimEntry>) = wrong.into_iter().partition(|claim| claim.repeats.is_some());
    let body = html! {
        h1 { (view.say(TITLE)) }
        p.meta { (view.chinese(&view.report.chapter)) }
        p { (view.tell(LEAD, &[&own.len(), &again.len()])) }
        (severity::counts(view, &own))
        (severity::lists(view, &own))
        @for section in &view.report.sections {
            @let here: Vec<_> = in_the_order_of_the_text(&own, &section.group);
            @if !here.is_empty() {
                h2 { (title(view, section)) }
                @for claim in here { (erratum(view, claim)) }
            }
        }
    };
    document(view, view.say(TITLE), &body)
}

/// The claims of a section, by the line in which they are printed.
fn in_the_order_of_the_text<'a>(claims: &[&'a ClaimEntry], group: &str) -> Vec<&'a ClaimEntry> {
    let mut here: Vec<_> = claims.iter().copied().filter(|claim| claim.group == group).collect();
    here.sort_by_key(|claim| claim.places.first().map(|place| place.line));
    here
}

fn erratum(view: &View, claim: &ClaimEntry) -> Markup {
    let again: Vec<&ClaimEntry> = view.report.repetitions(&claim.id).collect();
    html! {
        article.erratum id=(claim.id) {
            h3 { a.anchor href={ "#" (claim.id) } { (claim.id) } " " (view.english(&claim.title)) }
            (standing(view, claim))
            h4 { (view.say(PLACE)) }
            (places(view, claim))
            (printed(view, claim))
            (corrected(view, claim))
            @if !again.is_empty() {
                p { (view.say(AGAIN)) (view.colon()) (view.claim_links(again.iter().map(|claim| claim.id.as_str()))) }
            }
            p { (view.say(PROVED)) (view.claim_link(&claim.id)) }
        }
    }
}

/// What is printed: in Chinese where that is written, and on an English page in English.
fn printed(view: &View, claim: &ClaimEntry) -> Markup {
    let english = claim.erratum.is_none() || view.language == Language::English;
    html! {
        h4 { (view.say(if english { IN_ENGLISH } else { PRINTED })) }
        @if let Some(erratum) = &claim.erratum { blockquote { (view.chinese(&erratum.says)) } }
        @if english { blockquote { (view.english(&claim.statement)) } }
    }
}

/// What is wrong and how it should read; on a Chinese page in Chinese where that is written.
fn corrected(view: &View, claim: &ClaimEntry) -> Markup {
    let (wrong, reads) = match (&claim.erratum, view.language) {
        (Some(erratum), Language::Chinese) => (view.chinese(&erratum.wrong), view.chinese(&erratum.reads)),
        _ => (view.english(&claim.argument), view.english(&claim.correct)),
    };
    html! {
        h4 { (view.say(WRONG)) }
        p { (wrong) }
        h4 { (view.say(READS)) }
        p.correct { (reads) }
    }
}

/// Claims that are false or inconsistent, and repeat no other one.
pub fn grave<'a>(view: &View<'a>) -> impl Iterator<Item = &'a ClaimEntry> {
    view.report.claims.iter().filter(|claim| is_grave(claim) && claim.repeats.is_none())
}

/// Whether a claim is false or inconsistent.
pub fn is_grave(claim: &ClaimEntry) -> bool {
    matches!(claim.verdict, Verdict::False | Verdict::Inconsistent)
}
