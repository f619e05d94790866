//! What every page has: its head, the way to the other pages, and the same page in the other language.

use super::view::View;
use crate::words::{Language, Words};
use maud::{DOCTYPE, Markup, html};

/// Every page that the menu names, with its file.
pub const MENU: [(&str, Words); 11] = [
    ("index.html", Words { en: "Overview", zh: "总览" }),
    ("claims.html", Words { en: "Claims", zh: "论断" }),
    ("errata.html", Words { en: "Errata", zh: "勘误表" }),
    ("pictures.html", Words { en: "Pictures", zh: "图示" }),
    ("explorer.html", Words { en: "Explorer", zh: "探索页" }),
    ("systems.html", Words { en: "Systems", zh: "系统" }),
    ("scoreboard.html", Words { en: "Scoreboard", zh: "引擎记分板" }),
    ("problems.html", Words { en: "Problems", zh: "接触问题集" }),
    ("defects.html", Words { en: "Planted mistakes", zh: "植入的错误" }),
    ("obtained.html", Words { en: "Origins", zh: "数据来源" }),
    ("summary.html", Words { en: "To print", zh: "两页打印摘要" }),
];

const SKIP: Words = Words { en: "To the content", zh: "跳到正文" };
const PAGES: Words = Words { en: "Pages", zh: "页面" };
const QUOTED: Words = Words { en: "Words of the chapter are quoted in Chinese.", zh: "本章原文的引文为中文。" };
const WRITTEN: Words = Words { en: "Written by moreau {0} on {1}.", zh: "由 moreau {0} 于 {1} 生成。" };
const AGAIN: Words = Words { en: "Make it again:", zh: "重新生成：" };

/// What a Chinese page says of the texts on it that stay English.
fn stays_english(view: &View) -> Option<&'static str> {
    let words = match view.file {
        "claims.html" => "不成立、自相矛盾或须附加条件的论断有中文陈述，排在英文之前；标题、其余陈述与更正为英文。",
        "errata.html" => "陈述、问题所在与更正为中文；标题为英文。",
        "systems.html" => "系统名称与被比较的物理量为英文。",
        "scoreboard.html" => "引擎的名称、检查名与未运行的原因为英文。",
        "problems.html" => "问题与定律的说明为英文。",
        "defects.html" => "各个错误的说明与检查名为英文。",
        "pictures.html" => "图中标注为英文。",
        file if file.starts_with("section-") => {
            "不成立、自相矛盾或须附加条件的论断有中文陈述、论证与更正，排在英文之前；其余论断的文字、标题、程序所得的结果、对照与来源为英文。"
        }
        _ => return None,
    };
    (view.language == Language::Chinese).then_some(words)
}

/// How the other language calls itself.
fn name(language: Language) -> &'static str {
    match language {
        Language::English => "English",
        Language::Chinese => "中文",
    }
}

/// A whole page.
pub fn document(view: &View, title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(view.language.tag()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) " – moreau" }
                link rel="stylesheet" href=(view.shared("style.css"));
            }
            body {
                a.skip href="#content" { (view.say(SKIP)) }
                (head(view))
                main #content tabindex="-1" { (body) }
                (foot(view))
            }
        }
    };
    page.into_string()
}

fn head(view: &View) -> Markup {
    let (other, twin) = view.twin();
    html! {
        header.top {
            nav aria-label=(view.say(PAGES)) {
                ul {
                    @for (file, words) in MENU {
                        li { a href=(file) aria-current=[(file == view.file).then_some("page")] { (view.say(words)) } }
                    }
                }
            }
            a.language href=(twin) lang=(other.tag()) hreflang=(other.tag()) { (name(other)) }
        }
    }
}

fn foot(view: &View) -> Markup {
    html! {
        footer {
            p { (view.say(QUOTED)) @if let Some(words) = stays_english(view) { (words) } }
            p {
                (view.tell(WRITTEN, &[&view.report.version, &view.report.day])) " "
                (view.say(AGAIN)) " " code { "moreau report --out FOLDER" }
            }
        }
    }
}
