//! Every claim in one list, with a search and filters. Without a program in the browser the whole list is there.

use super::axes::{Axis, Evidence, Kind, Severity, Verdict};
use super::claim::verdict;
use super::correction::{AS_STATED, beyond, label};
use super::data::ClaimEntry;
use super::frame::document;
use super::section::title;
use super::view::{View, section_file};
use crate::words::{Language, Words};
use maud::{Markup, html};
use moreau_checks::formula;

const TITLE: Words = Words { en: "Every claim", zh: "全部论断" };
const LEAD: Words = Words {
    en: "{0} claims of the chapter. Search in ids, titles, statements and corrections; every word must occur. \
         The address keeps what is chosen.",
    zh: "本章的 {0} 条论断。可在编号、标题、陈述与更正（英文）以及勘误的中文文字、本章标题和引文中搜索，须包含全部词语；网址会保存所选条件。",
};
const WITHOUT: Words = Words {
    en: "Search and filters need JavaScript; the whole list stands below.",
    zh: "搜索与筛选需要 JavaScript；下面是完整列表。",
};
const SEARCH: Words = Words { en: "Search", zh: "搜索" };
const SECTION: Words = Words { en: "Section", zh: "章节" };
const VERDICT: Words = Words { en: "Verdict", zh: "结论" };
const SEVERITY: Words = Words { en: "Severity", zh: "严重程度" };
const KIND: Words = Words { en: "Kind", zh: "类型" };
const EVIDENCE: Words = Words { en: "Evidence", zh: "证据" };
const ALL: Words = Words { en: "all", zh: "全部" };
const CLEAR: Words = Words { en: "Clear", zh: "清除" };
const SHOWN: Words = Words { en: "Claims shown: ", zh: "显示的论断数：" };
const FILTERS: Words = Words { en: "Search and filters", zh: "搜索与筛选" };
const NOT_SUPPORTED: Words = Words { en: "not supported by what was found", zh: "与所得结果不符" };

/// The page.
pub fn page(view: &View) -> String {
    let claims = &view.report.claims;
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.tell(LEAD, &[&claims.len()])) }
        noscript { p.note { (view.say(WITHOUT)) } }
        (filters(view))
        p.meta role="status" aria-live="polite" { (view.say(SHOWN)) b #shown { (claims.len()) } }
        ul #claims.claims { @for claim in claims { (line(view, claim)) } }
        script src=(view.shared("claims.js")) {}
    };
    document(view, view.say(TITLE), &body)
}

fn filters(view: &View) -> Markup {
    let sections = view.report.sections.iter().map(|section| (section.group.as_str(), title(view, section)));
    html! {
        form #filters role="search" aria-label=(view.say(FILTERS)) {
            label.wide { (view.say(SEARCH)) input type="search" name="q" autocomplete="off"; }
            (select(view, SECTION, "section", sections.map(|(key, words)| (key, words, count(view, |claim| claim.group == key)))))
            (axis::<Verdict>(view, VERDICT, "verdict", |claim, value| claim.verdict == value))
            (axis::<Severity>(view, SEVERITY, "severity", |claim, value| claim.severity == Some(value)))
            (axis::<Kind>(view, KIND, "kind", |claim, value| claim.kind == value))
            (axis::<Evidence>(view, EVIDENCE, "evidence", |claim, value| claim.evidence == value))
            button type="reset" { (view.say(CLEAR)) }
        }
    }
}

fn count(view: &View, is: impl Fn(&ClaimEntry) -> bool) -> usize {
    view.report.count(is)
}

fn axis<A: Axis>(view: &View, label: Words, name: &str, has: fn(&ClaimEntry, A) -> bool) -> Markup {
    let options = A::ALL.iter().map(|&value| (value.key(), view.say(value.words()), count(view, |claim| has(claim, value))));
    select(view, label, name, options)
}

fn select<'a>(view: &View, label: Words, name: &str, options: impl Iterator<Item = (&'a str, &'a str, usize)>) -> Markup {
    html! {
        label {
            (view.say(label))
            select name=(name) {
                option value="" { (view.say(ALL)) }
                @for (key, words, count) in options { option value=(key) { (words) (view.aside(&count)) } }
            }
        }
    }
}

/// A claim in the list; its attributes are what the filters look at.
fn line(view: &View, claim: &ClaimEntry) -> Markup {
    html! {
        li data-section=(claim.group) data-verdict=(claim.verdict.key()) data-severity=(claim.severity.map_or("", Axis::key))
            data-kind=(claim.kind.key()) data-evidence=(claim.evidence.key()) {
            a href={ (section_file(&claim.group)) "#" (claim.id) } { b { (claim.id) } " " (view.english(&claim.title)) }
            p.standing {
                (verdict(view, claim.verdict))
                @if let Some(severity) = claim.severity { " " span.tag { (view.say(severity.words())) } }
                @if claim.alarm.is_some() { " " b.alarm { (view.say(NOT_SUPPORTED)) } }
            }
            @if let (Some(erratum), Language::Chinese) = (&claim.erratum, view.language) { p data-text { (unicode(&erratum.says)) } }
            p data-text { (view.letters(&claim.plain[0])) }
            (reads(view, claim))
            @if view.language == Language::Chinese { span data-text hidden { (more_in_chinese(claim)) } }
        }
    }
}

/// The correction under its label; “as stated” is found there, too.
fn reads(view: &View, claim: &ClaimEntry) -> Markup {
    let (label, text) = (label(claim), &claim.plain[1]);
    let rest = beyond(text);
    html! {
        @if label != AS_STATED {
            p.reads { (view.say(label)) (view.colon()) span data-text { (view.letters(text)) } }
        } @else {
            p.reads data-text { (view.say(label)) @if !rest.is_empty() { (view.colon()) (view.letters(rest)) } }
        }
    }
}

/// What the search of a Chinese page finds a claim by beside what is shown: the rest of its erratum, its headings and the chapter's own
/// words.
fn more_in_chinese(claim: &ClaimEntry) -> String {
    let erratum = claim.erratum.iter().flat_map(|erratum| [unicode(&erratum.wrong), unicode(&erratum.reads)]);
    let mut parts: Vec<String> = Vec::new();
    for part in erratum.chain(claim.places.iter().flat_map(|place| [place.heading.clone(), place.words.clone()])) {
        if !parts.contains(&part) {
            parts.push(part);
        }
    }
    parts.join(" ")
}

/// A text with its formulas in Unicode, as the list has them.
fn unicode(text: &str) -> String {
    formula::unicode(text).unwrap_or_else(|_| text.into())
}
