//! Two pages to print: counts, sections, the theorems that do not hold, and how to make it again.

use super::axes::{Axis, Evidence, Severity, Verdict};
use super::claim::verdict;
use super::data::ClaimEntry;
use super::errata::{grave, is_grave};
use super::frame::document;
use super::front;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};

const TITLE: Words = Words { en: "Summary", zh: "摘要" };
const HOW: Words = Words {
    en: "Each of the {0} claims has a check that computes: exact fractions, closed forms with derived bounds, stored runs of engines, or \
         facts that were looked up. The verdict is derived from what the check finds. A control – another subject put to the same check – \
         must lead to another verdict.",
    zh: "{0} 条论断各有一个会计算的检查：精确分数、带推导误差界的闭式解、引擎的已存运行结果，或查证的事实。结论由检查结果推出。对照（用同一检查考察其他对象）必须得到不同的结论。",
};
const CONTRADICTED: Words =
    Words { en: "Not supported by what was found in this run: {0}.", zh: "本次运行中与所得结果不符的论断：{0} 条。" };
const BROKEN: Words = Words { en: "Theorems that do not hold as printed", zh: "如所述不成立的定理" };
const OTHER: Words = Words { en: "Other false or inconsistent sentences", zh: "其他不成立或自相矛盾的句子" };
const ELSEWHERE: Words = Words { en: "What else was checked", zh: "其他检验" };
const AGAIN: Words = Words { en: "How to make it again", zh: "如何重新得到" };
const EVIDENCE: Words = Words { en: "Evidence: ", zh: "证据：" };
const AGAIN_ELSEWHERE: Words = Words { en: "Said again elsewhere in the chapter: {0}.", zh: "在本章别处重复出现的：{0} 条。" };

/// The page.
pub fn page(view: &View) -> String {
    let report = view.report;
    let (broken, other): (Vec<_>, Vec<_>) = grave(view).partition(|claim| claim.severity == Some(Severity::BrokenTheorem));
    let body = html! {
        div.summary {
            h1 { (view.say(TITLE)) }
            p.meta { (view.chinese(&report.chapter)) }
            p { (view.tell(HOW, &[&report.claims.len()])) }
            ul.counts {
                @for &each in Verdict::ALL { li { (verdict(view, each)) " " b { (report.count(|claim| claim.verdict == each)) } } }
            }
            p {
                (view.say(EVIDENCE))
                @for (k, &each) in Evidence::ALL.iter().enumerate() {
                    @if k > 0 { (view.comma()) } (view.say(each.words())) " " (report.count(|claim| claim.evidence == each))
                }
                (view.stop()) (view.tell(CONTRADICTED, &[&report.contradicted().count()]))
            }
            (front::sections(view))
            h2 { (view.say(BROKEN)) }
            (titles(view, &broken))
            h2 { (view.say(OTHER)) }
            (titles(view, &other))
            p { a href="errata.html" { (view.tell(AGAIN_ELSEWHERE, &[&repeated(view)])) } }
            h2 { (view.say(ELSEWHERE)) }
            ul { @for line in [front::findings(view), front::systems(view), front::board(view), front::defects(view)] { li { (line) } } }
            h2 { (view.say(AGAIN)) }
            p {
                code { "moreau verify" } (view.comma()) code { "moreau verify --explain ID" } (view.comma())
                code { "moreau report --out FOLDER" }
            }
        }
    };
    document(view, view.say(TITLE), &body)
}

/// Ids and titles.
fn titles(view: &View, claims: &[&ClaimEntry]) -> Markup {
    html! { ul.titles { @for claim in claims { li { (view.claim_link(&claim.id)) " " (view.title(claim)) } } } }
}

/// How many claims are false or inconsistent and say what another one says.
fn repeated(view: &View) -> usize {
    view.report.count(|claim| is_grave(claim) && claim.repeats.is_some())
}
