//! Scripts in Unicode: small letters where there are some, otherwise `_word`, `^{…}`.

/// Letters and their superscripts.
const ABOVE: (&str, &str) = ("0123456789+−=()TknabplNm′″", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ᵀᵏⁿᵃᵇᵖˡᴺᵐ′″");

/// Letters and their subscripts; a word, as in `v_free`, has none.
const BELOW: (&str, &str) = ("0123456789+−ij", "₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼ");

/// A superscript; a star and a circle stand as high by themselves.
pub(super) fn above(script: &str) -> String {
    match script {
        "*" => "*".into(),
        "∘" => "°".into(),
        "′′" => "″".into(),
        _ => small(script, ABOVE).unwrap_or_else(|| marked('^', script)),
    }
}

/// A subscript; the sign of infinity stands low by itself, `T∞`.
pub(super) fn below(script: &str) -> String {
    match script {
        "∞" => "∞".into(),
        _ => small(script, BELOW).unwrap_or_else(|| marked('_', script)),
    }
}

fn small(script: &str, (from, to): (&str, &str)) -> Option<String> {
    script.chars().map(|letter| from.chars().position(|known| known == letter).and_then(|at| to.chars().nth(at))).collect()
}

/// A word or one sign needs no braces.
fn marked(mark: char, script: &str) -> String {
    let scripts = |letter: char| ABOVE.1.contains(letter) || BELOW.1.contains(letter);
    let word = script.chars().all(|letter| letter.is_alphanumeric() && !scripts(letter)) || script.chars().count() == 1;
    if word { format!("{mark}{script}") } else { format!("{mark}{{{script}}}") }
}
