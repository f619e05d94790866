//! The stored scoreboard of engines: counts, every mark, and behind every mark the number that decided it.
//!
//! What a link leads to stands inside of what is to be opened: a browser opens the parts around it.

use super::frame::document;
use super::front;
use super::view::View;
use crate::words::{Language, Words};
use maud::{Markup, html};
use moreau_exact::number::significant;
use moreau_gate::cause::{self, Cause, Component};
use moreau_gate::report::{decisive, highlights, sentence};
use moreau_gate::scoreboard::Standing;
use moreau_gate::{CheckOutcome, Report, Verdict, checks};

const TITLE: Words = Words { en: "Engines through one set of checks", zh: "引擎记分板：同一套检查" };
const LEAD: Words = Words {
    en: "Stored results. A mark leads to the number that decided it, the name of a check to its question. Sentences about engines are \
         English.",
    zh: "已存结果。点击标记可看到决定它的数值，点击检查名可看到它的问题；这些说明文字为英文，列在英文页上。",
};
const ENGINE: Words = Words { en: "engine", zh: "引擎" };
const ENGINES: Words = Words { en: "The engines", zh: "各引擎" };
const SHOWS: Words = Words { en: "What it shows", zh: "结果要点" };
const EVERY_CHECK: Words = Words { en: "Every check of every engine", zh: "每个引擎的每项检查" };
const EVERY_NUMBER: Words = Words { en: "Every number", zh: "全部数值" };
const CAUSES: Words = Words { en: "Why checks are not passed", zh: "未通过的原因" };
const CHECKS: Words = Words { en: "The checks", zh: "检查列表" };
const NOT_RUN: Words = Words { en: "not run", zh: "未运行" };
const INSTALLED: Words = Words { en: "Installed by", zh: "安装方式" };
const BAD_AT: Words = Words { en: "bad at h = {0} s", zh: "在步长 h = {0} s 时不通过" };
const BESIDE: Words = Words { en: "; ", zh: "；" };
const SEEN: Words = Words { en: "Seen by this: ", zh: "依据：" };
const OBTAINED: Words = Words { en: "How these numbers were obtained", zh: "这些数据的来源" };

/// The verdicts, the bad ones first.
const ORDER: [Verdict; 5] = [Verdict::Fail, Verdict::Errored, Verdict::Unsupported, Verdict::Difference, Verdict::Pass];

/// The page.
pub fn page(view: &View) -> String {
    let standings = view.report.standings;
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.say(LEAD)) " " a href="obtained.html#scoreboard" { (view.say(OBTAINED)) } }
        p { (front::board(view)) }
        ul.counts { @for verdict in ORDER { li { (mark(verdict)) " " (view.say(meaning(verdict))) } } }
        h2 { (view.say(ENGINES)) }
        (view.scrolled(view.say(ENGINES), &counts(view, standings)))
        @if has_sentences(view) {
            h2 { (view.say(SHOWS)) }
            (highlights::html(standings))
        }
        h2 { (view.say(EVERY_CHECK)) }
        (view.scrolled_wide(view.say(EVERY_CHECK), &matrix(view, standings)))
        @if has_sentences(view) { (sentences(view)) }
    };
    document(view, view.say(TITLE), &body)
}

/// Whether the sentences about engines, which are English, stand on this page; the Chinese one leads to them.
fn has_sentences(view: &View) -> bool {
    view.language == Language::English
}

/// A link to a sentence about engines.
fn sentence_link(view: &View, anchor: &str) -> String {
    if has_sentences(view) { format!("#{anchor}") } else { format!("{}#{anchor}", view.twin().1) }
}

/// Every number with its cause, and the questions of the checks.
fn sentences(view: &View) -> Markup {
    html! {
        h2 { (view.say(EVERY_NUMBER)) }
        @for standing in view.report.standings { (numbers(view, standing)) }
        h2 { (view.say(CAUSES)) }
        @for (k, cause) in view.report.causes.iter().enumerate() { (reason(view, k, cause)) }
        h2 { (view.say(CHECKS)) }
        dl {
            @for check in checks::all() {
                dt id={ "check:" (check.name) } { code { (check.name) } }
                dd { (view.english(check.question)) }
            }
        }
    }
}

fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓",
        Verdict::Difference => "≈",
        Verdict::Fail => "✗",
        Verdict::Errored => "!",
        Verdict::Unsupported => "–",
    }
}

fn meaning(verdict: Verdict) -> Words {
    match verdict {
        Verdict::Pass => Words { en: "as Coulomb–Signorini demands", zh: "符合 Coulomb–Signorini 定律" },
        Verdict::Difference => {
            Words { en: "different, as the engine’s declared law predicts", zh: "有差异，与引擎声明的定律一致" }
        }
        Verdict::Fail => Words { en: "fails", zh: "失败" },
        Verdict::Errored => Words { en: "errored", zh: "出错" },
        Verdict::Unsupported => Words { en: "the engine does not do this", zh: "引擎不支持" },
    }
}

fn short(verdict: Verdict) -> Words {
    match verdict {
        Verdict::Pass => Words { en: "pass", zh: "通过" },
        Verdict::Difference => Words { en: "difference", zh: "有差异" },
        Verdict::Unsupported => Words { en: "unsupported", zh: "不支持" },
        bad => meaning(bad),
    }
}

fn component(component: Component) -> Words {
    match component {
        Component::Solver => Words { en: "solver", zh: "求解器" },
        Component::Discretisation => Words { en: "discretisation", zh: "离散" },
        Component::Model => Words { en: "model", zh: "模型" },
        Component::Collision => Words { en: "collision", zh: "碰撞检测" },
        Component::Interface => Words { en: "interface", zh: "接口" },
        Component::Unknown => Words { en: "unknown", zh: "未知" },
    }
}

/// One row per engine, the bad verdicts first.
fn counts(view: &View, standings: &[Standing]) -> Markup {
    html! {
        table {
            thead { tr {
                th scope="col" { (view.say(ENGINE)) }
                @for verdict in ORDER { th.n scope="col" { (mark(verdict)) " " (view.say(short(verdict))) } }
            } }
            tbody {
                @for standing in standings {
                    tr {
                        th scope="row" { (name(view, standing)) }
                        @match &standing.report {
                            Some(report) => { @for verdict in ORDER { td.n { (report.count(verdict)) } } },
                            None => { td colspan="5" { (not_run(view, standing)) } },
                        }
                    }
                }
            }
        }
    }
}

/// The name of an engine, which leads to its numbers, and its version.
fn name(view: &View, standing: &Standing) -> Markup {
    html! {
        a href=(sentence_link(view, &format!("engine:{}", standing.entry.name))) { (standing.entry.name) }
        @if let Some(report) = &standing.report { " " small { (report.engine.name) " " (report.engine.version) } }
    }
}

fn not_run(view: &View, standing: &Standing) -> Markup {
    html! { (view.say(NOT_RUN)) (view.colon()) (view.english(standing.not_run.as_deref().unwrap_or("–"))) }
}

fn matrix(view: &View, standings: &[Standing]) -> Markup {
    html! {
        table.matrix {
            thead { tr {
                th scope="col" { (view.say(ENGINE)) }
                @for check in checks::all() {
                    th scope="col" { a href=(sentence_link(view, &format!("check:{}", check.name))) { (check.name) } }
                }
            } }
            tbody {
                @for standing in standings {
                    tr {
                        th scope="row" { (name(view, standing)) }
                        @match &standing.report {
                            Some(report) => { @for check in checks::all() { (cell(view, &standing.entry.name, report, check.name)) } },
                            None => { td colspan=(checks::all().count()) { (not_run(view, standing)) } },
                        }
                    }
                }
            }
        }
    }
}

/// A mark, which leads to its number.
fn cell(view: &View, engine: &str, report: &Report, check: &str) -> Markup {
    let Some(outcome) = report.checks.iter().find(|outcome| outcome.check == check) else { return html! { td { "·" } } };
    let word = view.say(short(outcome.verdict));
    html! {
        td class=(outcome.verdict.word()) {
            a href=(sentence_link(view, &format!("{engine}:{check}")))
                aria-label={ (engine) (view.comma()) (check) (view.colon()) (word) } { (mark(outcome.verdict)) }
        }
    }
}

/// Everything that is known of an engine, the bad verdicts first.
fn numbers(view: &View, standing: &Standing) -> Markup {
    let engine = &standing.entry.name;
    html! {
        details {
            summary { b { (engine) } @if let Some(report) = &standing.report {
                " " small { (report.engine.name) " " (report.engine.version) }
            } }
            div id={ "engine:" (engine) } {
                @match &standing.report {
                    Some(report) => {
                        p { (view.say(INSTALLED)) (view.colon()) code { (standing.entry.install) } }
                        ul.numbers {
                            @for verdict in ORDER {
                                @for outcome in report.checks.iter().filter(|outcome| outcome.verdict == verdict) {
                                    (number(view, engine, outcome))
                                }
                            }
                        }
                    },
                    None => { p { (not_run(view, standing)) } },
                }
            }
        }
    }
}

/// What decided one check of one engine, and why it came out so where that was found out.
fn number(view: &View, engine: &str, outcome: &CheckOutcome) -> Markup {
    let at = outcome.fails_at.iter().map(|h| significant(*h)).collect::<Vec<_>>().join(", ");
    let causes = &view.report.causes;
    let cause = causes.iter().position(|one| cause::is_of(one, engine, &outcome.check));
    html! {
        li id={ (engine) ":" (outcome.check) } {
            span class={ "gate " (outcome.verdict.word()) } { (mark(outcome.verdict)) " " (view.say(short(outcome.verdict))) }
            " " b { (outcome.check) } " " (view.english(&decided(outcome)))
            @if !at.is_empty() { (view.say(BESIDE)) (view.tell(BAD_AT, &[&at])) }
            @if let Some(k) = cause { " " a href={ "#cause:" (k) } { (view.say(component(causes[k].error))) } }
        }
    }
}

/// Why a check came out as it did: its reason, or the measurement that decides it.
fn decided(outcome: &CheckOutcome) -> String {
    outcome.reason.clone().or_else(|| decisive(outcome).map(|(step, one)| sentence(step, one))).unwrap_or_default()
}

/// A cause with its evidence.
fn reason(view: &View, k: usize, cause: &Cause) -> Markup {
    html! {
        details {
            summary {
                b { (view.say(component(cause.error))) } (view.colon()) (cause.engines.join(view.comma())) (view.colon())
                (cause.checks.join(view.comma()))
            }
            p id={ "cause:" (k) } { (view.english(&cause.cause)) }
            p { (view.say(SEEN)) (view.english(&cause.evidence)) }
        }
    }
}
