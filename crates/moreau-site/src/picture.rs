//! One picture of the site: the question that it answers, and how it is drawn.

use crate::{Language, Words};
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
    /// A command that makes its numbers again, or those of the same experiment.
    pub command: &'static str,
    /// The claims that it illustrates.
    pub claims: &'static [&'static str],
    /// The picture as the text of an SVG file; [`Picture::svg`] adds what a screen reader says.
    pub draw: fn() -> Result<String>,
}

impl Picture {
    /// The picture with question and caption as `title` and `desc` in a language, ready to stand in a page beside others.
    ///
    /// # Errors
    /// Those of [`Picture::draw`].
    pub fn svg(&self, language: Language) -> Result<String> {
        let (id, drawn) = (self.id, (self.draw)()?);
        let head = format!("<svg role=\"img\" lang=\"{}\" aria-labelledby=\"{id}-title {id}-desc\" ", language.tag());
        let words = format!(
            "<title id=\"{id}-title\">{}</title><desc id=\"{id}-desc\">{}</desc><rect ",
            escaped(self.question.of(language)),
            escaped(self.caption.of(language))
        );
        Ok(drawn.replacen("<svg ", &head, 1).replacen("<rect ", &words, 1))
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
