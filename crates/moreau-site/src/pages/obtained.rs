//! How each number was obtained, and the command that makes it again.

use super::frame::document;
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};

const TITLE: Words = Words { en: "How each number was obtained", zh: "每个数据的来源" };
const LEAD: Words = Words {
    en: "Every number of this report is computed by the program that wrote it, or read from a file that the program holds. The commands \
         make them again.",
    zh: "本报告的每个数值，或由生成它的程序计算，或读自程序内含的文件。以下命令可重新得到它们。",
};
const WHAT: Words = Words { en: "what", zh: "内容" };
const HOW: Words = Words { en: "how it was obtained", zh: "如何得到" };
const COMMAND: Words = Words { en: "the command that makes it again", zh: "重新得到它的命令" };

/// Something that was obtained.
struct Row {
    /// Its anchor.
    anchor: &'static str,
    /// Its page.
    file: &'static str,
    what: Words,
    how: Words,
    command: &'static str,
}

const ROWS: [Row; 10] = [
    Row {
        anchor: "verdicts",
        file: "claims.html",
        what: Words { en: "verdicts of the claims", zh: "论断的结论" },
        how: Words {
            en: "computed for this report: every check ran on the sentence's subject and on each control; the verdict follows from the \
                 findings",
            zh: "为本报告计算：每个检查都在该句的对象和每个对照上运行；结论由结果推出",
        },
        command: "moreau verify",
    },
    Row {
        anchor: "claim",
        file: "claims.html",
        what: Words { en: "numbers of one claim", zh: "单条论断的数值" },
        how: Words {
            en: "findings of its check, rounded to the digits that the bound supports",
            zh: "其检查的结果，按误差界支持的位数取整",
        },
        command: "moreau verify --explain ID",
    },
    Row {
        anchor: "witnesses",
        file: "claims.html",
        what: Words { en: "exact decisions", zh: "精确判定" },
        how: Words {
            en: "witnesses in fractions, which a second program in Python checks",
            zh: "分数形式的见证，由另一个 Python 程序复核",
        },
        command: "moreau verify --export witnesses.json && python3 scripts/check_witnesses.py witnesses.json",
    },
    Row {
        anchor: "places",
        file: "errata.html",
        what: Words { en: "places in the chapter", zh: "在本章中的位置" },
        how: Words {
            en: "quoted words, found in the chapter's text by a script; line and share of the text are counted",
            zh: "由脚本在本章正文中查到的引文；行号与百分比由计数得到",
        },
        command: "python3 scripts/chapter_places.py",
    },
    Row {
        anchor: "systems",
        file: "systems.html",
        what: Words { en: "agreements of the systems", zh: "系统的一致程度" },
        how: Words {
            en: "measured for this report, against closed forms, exact fractions and stored runs of the engines",
            zh: "为本报告实测，对照闭式解、精确分数与引擎的已存运行结果",
        },
        command: "moreau systems",
    },
    Row {
        anchor: "scoreboard",
        file: "scoreboard.html",
        what: Words { en: "scoreboard of engines", zh: "引擎记分板" },
        how: Words {
            en: "stored results of runs of the engines at 1/60, 1/240 and 1/1000 s, on one type of processor; running them again needs a \
                 checkout and the engines",
            zh: "引擎在 1/60、1/240 与 1/1000 秒步长下的已存运行结果，均在同一类处理器上得到；重新运行需要源码与各引擎",
        },
        command: "moreau scoreboard --stored",
    },
    Row {
        anchor: "defects",
        file: "defects.html",
        what: Words { en: "planted mistakes", zh: "植入的错误" },
        how: Words {
            en: "families, schemes and agreements: run for this report; engines: the checks that a test sees catching them",
            zh: "各族、格式与一致性：为本报告运行；引擎：测试所见能发现它们的检查",
        },
        command: "moreau defects",
    },
    Row {
        anchor: "problems",
        file: "problems.html",
        what: Words { en: "contact problems", zh: "接触问题" },
        how: Words {
            en: "stored problems and records; answers were certified, distances proved in fractions or by intervals when they were stored",
            zh: "已存问题与记录；存入时解已认证，距离以分数或区间证明",
        },
        command: "moreau problems list",
    },
    Row {
        anchor: "pictures",
        file: "pictures.html",
        what: Words { en: "pictures", zh: "图示" },
        how: Words {
            en: "computed for this report, or read from the stored results; each names its command",
            zh: "为本报告计算，或读自已存结果；各图注明其命令",
        },
        command: "moreau report --out FOLDER",
    },
    Row {
        anchor: "report",
        file: "index.html",
        what: Words { en: "this report", zh: "本报告" },
        how: Words {
            en: "written whole, with report.json beside the pages for programs",
            zh: "一次完整写出，并附供程序使用的 report.json",
        },
        command: "moreau report --out FOLDER",
    },
];

/// The page.
pub fn page(view: &View) -> String {
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.say(LEAD)) }
        (view.scrolled(view.say(TITLE), &table(view)))
        p { a href=(view.shared("report.json")) { "report.json" } }
    };
    document(view, view.say(TITLE), &body)
}

fn table(view: &View) -> Markup {
    html! {
        table {
            thead { tr { @for head in [WHAT, HOW, COMMAND] { th scope="col" { (view.say(head)) } } } }
            tbody {
                @for row in &ROWS {
                    tr id=(row.anchor) {
                        th scope="row" { a href=(row.file) { (view.say(row.what)) } }
                        td { (view.say(row.how)) }
                        td { code { (row.command) } }
                    }
                }
            }
        }
    }
}
