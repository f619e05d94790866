//! The planted mistakes and the checks that catch them.

use super::data::DefectEntry;
use super::frame::document;
use super::front;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};
use moreau_checks::planted::{KINDS, Kind};

const TITLE: Words = Words { en: "Planted mistakes", zh: "植入的错误" };
const LEAD: Words = Words {
    en: "A check that no mistake can fail shows nothing. Each row is one realistic mistake, and which checks catch it.",
    zh: "任何错误都不能使其失败的检查什么也证明不了。每行是一个真实可能的错误，以及发现它的检查。",
};
const COUNTED: Words = Words {
    en: "For this report the checks of families, schemes and agreements ran. Engines with a mistake are put to the gate's checks by \
         cargo test, which holds each to the checks named here; moreau defects puts every engine to every check and takes minutes.",
    zh: "生成本报告时运行了各族检查、格式检查与一致性检查。带错误的引擎由 cargo test 交给引擎验收检查（此处列出其名）；moreau defects 将每个引擎交给所有检查，需数分钟。",
};
const OBTAINED: Words = Words { en: "How these numbers were obtained", zh: "这些数据的来源" };
const MISTAKE: Words = Words { en: "mistake", zh: "错误" };
const CAUGHT: Words = Words { en: "caught by, in this run", zh: "本次运行中发现它的检查" };
const NAMED: Words = Words { en: "caught by, checks of the gate", zh: "发现它的引擎验收检查" };
const REPEATS: Words = Words { en: "repeats ", zh: "重复 " };
const NOBODY: Words = Words { en: "NOBODY", zh: "无检查发现" };

/// The page.
pub fn page(view: &View) -> String {
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.say(LEAD)) }
        p { (front::defects(view)) (view.stop()) a href="obtained.html#defects" { (view.say(OBTAINED)) } }
        p { (view.say(COUNTED)) }
        @for kind in KINDS {
            @let rows: Vec<_> = view.report.defects.iter().filter(|defect| defect.kind == kind).collect();
            h2 { (view.say(plural(kind))) (view.aside(&rows.len())) }
            (view.scrolled(view.say(plural(kind)), &table(view, &rows)))
        }
    };
    document(view, view.say(TITLE), &body)
}

fn plural(kind: Kind) -> Words {
    match kind {
        Kind::Assembly => Words { en: "Assemblies", zh: "组装" },
        Kind::Projection => Words { en: "Projections", zh: "投影" },
        Kind::Solver => Words { en: "Solvers", zh: "求解器" },
        Kind::Certificate => Words { en: "Certificates", zh: "认证" },
        Kind::Scheme => Words { en: "Schemes", zh: "格式" },
        Kind::ClosedForm => Words { en: "Closed forms", zh: "闭式解" },
        Kind::Reader => Words { en: "Readers", zh: "读取器" },
        Kind::Report => Words { en: "Reports", zh: "报告" },
    }
}

fn table(view: &View, rows: &[&DefectEntry]) -> Markup {
    html! {
        table {
            thead { tr { @for head in [MISTAKE, CAUGHT, NAMED] { th scope="col" { (view.say(head)) } } } }
            tbody { @for defect in rows { (row(view, defect)) } }
        }
    }
}

fn row(view: &View, defect: &DefectEntry) -> Markup {
    let names = |names: &[String]| view.english(&names.join("; "));
    html! {
        tr {
            th scope="row" {
                code { (defect.name) } br; (view.english(&defect.mistake))
                @if let Some(original) = &defect.repeats { br; small { (view.say(REPEATS)) code { (original) } } }
            }
            td { (names(&defect.caught)) }
            td { @if defect.caught.is_empty() && defect.named.is_empty() { b.alarm { (view.say(NOBODY)) } } (names(&defect.named)) }
        }
    }
}
