//! Accents over one letter, composed as Unicode has them.

/// The combining mark of an accent of the parser.
fn combining(accent: char) -> Option<char> {
    Some(match accent {
        '˙' => '\u{307}',
        '¨' => '\u{308}',
        '^' => '\u{302}',
        '~' => '\u{303}',
        '‾' => '\u{304}',
        _ => return None,
    })
}

/// The letter with the accent; nothing where one of them is none.
pub(super) fn accented(base: &str, accent: char) -> Option<String> {
    let mark = combining(accent)?;
    let mut letters = base.chars();
    let (Some(letter), None) = (letters.next(), letters.next()) else { return None };
    Some(unicode_normalization::char::compose(letter, mark).map_or_else(|| format!("{letter}{mark}"), String::from))
}
