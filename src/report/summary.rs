//! What `moreau simulate` says of a motion: its quantities with units, and what the certificate says of its steps.

use super::motion::{Quantity, lines};
use super::steps::StepSummary;
use super::text::Style;
use crate::number::{significant, with_unit};
use schemars::JsonSchema;
use serde::Serialize;

/// The summary of one motion.
#[derive(Serialize, JsonSchema)]
pub struct MotionSummary<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The scheme with its parameters.
    pub scheme: &'a str,
    /// The solver of its contact problems.
    pub solver: &'a str,
    /// What was changed of the scene for the scheme; absent where nothing was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<&'static str>,
    /// The closed form that the motion is held against, if the scene has one.
    pub closed_form: Option<&'static str>,
    /// Whether its e is 0 in place of the scene's, as the note says.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub plastic_form: bool,
    /// Penetration, energy, restitution and whatever else is defined for it.
    pub quantities: Vec<Quantity>,
    /// What is unusual about the motion, such as a penetration that is deep for the size of the body; absent where nothing is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// What the certificate says of the steps.
    pub steps: StepSummary,
    /// Whether the same command makes the same steps again.
    pub reproducible: bool,
    /// The step in which the motion ended before its time; absent where it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<Cut>,
}

/// Where a motion ended before its time: by the time limit, or because a step could not be made.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cut {
    /// The step that was being made, from 1; it is not kept, and those before it are.
    pub step: usize,
    /// How many steps were asked for.
    pub of: usize,
    /// The simulated time at which that step begins \[s\].
    pub time: f64,
    /// Why that step could not be made; absent where the time limit ended it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
}

impl Cut {
    /// For reading, in one sentence.
    pub fn text(&self) -> String {
        let Cut { step, of, time, cause } = self;
        let place = format!("in step {step} of {of}, at t = {}", with_unit(&significant(*time), "s"));
        match cause {
            Some(cause) => format!("ended {place}, which could not be made: {cause}"),
            None => format!("ended by the time limit {place}: that step is left out, and another run need not end there"),
        }
    }
}

impl MotionSummary<'_> {
    /// For reading.
    pub fn text(&self, style: Style) -> String {
        let form = self.closed_form.unwrap_or("none for this scene");
        let plastic = if self.plastic_form { ", with e = 0" } else { "" };
        let head = [
            format!("scene {}", self.scene),
            format!("scheme {}, solver {}", self.scheme, self.solver),
            format!("closed form: {form}{plastic}"),
        ];
        let line = |text: String| style.wrapped("", "  ", &text) + "\n";
        let head: String = head.into_iter().chain(self.note.map(|note| format!("note: {note}"))).map(line).collect();
        let cut: String = self.cut.iter().map(|cut| line(cut.text())).collect();
        head + &lines(&self.quantities) + &line(self.steps.text().trim_end().into()) + &cut
    }
}
