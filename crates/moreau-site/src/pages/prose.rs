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

/// The same text with every formula in parts, one for each equals sign outside of braces: a line ends inside no formula, but between two.
///
/// Formulas with an environment or a pair of growing brackets stay whole, and texts with code or with a mark that has no partner.
pub fn breakable(text: &str) -> String {
    let parts: Vec<&str> = text.split('$').collect();
    if text.contains('`') || parts.len().is_multiple_of(2) {
        return text.into();
    }
    let is_cut = |k: usize, part: &str| k % 2 == 1 && !part.contains(r"\begin") && !part.contains(r"\left");
    let cut = |(k, part): (usize, &&str)| if is_cut(k, part) { chain(part) } else { (*part).into() };
    parts.iter().enumerate().map(cut).collect::<Vec<_>>().join("$")
}

/// A formula, cut before the second and every later equals sign outside of braces.
fn chain(formula: &str) -> String {
    let (mut depth, mut signs, mut cut) = (0_usize, 0, String::with_capacity(formula.len()));
    for letter in formula.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            '=' if depth == 0 => {
                signs += 1;
                cut.push_str(if signs > 1 { "$ $" } else { "" });
            }
            _ => {}
        }
        cut.push(letter);
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_of_equations_can_be_broken_and_nothing_else() {
        assert_eq!(breakable("so $q_{a=b} = 1 = 2 = 3$ m"), "so $q_{a=b} = 1 $ $= 2 $ $= 3$ m");
        assert_eq!(prose(&breakable("$x = 1 = 2$")).into_string().matches("<math").count(), 2);
        for whole in [
            "a = b = c",
            "$x = 1$",
            r"$\left( a = b = c \right)$",
            r"$\begin{matrix} a = b = c \end{matrix}$",
            "one $ = = alone",
            "`$a = b = c$`",
        ] {
            assert_eq!(breakable(whole), whole);
        }
    }

    #[test]
    fn formulas_become_mathml_and_what_is_none_stays_as_it_is() {
        assert!(prose("the gap $x_1$").into_string().contains("<math"));
        assert_eq!(prose(r"C:\new `a<b` & $5").into_string(), r"C:\new <code>a&lt;b</code> &amp; $5");
        assert_eq!(prose("one ` alone").into_string(), "one ` alone");
    }
}
