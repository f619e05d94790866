//! How text for a terminal is marked, and broken into lines.

use maud::{Markup, html};
pub use moreau_exact::number::counted;
use textwrap::core::display_width;
use textwrap::{Options, WordSplitter, fill};
use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

/// A text as a search compares it: as a keyboard types it, in small letters, without accents, with its plain dash and quotes.
///
/// ```
/// use moreau_checks::text::folded;
///
/// assert_eq!(folded("Stewart–Trinkle, Painlevé’s"), "stewart-trinkle, painleve's");
/// ```
pub fn folded(text: &str) -> String {
    let plain = |letter| match letter {
        '\u{2010}'..='\u{2015}' | '\u{2212}' => '-',
        '‘' | '’' => '\'',
        '“' | '”' => '"',
        other => other,
    };
    text.nfkd().filter(|letter| !is_combining_mark(*letter)).map(plain).collect::<String>().to_lowercase()
}

/// Whether to mark text with terminal colours, and where lines end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// False for pipes, files and `NO_COLOR`.
    pub colour: bool,
    /// Columns; a word that is longer than a line is not broken.
    pub width: usize,
}

impl Style {
    /// Without colours, in lines of 120 columns: what pipes and files get.
    pub const PLAIN: Style = Style { colour: false, width: 120 };

    fn paint(self, code: &str, text: &str) -> String {
        if self.colour { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.into() }
    }

    /// A heading.
    pub fn heading(self, text: &str) -> String {
        self.paint("1", text)
    }

    /// Something that is wrong with what is shown.
    pub fn alarm(self, text: &str) -> String {
        self.paint("1;31", text)
    }

    /// A verdict that says yes.
    pub fn yes(self, text: &str) -> String {
        self.paint("32", text)
    }

    /// A verdict with a reservation.
    pub fn reserved(self, text: &str) -> String {
        self.paint("33", text)
    }

    /// A verdict that says no.
    pub fn no(self, text: &str) -> String {
        self.paint("31", text)
    }

    /// What is beside the point.
    pub fn faint(self, text: &str) -> String {
        self.paint("2", text)
    }

    /// Breaks text at spaces into lines of this width, the first of which begins with `first` and the others with `next`; its own line
    /// breaks stay. Colours take no room.
    pub fn wrapped(self, first: &str, next: &str, text: &str) -> String {
        let options = Options::new(self.width.max(1)).initial_indent(first).subsequent_indent(next).break_words(false);
        fill(text, options.word_splitter(WordSplitter::NoHyphenation))
    }

    /// Breaks the lines of a text that are wider than this at spaces; what follows stands four columns farther in. Other lines stay.
    pub fn fitted(self, text: &str) -> String {
        let fit = |line: &str| {
            let body = line.trim_start();
            let indent = &line[..line.len() - body.len()];
            if display_width(line) <= self.width { line.into() } else { self.wrapped(indent, &format!("{indent}    "), body) }
        };
        text.lines().map(|line| fit(line) + "\n").collect()
    }
}

/// A piece of code on a page.
pub fn code(text: &str) -> Markup {
    html! { code { (text) } }
}

/// A text in which what stands between two backticks is code.
pub fn with_code(text: &str) -> Markup {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return html! { (text) };
    }
    html! {
        @for (k, part) in parts.iter().enumerate() {
            @if k % 2 == 1 { (code(part)) } @else { (part) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_spaces_within_the_width_and_ids_stay_whole() {
        let text = "the matrix of S4.copos-plus is copositive-plus ".repeat(9);
        for width in [40, 80, 120] {
            let wrapped = Style { width, ..Style::PLAIN }.wrapped("* ", "    ", &text);
            assert!(wrapped.lines().count() > 2 && wrapped.lines().all(|line| line.chars().count() <= width), "{wrapped}");
            assert!(wrapped.starts_with("* the") && wrapped.lines().skip(1).all(|line| line.starts_with("    ")), "{wrapped}");
            assert_eq!(wrapped.matches("S4.copos-plus").count(), 9, "{wrapped}");
        }
        assert_eq!(Style { width: 4, ..Style::PLAIN }.wrapped("", "", "a\nb longword"), "a\nb\nlongword");
    }

    #[test]
    fn only_lines_that_are_too_wide_are_broken() {
        let text = "  name   1.5 m   at most 2 m\n  x   1\n\n";
        assert_eq!(Style { width: 40, ..Style::PLAIN }.fitted(text), text);
        assert_eq!(Style { width: 20, ..Style::PLAIN }.fitted(text), "  name   1.5 m   at\n      most 2 m\n  x   1\n\n");
    }

    #[test]
    fn colours_take_no_room_and_are_left_out_where_they_are_not_wanted() {
        let coloured = Style { colour: true, width: 11 };
        assert_eq!(coloured.yes("true"), "\u{1b}[32mtrue\u{1b}[0m");
        assert_eq!(coloured.wrapped("", "", &format!("{} is right", coloured.no("a"))), "\u{1b}[31ma\u{1b}[0m is right");
        let plain = Style::PLAIN;
        for painted in [plain.heading("x"), plain.alarm("x"), plain.yes("x"), plain.reserved("x"), plain.no("x"), plain.faint("x")] {
            assert_eq!(painted, "x");
        }
    }

    #[test]
    fn backticks_become_code_and_nothing_else_becomes_markup() {
        assert_eq!(with_code("a `b <i>` c & d").into_string(), "a <code>b &lt;i&gt;</code> c &amp; d");
        assert_eq!(with_code("one ` alone").into_string(), "one ` alone");
    }
}
