//! Scripts in Unicode: small letters where there are some, otherwise `_word`, `^{…}`.

/// Letters and their superscripts.
const ABOVE: (&str, &str) = ("0123456789+−=()TknabplNm′″", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ᵀᵏⁿᵃᵇᵖˡᴺᵐ′″");

/// Letters and their subscripts; a word, as in `v_free`, has none.
const BELOW: (&str, &str) = ("0123456789+−ij", "₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼ");

/// A superscript.
pub(super) fn above(script: &str) -> String {
    small(script, ABOVE).unwrap_or_else(|| marked('^', script))
}

/// A subscript.
pub(super) fn below(script: &str) -> String {
    small(script, BELOW).unwrap_or_else(|| marked('_', script))
}

fn small(script: &str, (from, to): (&str, &str)) -> Option<String> {
    script.chars().map(|letter| from.chars().position(|known| known == letter).and_then(|at| to.chars().nth(at))).collect()
}

fn marked(mark: char, script: &str) -> String {
    let word = script.chars().all(char::is_alphanumeric) || script.chars().count() == 1;
    if word { format!("{mark}{script}") } else { format!("{mark}{{{script}}}") }
}
