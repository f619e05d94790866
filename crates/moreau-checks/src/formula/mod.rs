//! Formulas in texts: TeX between dollar signs, as Unicode for a terminal and as MathML for a page.
//!
//! ```text
//! "the gap $\dot\varphi = J\,v$"  ──► prose, code, formula ──► events ──► "the gap φ̇ = J v"
//!                                                                   └───► "the gap <math>…</math>"
//! ```
//! Both renderers read the same events of one parser, `pulldown-latex`, which is why it was chosen: other libraries (`math-core`) give
//! MathML alone, and a second reader of TeX would be a second opinion of what a formula says.
//!
//! A text is prose; between two backticks stands code, taken as it is; between two dollar signs stands a formula, in ASCII. A dollar sign
//! or a backslash that is neither belongs into code. White space, line breaks included, is one space, so that a text may be a raw literal
//! of several lines.

mod accents;
mod events;
mod node;
mod pieces;
mod scripts;
mod spacing;
mod terminal;
#[cfg(test)]
mod tests;

use crate::text::code;
use maud::{Markup, PreEscaped, html as markup};
use moreau_exact::Result;
use pieces::{Piece, pieces};

/// The text for a terminal: every formula in Unicode, the backticks of code as they are.
///
/// ```
/// use moreau_checks::formula::unicode;
///
/// assert_eq!(unicode(r"$x^T M x \ge 0$ for $x \ge 0$")?, "xᵀMx ≥ 0 for x ≥ 0");
/// # Ok::<(), moreau_exact::Error>(())
/// ```
/// # Errors
/// A mark without its partner, a backslash in prose, a formula that is not TeX or that Unicode cannot write; the message names the
/// formula.
pub fn unicode(text: &str) -> Result<String> {
    pieces(text)?
        .iter()
        .map(|piece| match piece {
            Piece::Prose(prose) => Ok(prose.clone()),
            Piece::Code(code) => Ok(format!("`{code}`")),
            Piece::Formula(tex) => terminal::written(tex),
        })
        .collect()
}

/// The text for a page: prose escaped, code as code, every formula as MathML.
///
/// # Errors
/// A mark without its partner, a backslash in prose, a formula that is not TeX; the message names the formula.
pub fn html(text: &str) -> Result<Markup> {
    let pieces = pieces(text)?;
    let goes_on = |place: usize| matches!(pieces.get(place + 1), Some(Piece::Prose(prose)) if !prose.starts_with(' '));
    let parts = pieces
        .iter()
        .enumerate()
        .map(|(place, piece)| match piece {
            Piece::Prose(prose) => Ok(markup! { (prose) }),
            Piece::Code(text) => Ok(code(text)),
            Piece::Formula(tex) => {
                let formula = PreEscaped(events::mathml(tex)?);
                Ok(markup! { (formula) @if goes_on(place) { (WORD_JOINER) } })
            }
        })
        .collect::<Result<Vec<_>>>()?;
    Ok(markup! { @for part in parts { (part) } })
}

/// Keeps a comma on the line of the formula before it.
const WORD_JOINER: char = '\u{2060}';

/// The formulas of a text, in TeX.
///
/// # Errors
/// A mark without its partner, a backslash in prose.
pub fn formulas(text: &str) -> Result<Vec<String>> {
    Ok(pieces(text)?.into_iter().filter_map(|piece| if let Piece::Formula(tex) = piece { Some(tex) } else { None }).collect())
}
