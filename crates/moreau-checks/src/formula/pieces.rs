//! A text in its pieces: prose, code between backticks, formulas between dollar signs.

use moreau_exact::{Error, Result};

/// One piece of a text, without its marks.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Piece {
    /// Words.
    Prose(String),
    /// What stood between two backticks.
    Code(String),
    /// TeX that stood between two dollar signs.
    Formula(String),
}

/// The pieces of a text, in which white space is one space.
pub(super) fn pieces(text: &str) -> Result<Vec<Piece>> {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut found = Vec::new();
    let mut rest = text.as_str();
    while let Some(at) = rest.find(['`', '$']) {
        let (before, marked) = rest.split_at(at);
        let mark = if marked.starts_with('`') { '`' } else { '$' };
        let (inside, after) =
            marked[1..].split_once(mark).ok_or_else(|| refused(&shortened(marked), format!("`{mark}` has no partner")))?;
        found.extend(prose(before)?);
        found.push(if mark == '`' { Piece::Code(inside.into()) } else { Piece::Formula(inside.into()) });
        rest = after;
    }
    found.extend(prose(rest)?);
    Ok(found)
}

fn prose(text: &str) -> Result<Option<Piece>> {
    match text.find('\\') {
        Some(at) => Err(refused(&shortened(&text[at..]), "a backslash in prose".into())),
        None => Ok((!text.is_empty()).then(|| Piece::Prose(text.into()))),
    }
}

/// A formula that cannot be read or written, and why.
pub(super) fn refused(formula: &str, problem: String) -> Error {
    Error::invalid(format!("${}$", formula.trim_matches('$')), problem, "TeX stands between two dollar signs, code between two backticks")
}

/// The beginning of a text.
fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}
