//! The front page: what was checked and what came out, in one screen; then the sections and the other results.

use super::axes::{Axis, Evidence, Severity, Verdict};
use super::data::Report;
use super::frame::document;
use super::section::title;
use super::view::{View, section_file};
use crate::words::Words;
use maud::{Markup, html};
use moreau_gate::Verdict as Gate;

const TITLE: Words = Words {
    en: "Time-stepping of contact: what a textbook chapter says, and what holds",
    zh: "接触动力学的时步法：教材一章的论断与检验结果",
};
const LEAD: Words = Words {
    en: "Every claim of this chapter was put to a program that computes. The verdict of a claim follows from what was found, and another \
         subject put to the same program must come out otherwise.",
    zh: "本章的每条论断都由可执行的程序检验。结论由计算结果推出；用同一程序考察其他对象，必须得到不同的结果。",
};
const OF: Words = Words { en: "The chapter: ", zh: "所检验的章节：" };
const CLAIMS: Words = Words { en: "{0} claims", zh: "{0} 条论断" };
const NONE: Words = Words { en: "No claim is contradicted by what was found.", zh: "没有论断的结论与所得结果相矛盾。" };
const SOME: Words = Words {
    en: "{0} claims are not supported by what was found in this run: ",
    zh: "本次运行中有 {0} 条论断的结论与所得结果不符：",
};
const WRONG: Words = Words { en: "What is wrong", zh: "问题类型" };
const EVIDENCE: Words = Words { en: "Evidence", zh: "证据等级" };
const MORE: Words = Words { en: "What else was checked", zh: "其他检验" };
const SECTIONS: Words = Words { en: "The chapter, section by section", zh: "逐节结果" };
const SECTION: Words = Words { en: "section", zh: "章节" };
const SYSTEMS: Words = Words {
    en: "{0} simulators rebuilt from their own equations, {1} agreements with closed forms, exact fractions and stored runs, {2} outside \
         their bound",
    zh: "按各自方程重建的 {0} 个仿真系统，与闭式解、精确分数和已存运行结果的 {1} 项对比，{2} 项超出误差界",
};
const BOARD: Words = Words {
    en: "{0} configurations of engines in {1} checks: {2} answers as Coulomb’s law demands, {3} differ as declared, {4} fail or err",
    zh: "{0} 种引擎配置，{1} 项检查：{2} 项符合 Coulomb 定律，{3} 项按其声明的模型有差异，{4} 项失败或出错",
};
const DEFECTS: Words = Words {
    en: "{0} planted mistakes that the checks must catch; {1} are caught by checks that ran for this report, {2} by checks of the gate",
    zh: "{0} 个植入的错误须被检查发现：{1} 个由本次运行的检查发现，{2} 个由引擎验收检查发现",
};
const FINDINGS: Words = Words {
    en: "{0} findings decide the verdicts, {1} of them come out otherwise under one of {2} controls",
    zh: "决定结论的结果：{0} 项；换成对照后得到不同结果的：{1} 项；对照共 {2} 个",
};
const PROBLEMS: Words = Words { en: "{0} contact problems with certified answers", zh: "{0} 个带认证解的接触问题" };

/// The page.
pub fn page(view: &View) -> String {
    let report = view.report;
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.say(LEAD)) }
        p.meta { (view.say(OF)) (view.chinese(&report.chapter)) }
        (alarm(view))
        h2 { (view.tell(CLAIMS, &[&report.claims.len()])) }
        (verdicts(view))
        div.columns {
            section {
                h2 { (view.say(WRONG)) }
                (bars::<Severity>(view, "severity", |value| report.count(|claim| claim.severity == Some(value))))
            }
            section {
                h2 { (view.say(EVIDENCE)) }
                (bars::<Evidence>(view, "evidence", |value| report.count(|claim| claim.evidence == value)))
            }
            section {
                h2 { (view.say(MORE)) }
                (others(view))
            }
        }
        h2 { (view.say(SECTIONS)) }
        (sections(view))
    };
    document(view, view.say(TITLE), &body)
}

/// Whether anything is contradicted.
fn alarm(view: &View) -> Markup {
    let contradicted: Vec<&str> = view.report.contradicted().map(|claim| claim.id.as_str()).collect();
    html! {
        @if contradicted.is_empty() {
            p.fine { (view.say(NONE)) }
        } @else {
            p.alarm role="alert" { (view.tell(SOME, &[&contradicted.len()])) (view.claim_links(contradicted.into_iter())) }
        }
    }
}

/// How many claims have which verdict, each a link to them.
fn verdicts(view: &View) -> Markup {
    html! {
        ul.cards {
            @for &each in Verdict::ALL {
                li class=(each.key()) {
                    a href={ "claims.html#verdict=" (each.key()) } {
                        b { (view.report.count(|claim| claim.verdict == each)) } " "
                        span { span.mark aria-hidden="true" { (each.mark()) } " " (view.say(each.words())) }
                    }
                }
            }
        }
    }
}

/// How many claims have which value of an axis, each a link with a bar.
fn bars<A: Axis>(view: &View, name: &str, count: impl Fn(A) -> usize) -> Markup {
    let most = A::ALL.iter().map(|&value| count(value)).max().unwrap_or(1).max(1);
    html! {
        ul.bars {
            @for &value in A::ALL {
                li { a href={ "claims.html#" (name) "=" (value.key()) } {
                    span { (view.say(value.words())) } " " b { (count(value)) }
                    span.bar aria-hidden="true" style={ "width:" (100 * count(value) / most) "%" } {}
                } }
            }
        }
    }
}

/// The other results, each with its page.
fn others(view: &View) -> Markup {
    let report = view.report;
    html! {
        ul.links {
            li { a href="obtained.html" { (findings(view)) } }
            li { a href="systems.html" { (systems(view)) } }
            li { a href="scoreboard.html" { (board(view)) } }
            li { a href="defects.html" { (defects(view)) } }
            li { a href="problems.html" { (view.tell(PROBLEMS, &[&report.problems.len()])) } }
        }
    }
}

/// What decides, and what is moved.
pub fn findings(view: &View) -> String {
    let figures = view.report.figures;
    view.tell(FINDINGS, &[&figures.deciding, &figures.moved, &figures.controls])
}

/// How the systems agree.
pub fn systems(view: &View) -> String {
    let systems = &view.report.systems.systems;
    let all = || systems.iter().flat_map(|system| &system.held_against);
    view.tell(SYSTEMS, &[&systems.len(), &all().count(), &all().filter(|agreement| !agreement.holds).count()])
}

/// How the engines stand.
pub fn board(view: &View) -> String {
    let standings = view.report.standings;
    let count =
        |verdict: Gate| -> usize { standings.iter().filter_map(|one| one.report.as_ref()).map(|report| report.count(verdict)).sum() };
    let bad = count(Gate::Fail) + count(Gate::Errored);
    let checks = moreau_gate::checks::all().count();
    view.tell(BOARD, &[&standings.len(), &checks, &count(Gate::Pass), &count(Gate::Difference), &bad])
}

/// What is planted, and what catches it.
pub fn defects(view: &View) -> String {
    let Report { defects, .. } = *view.report;
    let now = defects.iter().filter(|defect| !defect.caught.is_empty()).count();
    let gate = defects.iter().filter(|defect| defect.caught.is_empty() && !defect.named.is_empty()).count();
    view.tell(DEFECTS, &[&defects.len(), &now, &gate])
}

/// How many claims of each section have which verdict; on a narrow screen the verdicts are marks, which the counts above explain.
pub fn sections(view: &View) -> Markup {
    html! {
        table.sections {
            thead { tr {
                th scope="col" { (view.say(SECTION)) }
                @for &each in Verdict::ALL {
                    th.n scope="col" { span class={ "verdict " (each.key()) } {
                        span.mark aria-hidden="true" { (each.mark()) } " " span.word { (view.say(each.words())) }
                    } }
                }
            } }
            tbody {
                @for section in &view.report.sections {
                    tr {
                        th scope="row" { a href=(section_file(&section.group)) { (title(view, section)) } }
                        @for &each in Verdict::ALL {
                            td.n { (view.report.of(&section.group).filter(|claim| claim.verdict == each).count()) }
                        }
                    }
                }
            }
        }
    }
}
