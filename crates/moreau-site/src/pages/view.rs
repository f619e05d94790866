//! A page in one language: its fixed texts, its links, and which words on it are of the other language.

use super::data::{ClaimEntry, Report};
use super::prose::{breakable, prose};
use crate::words::{Language, Words};
use maud::{Markup, html};
use moreau_checks::text::with_code;

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

    /// What a claim is about, for lists: on a Chinese page the beginning of the Chinese sentence where there is one.
    pub fn title(&self, claim: &ClaimEntry) -> Markup {
        match (&claim.erratum, self.language) {
            (Some(erratum), Language::Chinese) => self.chinese(&breakable(&beginning(&erratum.says))),
            _ => self.english(&breakable(&claim.title)),
        }
    }

    /// What stands between a label and what it labels.
    pub fn colon(&self) -> &'static str {
        self.say(Words { en: ": ", zh: "：" })
    }

    /// What stands between the parts of a list.
    pub fn comma(&self) -> &'static str {
        self.say(Words { en: ", ", zh: "、" })
    }

    /// What ends a sentence before another one.
    pub fn stop(&self) -> &'static str {
        self.say(Words { en: ". ", zh: "。" })
    }

    /// Something in parentheses, after a word.
    pub fn aside(&self, text: &dyn std::fmt::Display) -> String {
        self.tell(Words { en: " ({0})", zh: "（{0}）" }, &[text])
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
    pub fn claim_link(&self, id: &str) -> Markup {
        match self.report.claim(id) {
            Some(claim) => html! { a.id href={ (section_file(&claim.group)) "#" (id) } { (id) } },
            None => html! { code { (id) } },
        }
    }

    /// Links to claims.
    pub fn claim_links<'i>(&self, ids: impl Iterator<Item = &'i str>) -> Markup {
        html! { @for (k, id) in ids.enumerate() { @if k > 0 { (self.comma()) } (self.claim_link(id)) } }
    }

    /// A table in a box that scrolls by itself, so that the page stays as wide as the screen.
    pub fn scrolled(&self, name: &str, table: &Markup) -> Markup {
        html! { div.scroll role="region" aria-label=(name) tabindex="0" { (table) } }
    }

    /// The same for a table that is printed across the paper's longer side.
    pub fn scrolled_wide(&self, name: &str, table: &Markup) -> Markup {
        html! { div.scroll.wide role="region" aria-label=(name) tabindex="0" { (table) } }
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

/// After how many characters outside of formulas a title is cut.
const LONGEST: usize = 30;

/// A sentence up to its first full stop or semicolon, or cut after [`LONGEST`] characters, but in no formula and in no word of letters.
fn beginning(sentence: &str) -> String {
    let (mut in_formula, mut count, mut before) = (false, 0, ' ');
    for (at, letter) in sentence.char_indices() {
        let in_word = before.is_ascii_alphanumeric() && (letter.is_ascii_alphanumeric() || letter == '-');
        if !in_formula && (['。', '；'].contains(&letter) || count >= LONGEST && !in_word) {
            let rest = sentence[at..].trim_start_matches(['。', '；']);
            let end = if rest.is_empty() { "" } else { "…" };
            return format!("{}{end}", sentence[..at].trim_end_matches(['，', '：', '、', '（', ' ']));
        }
        in_formula ^= letter == '$';
        count += usize::from(!in_formula);
        before = letter;
    }
    sentence.into()
}

/// Words of the chapter without the stars of their headings and of bold words, with its marks of formulas as they are elsewhere.
fn plain(text: &str) -> String {
    text.replace(['⭐', '\u{fe0f}'], "").replace("**", "").replace("\\(", "$").replace("\\)", "$").trim().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_ends_with_its_sentence_and_is_cut_in_no_formula() {
        assert_eq!(beginning("短句。"), "短句");
        assert_eq!(beginning("短句；后半句。"), "短句…");
        let formula = format!("${}；$", "x".repeat(LONGEST));
        assert_eq!(beginning(&format!("{formula}之后；长")), format!("{formula}之后…"));
        let cut = "长".repeat(LONGEST);
        assert_eq!(beginning(&format!("{cut}长")), format!("{cut}…"));
        assert_eq!(beginning(&format!("{}copositive 矩阵", &cut[3..])), format!("{}copositive…", &cut[3..]));
    }
}
