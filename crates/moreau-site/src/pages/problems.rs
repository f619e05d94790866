//! The collection of contact problems with certified answers.

use super::data::{ProblemEntry, Uniqueness};
use super::frame::document;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};

const TITLE: Words = Words { en: "Contact problems with certified answers", zh: "带认证解的接触问题" };
const LEAD: Words = Words {
    en: "{0} problems u = W r + u_free under a contact law, each with the answers that a certificate accepts. δ: the answer solves exactly \
         a problem whose free velocity is this near. Radius: how far in u a solution of the problem itself is at most, proved. A dash: not \
         proved. Failed: solvers that gave up or whose answer the certificate rejects.",
    zh: "{0} 个问题 u = W r + u_free，附接触定律，以及证书接受的解。δ：该解精确满足自由速度与之相差不超过 δ 的问题。半径：已证明问题本身的某个解在 u 上至多相距多远。短横线：未证明。失败：放弃或其解被证书拒绝的求解器数。",
};
const OBTAINED: Words = Words { en: "How these numbers were obtained", zh: "这些数据的来源" };
const HEADS: [Words; 11] = [
    Words { en: "problem", zh: "问题" },
    Words { en: "contacts", zh: "接触数" },
    Words { en: "rows", zh: "每接触行数" },
    Words { en: "law", zh: "定律" },
    Words { en: "μ", zh: "μ" },
    Words { en: "velocity", zh: "速度" },
    Words { en: "answers", zh: "解数" },
    Words { en: "δ [m/s]", zh: "δ [m/s]" },
    Words { en: "radius [m/s]", zh: "半径 [m/s]" },
    Words { en: "failed", zh: "失败" },
    Words { en: "made by", zh: "生成命令" },
];

/// The page.
pub fn page(view: &View) -> String {
    let problems = &view.report.problems;
    let table = html! {
        table {
            thead { tr { @for head in HEADS { th scope="col" { (view.say(head)) } } } }
            tbody { @for problem in problems { (row(view, problem)) } }
        }
    };
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.tell(LEAD, &[&problems.len()])) }
        p { a href="obtained.html#problems" { (view.say(OBTAINED)) } }
        (view.scrolled_wide(view.say(TITLE), &table))
    };
    document(view, view.say(TITLE), &body)
}

fn known(uniqueness: Uniqueness) -> Words {
    match uniqueness {
        Uniqueness::Unique => Words { en: "unique", zh: "唯一" },
        Uniqueness::Several => Words { en: "several", zh: "不唯一" },
        Uniqueness::None => Words { en: "no solution", zh: "无解" },
        Uniqueness::AtMostOne => Words { en: "at most one", zh: "至多一个" },
        Uniqueness::Unknown => Words { en: "unknown", zh: "未知" },
    }
}

fn row(view: &View, problem: &ProblemEntry) -> Markup {
    html! {
        tr {
            th scope="row" { code { (problem.name) } br; (view.english(&problem.about)) }
            td.n { (problem.contacts) }
            td.n { (problem.dimension) }
            td { (view.english(&problem.law)) }
            td.n { (problem.friction) }
            td { (view.say(known(problem.uniqueness))) }
            td.n { (problem.answers) }
            td.n { (problem.backward) }
            td.n { (problem.forward) }
            td.n { (problem.failures) }
            td { code { (problem.script) } }
        }
    }
}
