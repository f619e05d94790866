//! A simulated motion as one self-contained HTML page: the bodies in space with a time slider, contacts and impulses, and what the
//! certificate says of every step. The page needs no other file and works from a disk.

mod acting;
mod data;

use super::gate::frame::{VERSION, document, scrolled};
use super::motion::{MotionReport, Quantity};
use super::quantity::shown;
use super::summary::MotionSummary;
use crate::Result;
use crate::number::{significant, with_unit};
use crate::scenes::Scene;
use data::{DIGITS, Data, MOST_SAMPLES};
use maud::{Markup, PreEscaped, html};

/// What draws the motion; it reads what [`Data`] writes.
const PLAYER: &str = include_str!("player.js");

/// What the style of all pages does not have.
const STYLE: &str = include_str!("style.css");

/// Speeds of the player, times real time.
const SPEEDS: [&str; 10] = ["0.001", "0.01", "0.05", "0.1", "0.25", "0.5", "1", "2", "5", "10"];

/// More bodies than this are not offered to be followed, and are listed folded.
const FEW: usize = 24;

/// A motion, the scene that it is of, and what the command says of it.
pub struct MotionPage<'a> {
    /// The motion.
    pub motion: &'a MotionReport<'a>,
    /// The scene.
    pub scene: &'a Scene,
    /// What the command prints.
    pub summary: &'a MotionSummary<'a>,
}

impl MotionPage<'_> {
    /// The page.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] if a body of the scene has no shape.
    pub fn html(&self) -> Result<String> {
        let data = Data::new(self.motion, self.scene)?;
        let json = data.json()?;
        let (scene, summary) = (self.scene, self.summary);
        let body = html! {
            main {
                h1 { (scene.name) }
                @if !scene.description.is_empty() { p { (scene.description) } }
                p.meta {
                    "Scheme " (summary.scheme) ", solver " (summary.solver) ", h = "
                    (with_unit(&significant(self.motion.recording.time_step), "s")) ". Computed by moreau " (VERSION) "."
                }
                p class={ "steps " (self.verdict()) } { (summary.steps.text().trim_end()) "." }
                @if let Some(cut) = &summary.cut { p.steps.fail { (cut.text()) "." } }
                @if let Some(note) = summary.note { p { "Note: " (note) "." } }
                @for remark in &summary.remarks { p { "Remark: " (remark) } }
                noscript { p.fail { "The motion is drawn by a script, which this browser does not run. The numbers below need none." } }
                (stage())
                (controls(scene, data.samples()))
                (readings())
                (legend(scene))
                (numbers(&summary.quantities))
                (notes(&data))
            }
            script type="application/json" id="data" { (PreEscaped(json)) }
            script { (PreEscaped(PLAYER)) }
        };
        Ok(document(&format!("{}, {}", scene.name, summary.scheme), STYLE, &body))
    }

    /// The colour of the sentence about the steps.
    fn verdict(&self) -> &'static str {
        match &self.summary.steps {
            steps if steps.rejected > 0 => "fail",
            steps if steps.unconverged > 0 => "difference",
            _ => "pass",
        }
    }
}

/// The picture and what moves the eye.
fn stage() -> Markup {
    html! {
        div.stage {
            canvas #view tabindex="0" role="application" aria-label="The motion, drawn in space" aria-describedby="keys" {}
            div.eye {
                button #nearer type="button" aria-label="Nearer" { "+" }
                button #farther type="button" aria-label="Farther" { "−" }
                button #home type="button" aria-label="See all" { "⌂" }
            }
            p.grid #grid {}
        }
    }
}

/// What moves the time.
fn controls(scene: &Scene, samples: usize) -> Markup {
    html! {
        div.controls role="group" aria-label="Time" {
            button #play type="button" { "Play" }
            button #back type="button" aria-label="One sample back" { "‹" }
            button #on type="button" aria-label="One sample on" { "›" }
            label { "speed " select #speed {
                @for speed in SPEEDS { option value=(speed) selected[speed == "1"] { (speed) " ×" } }
            } }
            @if scene.bodies.len() <= FEW {
                label { "follow " select #follow {
                    option value="-1" { "nothing" }
                    @for (k, body) in scene.bodies.iter().enumerate() { option value=(k) { (body.name) } }
                } }
            }
        }
        label.time for="time" { "time" }
        input #time type="range" min="0" max=(samples - 1) step="1" value="0";
        canvas #strip aria-hidden="true" {}
    }
}

/// The numbers of the sample that is shown.
fn readings() -> Markup {
    html! {
        dl.readings {
            div { dt { "time" } dd #t {} }
            div { dt { "energy" } dd #energy {} }
            div { dt { "certificate" } dd #certificate {} }
        }
        h2 { "Contacts" }
        p #none {}
        div #contacts { (scrolled("The largest impulses since the sample before", &html! {
            table {
                thead { tr { th { "bodies" } th { "normal [N·s]" } th { "tangential [N·s]" } } }
                tbody #rows {}
            }
        })) }
    }
}

/// The colours of the bodies; the program puts them in.
fn legend(scene: &Scene) -> Markup {
    let kind = |body: &crate::scenes::Body| match (body.is_static, body.prescribed) {
        (true, _) => " (static)",
        (_, Some(_)) => " (moves as prescribed)",
        _ => "",
    };
    html! {
        details open[scene.bodies.len() <= FEW] {
            summary { "Bodies" }
            ul.legend { @for body in &scene.bodies { li { span.swatch {} (body.name) (kind(body)) } } }
        }
    }
}

fn numbers(quantities: &[Quantity]) -> Markup {
    html! {
        details {
            summary { "Numbers of the whole motion" }
            table {
                @for one in quantities {
                    @if let Some(value) = one.value { tr { th scope="row" { (one.name) } td.n { (shown(value, one.unit, one.rounding)) } } }
                }
            }
        }
    }
}

/// How to use the page, and what its numbers are.
fn notes(data: &Data) -> Markup {
    let thinned = match data.every {
        1 => "Every step is shown.".to_string(),
        every => format!(
            "Of {} steps every {every}th is shown, and the last one, for a page has at most {MOST_SAMPLES} samples, fewer of many bodies; \
                impulses are added up, and the certificate is the worst, since the sample before.",
            data.steps
        ),
    };
    html! {
        details {
            summary { "How to use this page" }
            p #keys {
                "Drag to turn, with Shift or two fingers to move; the wheel, two fingers or + and − to come nearer. On the picture the \
                    arrow keys turn, + and − come nearer, 0 shows all, the space bar plays and halts, comma and point go one sample back \
                    and on."
            }
            p {
                "An arrow is the impulse of a contact on the body named first, drawn from the point where it acts, through all bodies. \
                    Its length grows as the square root of the impulse."
            }
        }
        p.meta { (thinned) " Numbers have " (DIGITS) " significant digits, those of the command." }
    }
}

#[cfg(test)]
mod tests;
