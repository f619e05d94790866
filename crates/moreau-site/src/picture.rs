//! One picture of the site: the question that it answers, and how it is drawn.

use crate::Words;
use moreau_exact::Result;

/// A picture with what a reader needs to trust it.
pub struct Picture {
    /// Name of its file and anchor, `ball-through-zeno`.
    pub id: &'static str,
    /// The question that it answers, which is its title.
    pub question: Words,
    /// What is seen, and what follows from it.
    pub caption: Words,
    /// How its numbers were obtained.
    pub obtained: Words,
    /// A command that makes its numbers again.
    pub command: &'static str,
    /// The claims that it illustrates.
    pub claims: &'static [&'static str],
    /// The picture as the text of an SVG file.
    pub draw: fn() -> Result<String>,
}
