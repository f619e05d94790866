//! Texts that come from claims, engines and files: escaped, with code between backticks and formulas between dollar signs.

use maud::{Markup, PreEscaped};
use moreau_checks::formula;
use moreau_checks::text::with_code;

/// A text as markup. What is no formula although it has the marks of one – a path with a backslash, a price – stays as it is.
pub fn prose(text: &str) -> Markup {
    formula::html(text).map_or_else(|_| with_code(text), short)
}

/// Markup without attributes that say what holds without them: thousands of formulas stand on the pages.
fn short(markup: Markup) -> Markup {
    let text = markup.into_string();
    PreEscaped(
        text.replace("<math display=\"inline\">", "<math>").replace(" symmetric=\"false\" stretchy=\"false\"", " stretchy=\"false\""),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_mathml_and_what_is_none_stays_as_it_is() {
        assert!(prose("the gap $x_1$").into_string().contains("<math"));
        assert_eq!(prose(r"C:\new `a<b` & $5").into_string(), r"C:\new <code>a&lt;b</code> &amp; $5");
        assert_eq!(prose("one ` alone").into_string(), "one ` alone");
    }
}
