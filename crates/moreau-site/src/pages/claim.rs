//! One claim in full: statement, verdict, deciding finding, argument, correction, controls, place, sources.

use super::axes::{Axis, Verdict};
use super::correction::{beyond, label};
use super::data::{ClaimEntry, ControlEntry, Erratum, FindingEntry, PlaceEntry, Voice};
use super::prose::prose;
use super::related::see_also;
use super::view::View;
use crate::words::{Language, Words};
use maud::{Markup, html};

const SAYS: Words = Words { en: "The chapter says", zh: "本章的说法" };
const PROOF: Words = Words { en: "Proof", zh: "证明" };
const ARGUMENT: Words = Words { en: "Proof or counterexample", zh: "论证（证明或反例）" };
const DECIDING: Words = Words { en: "The deciding finding", zh: "起决定作用的结果" };
const FINDINGS: Words = Words { en: "Every finding", zh: "全部结果" };
const CONTROLS: Words = Words { en: "Controls: other subjects under the same check", zh: "对照：用同一检查考察其他对象" };
const OTHER_VERDICT: Words = Words { en: "with this control the verdict is: ", zh: "用此对照得到的结论是：" };
const OTHERWISE: Words = Words { en: "with this control something else is found", zh: "用此对照得到不同的结果" };
const OPEN: Words = Words { en: " (", zh: "（" };
const CLOSE: Words = Words { en: ")", zh: "）" };
/// The heading of the places.
pub const PLACE: Words = Words { en: "Place in the chapter", zh: "在本章中的位置" };
const PARAGRAPH: Words =
    Words { en: "{0}paragraph {1} (line {2}, {3} % of the text): ", zh: "{0}第 {1} 段（第 {2} 行，全文 {3} % 处）：" };
const AFTER_HEADING: Words = Words { en: ", ", zh: "，" };
const ABSENT: Words = Words { en: "Not in the chapter: ", zh: "本章没有这句话：" };
const SOURCES: Words = Words { en: "Sources", zh: "来源" };
const CHECK: Words = Words { en: "Check", zh: "检查函数" };
const AGAIN: Words = Words { en: "The command that makes it again", zh: "重新得到它的命令" };
const REPEATS: Words = Words { en: "Repeats ", zh: "重复了 " };
const REPEATED: Words = Words { en: "Said again in ", zh: "又见于 " };
const EVIDENCE: Words = Words { en: "evidence: ", zh: "证据：" };
const ALARM: Words = Words { en: "NOT SUPPORTED by what was found: ", zh: "与所得结果不符：" };
const FINDING: Words = Words { en: "finding", zh: "结果" };
const ROLE: Words = Words { en: "the sentence", zh: "对该句" };
const FOUND: Words = Words { en: "found", zh: "得到" };
const EXPECTED: Words = Words { en: "expected", zh: "预期" };
const STATED: Words = Words { en: "the sentence says", zh: "该句所述" };
const USED: Words = Words { en: "share of the bound", zh: "占误差界之比" };
const UNMET: Words = Words { en: "not met here: ", zh: "此处不满足的条件：" };
const READING: Words = Words { en: "in the reading ", zh: "按此读法：" };
const OPINION: Words = Words { en: "an opinion: ", zh: "评价：" };
const PASSAGE: Words = Words { en: "said by ", zh: "出处：" };

/// A verdict as word and shape.
pub fn verdict(view: &View, verdict: Verdict) -> Markup {
    html! {
        span class={ "verdict " (verdict.key()) } { span.mark aria-hidden="true" { (verdict.mark()) } " " (view.say(verdict.words())) }
    }
}

/// Verdict, severity, evidence, kind and repetition of a claim.
pub fn standing(view: &View, claim: &ClaimEntry) -> Markup {
    html! {
        p.standing {
            (verdict(view, claim.verdict))
            @if let Some(severity) = claim.severity { " " span.tag { (view.say(severity.words())) } }
            " " span.tag { (view.say(EVIDENCE)) (view.say(claim.evidence.words())) }
            " " span.tag { (view.say(claim.kind.words())) }
        }
        @if let Some(alarm) = &claim.alarm { p.alarm role="alert" { (view.say(ALARM)) (view.english(alarm)) } }
    }
}

/// The claim as an article with its id as anchor.
pub fn article(view: &View, claim: &ClaimEntry) -> Markup {
    let argument = if claim.verdict == Verdict::True { PROOF } else { ARGUMENT };
    let correct = beyond(&claim.correct);
    html! {
        article.claim id=(claim.id) {
            h2 { a.anchor href={ "#" (claim.id) } { (claim.id) } " " (view.english(&claim.title)) }
            (standing(view, claim))
            (repetitions(view, claim))
            h3 { (view.say(SAYS)) }
            blockquote { (in_chinese(view, claim, |erratum| &erratum.says)) (view.english(&claim.statement)) }
            h3 { (view.say(PLACE)) }
            (places(view, claim))
            @if let Some(finding) = &claim.deciding {
                h3 { (view.say(DECIDING)) }
                p.deciding { (view.english(&finding.name)) (view.colon()) b { (view.english(&finding.found)) } (said(view, finding)) }
            }
            h3 { (view.say(argument)) }
            (in_chinese(view, claim, |erratum| &erratum.wrong))
            p { (view.english(&claim.argument)) }
            h3 { (view.say(label(claim))) }
            @if !correct.is_empty() {
                div.correct { (in_chinese(view, claim, |erratum| &erratum.reads)) p { (view.english(correct)) } }
            }
            (see_also(view, claim))
            (evidence(view, claim))
            p { (view.say(AGAIN)) (view.colon()) code { "moreau verify --explain " (claim.id) } }
        }
    }
}

/// A part of the erratum, on a Chinese page.
fn in_chinese(view: &View, claim: &ClaimEntry, part: fn(&Erratum) -> &String) -> Markup {
    html! {
        @if let (Some(erratum), Language::Chinese) = (&claim.erratum, view.language) { p { (view.chinese(part(erratum))) } }
    }
}

/// What is repeated, and by what.
pub fn repetitions(view: &View, claim: &ClaimEntry) -> Markup {
    let repeated: Vec<&str> = view.report.repetitions(&claim.id).map(|other| other.id.as_str()).collect();
    html! {
        @if let Some(original) = &claim.repeats { p { (view.say(REPEATS)) (view.claim_link(original)) } }
        @if !repeated.is_empty() { p { (view.say(REPEATED)) (view.claim_links(repeated.into_iter())) } }
    }
}

/// Where the chapter says it.
pub fn places(view: &View, claim: &ClaimEntry) -> Markup {
    html! {
        ul.places {
            @for place in &claim.places { li { (where_it_is(view, place)) q { (view.chinese(&place.words)) } } }
            @if let Some(reason) = &claim.absent { li { (view.say(ABSENT)) (view.english(reason)) } }
        }
    }
}

fn where_it_is(view: &View, place: &PlaceEntry) -> Markup {
    let section = if place.section.is_empty() || place.heading.starts_with('§') { String::new() } else { format!("{} ", place.section) };
    html! {
        (section) (view.chinese(&place.heading)) (view.say(AFTER_HEADING))
        (view.tell(PARAGRAPH, &[&"", &place.paragraph, &place.line, &place.percent]))
    }
}

/// Findings, controls, sources and the check: opened when asked for.
fn evidence(view: &View, claim: &ClaimEntry) -> Markup {
    html! {
        details {
            summary { (view.say(FINDINGS)) (view.aside(&claim.findings.len())) }
            (findings(view, &claim.id, &claim.findings))
        }
        details {
            summary { (view.say(CONTROLS)) (view.aside(&claim.controls.len())) }
            @for control in &claim.controls { (self::control(view, control)) }
        }
        details {
            summary { (view.say(SOURCES)) }
            ul { @for source in &claim.sources { li { (view.english(source)) } } }
            p { (view.say(CHECK)) (view.colon()) code { (claim.check) } }
        }
    }
}

fn control(view: &View, control: &ControlEntry) -> Markup {
    html! {
        p { (view.english(&control.subject)) }
        p {
            @match control.verdict {
                Some(found) => { (view.say(OTHER_VERDICT)) (verdict(view, found)) },
                None => (view.say(OTHERWISE)),
            }
        }
        ul {
            @for finding in &control.findings {
                li { (view.english(&finding.name)) (view.colon()) b { (prose(&finding.found)) } (said(view, finding)) }
            }
        }
    }
}

fn findings(view: &View, id: &str, findings: &[FindingEntry]) -> Markup {
    let table = html! {
        table {
            thead { tr {
                @for head in [ROLE, FINDING, FOUND, EXPECTED, STATED, USED] { th scope="col" { (view.say(head)) } }
            } }
            tbody { @for finding in findings { (row(view, finding)) } }
        }
    };
    view.scrolled(&format!("{id}: {}", view.say(FINDING)), &table)
}

fn row(view: &View, finding: &FindingEntry) -> Markup {
    html! {
        tr {
            td { span class={ "role " (finding.role.key()) } { (view.say(finding.role.words())) } }
            td { (view.english(&finding.name)) (unmet(view, finding)) }
            td.n { (prose(&finding.found)) }
            td.n { (prose(&finding.expected)) }
            td { @if let Some(stated) = &finding.stated { (view.english(stated)) } (voice(view, finding)) }
            td.n { (finding.used.as_deref().unwrap_or("")) }
        }
    }
}

fn unmet(view: &View, finding: &FindingEntry) -> Markup {
    html! { @if let Some(condition) = &finding.violated { br; small { (view.say(UNMET)) (view.english(condition)) } } }
}

fn voice(view: &View, finding: &FindingEntry) -> Markup {
    let (label, words) = match &finding.voice {
        None => return html! {},
        Some(Voice::Passage(words)) => (PASSAGE, words),
        Some(Voice::Reading(words)) => (READING, words),
        Some(Voice::Opinion(words)) => (OPINION, words),
    };
    html! { " " small { (view.say(label)) (view.english(words)) } }
}

/// What the sentence says of the deciding finding, or what is expected of it.
fn said(view: &View, finding: &FindingEntry) -> Markup {
    let (label, words) = match &finding.stated {
        Some(stated) => (STATED, stated),
        None => (EXPECTED, &finding.expected),
    };
    html! { (view.say(OPEN)) (view.say(label)) " " (view.english(words)) (view.say(CLOSE)) (voice(view, finding)) (unmet(view, finding)) }
}
