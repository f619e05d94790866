//! One picture of the site: the question that it answers, and how it is drawn.

use crate::words::{Language, Words};
use moreau_exact::Result;
use moreau_gate::trend::Origin;

/// What pictures show that others have measured.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// How fast a block creeps that should stick, engine by engine.
    pub creep: Vec<Creep>,
    /// How much work iterations need, law by law.
    pub work: Vec<Work>,
}

/// How fast a block creeps that should stick, in one engine.
#[derive(Clone, Debug)]
pub struct Creep {
    /// The engine in its configuration.
    pub engine: String,
    /// The program that it is.
    pub program: String,
    /// The steps, the largest first.
    pub steps: Vec<CreepStep>,
    /// How it depends on the step; none where it is nowhere more than a sound discretisation may make.
    pub trend: Option<CreepTrend>,
}

/// The creep at one time step.
#[derive(Clone, Copy, Debug)]
pub struct CreepStep {
    /// h \[s\].
    pub time_step: f64,
    /// The speed along the slope, downhill positive \[m/s\].
    pub speed: f64,
    /// What a sound discretisation may make \[m/s\].
    pub allowed: f64,
}

/// How creep depends on the step, as the gate fitted it.
#[derive(Clone, Copy, Debug)]
pub struct CreepTrend {
    /// p of speed ≈ C h^p.
    pub order: f64,
    /// What follows from it.
    pub origin: Origin,
}

/// How much work iterations need for the problems of some laws: the part of them answered with at most τ times the least work of any.
#[derive(Clone, Debug)]
pub struct Work {
    /// The laws, in a few English words.
    pub laws: String,
    /// How many problems.
    pub problems: usize,
    /// Each solver's name, and the part \[1\] at each factor τ \[1\].
    pub profiles: Vec<(String, Vec<[f64; 2]>)>,
}

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
    /// The picture as the text of an SVG file; [`Picture::svg`] adds what a screen reader says. Most need nothing of what is given.
    pub draw: fn(&Given) -> Result<String>,
}

impl Picture {
    /// The picture with question and caption as `title` and `desc` in a language, ready to stand in a page beside others.
    ///
    /// # Errors
    /// Those of [`Picture::draw`].
    pub fn svg(&self, given: &Given, language: Language) -> Result<String> {
        let (id, drawn) = (self.id, (self.draw)(given)?);
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
