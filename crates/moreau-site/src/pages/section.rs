//! One section of the chapter with every claim that it makes.

use super::axes::{Axis, Verdict};
use super::claim::{article, verdict};
use super::data::Section;
use super::frame::document;
use super::view::{View, section_file};
use crate::words::{Language, Words};
use maud::{Markup, html};

const CLAIMS: Words = Words { en: "{0} claims", zh: "{0} 条论断" };
const HEADING: Words = Words { en: "The chapter's heading: ", zh: "英文标题：" };
const BEFORE: Words = Words { en: "previous section", zh: "上一节" };
const NEXT: Words = Words { en: "next section", zh: "下一节" };
const OTHER_SECTIONS: Words = Words { en: "Other sections", zh: "其他各节" };
const IN_SHORT: Words = Words { en: "The list, with search and filters", zh: "列表，可搜索与筛选" };

/// The page of a section.
pub fn page(view: &View, section: &Section) -> String {
    let claims: Vec<_> = view.report.of(&section.group).collect();
    let body = html! {
        h1 { (title(view, section)) }
        @match view.language {
            Language::English => p.meta { (view.say(HEADING)) (view.chinese(section.title.zh)) },
            Language::Chinese => p.meta { (view.say(HEADING)) span lang="en" { (section.title.en) } },
        }
        nav.neighbours aria-label=(view.say(OTHER_SECTIONS)) { (neighbours(view, section)) }
        p { (view.tell(CLAIMS, &[&claims.len()])) (view.colon()) (counts(view, section)) }
        p { a href={ "claims.html#section=" (section.group) } { (view.say(IN_SHORT)) } }
        @for claim in &claims { (article(view, claim)) }
        div.neighbours { (neighbours(view, section)) }
    };
    document(view, title(view, section), &body)
}

/// The title of a section in the page's language.
pub fn title<'a>(view: &View, section: &'a Section) -> &'a str {
    section.title.of(view.language)
}

/// How many claims of a section have which verdict.
fn counts(view: &View, section: &Section) -> Markup {
    let count = |verdict: Verdict| view.report.of(&section.group).filter(|claim| claim.verdict == verdict).count();
    html! {
        @for &each in Verdict::ALL { @if count(each) > 0 { span.count { (verdict(view, each)) " " b { (count(each)) } } " " } }
    }
}

/// The sections before and after.
fn neighbours(view: &View, section: &Section) -> Markup {
    let sections = &view.report.sections;
    let at = sections.iter().position(|one| one.group == section.group).unwrap_or(0);
    let before = at.checked_sub(1).and_then(|at| sections.get(at));
    let link = |word: Words, to: Option<&Section>| {
        html! {
            @if let Some(to) = to { a href=(section_file(&to.group)) { (view.say(word)) (view.colon()) (title(view, to)) } }
        }
    };
    html! { (link(BEFORE, before)) (link(NEXT, sections.get(at + 1))) }
}
