//! A page in one language: its fixed texts, its links, and which words on it are of the other language.

use super::data::Report;
use super::prose::{prose, with_code};
use crate::{Language, Words};
use maud::{Markup, html};

/// A page to be written: the report, the language, and the page's file.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// What is shown.
    pub report: &'a Report<'a>,
    /// In which language.
    pub language: Language,
    /// The file, the same in both languages.
    pub file: &'a str,
}

impl View<'_> {
    /// A fixed text.
    pub fn say(&self, words: Words) -> &'static str {
        words.of(self.language)
    }

    /// A fixed text in which `{0}`, `{1}`, … stand for these parts.
    pub fn tell(&self, words: Words, parts: &[&dyn std::fmt::Display]) -> String {
        parts.iter().enumerate().fold(self.say(words).to_string(), |text, (k, part)| text.replace(&format!("{{{k}}}"), &part.to_string()))
    }

    /// English prose; on a Chinese page it is marked as English.
    pub fn english(&self, text: &str) -> Markup {
        let words = prose(text);
        match self.language {
            Language::English => words,
            Language::Chinese => html! { span lang="en" { (words) } },
        }
    }

    /// English prose without formulas, whose letters are as they are.
    pub fn letters(&self, text: &str) -> Markup {
        let words = with_code(text);
        match self.language {
            Language::English => words,
            Language::Chinese => html! { span lang="en" { (words) } },
        }
    }

    /// Words of the chapter; on an English page they are marked as Chinese.
    pub fn chinese(&self, text: &str) -> Markup {
        let words = prose(&plain(text));
        match self.language {
            Language::English => html! { span lang=(Language::Chinese.tag()) { (words) } },
            Language::Chinese => words,
        }
    }

    /// A link from this page to a file that both languages share.
    pub fn shared(&self, file: &str) -> String {
        match self.language {
            Language::English => file.into(),
            Language::Chinese => format!("../{file}"),
        }
    }

    /// A link from this page to the same page in the other language.
    pub fn twin(&self) -> (Language, String) {
        match self.language {
            Language::English => (Language::Chinese, format!("{CHINESE}/{}", self.file)),
            Language::Chinese => (Language::English, format!("../{}", self.file)),
        }
    }

    /// A link to a claim.
    pub fn to_claim(&self, id: &str) -> Markup {
        match self.report.claim(id) {
            Some(claim) => html! { a.id href={ (section_file(&claim.group)) "#" (id) } { (id) } },
            None => html! { code { (id) } },
        }
    }

    /// Links to claims.
    pub fn to_claims<'i>(&self, ids: impl Iterator<Item = &'i str>) -> Markup {
        html! { @for (k, id) in ids.enumerate() { @if k > 0 { ", " } (self.to_claim(id)) } }
    }

    /// A table in a box that scrolls by itself, so that the page stays as wide as the screen.
    pub fn scrolled(&self, name: &str, table: &Markup) -> Markup {
        html! { div.scroll role="region" aria-label=(name) tabindex="0" { (table) } }
    }
}

/// The folder of the Chinese pages.
const CHINESE: &str = "zh";

/// The path of a page in a language.
pub fn path(file: &str, language: Language) -> String {
    match language {
        Language::English => file.into(),
        Language::Chinese => format!("{CHINESE}/{file}"),
    }
}

/// The file of a section's page.
pub fn section_file(group: &str) -> String {
    format!("section-{group}.html")
}

/// Words of the chapter without the stars of their headings, with its marks of formulas as they are elsewhere.
fn plain(text: &str) -> String {
    text.replace(['⭐', '\u{fe0f}'], "").replace("\\(", "$").replace("\\)", "$").trim().into()
}
