//! A row of the table: a claim, what it asks of what, what is expected, and what each control asks instead.

use super::query::{Keys, Query};
use super::release::Release;
use crate::checks::Voice;

/// What a look-up is expected to find.
#[derive(Clone, Copy, Debug)]
pub enum Wanted {
    /// Whether all that is asked for is there.
    Decision(bool),
    /// How many.
    Count(usize),
    /// A number, with its unit.
    Number(f64, &'static str),
    /// The number that is stated at these keys of what the row asks.
    At(Keys),
    /// A fraction.
    Fraction(i64, i64),
}

/// What the chapter says of the instance, where that is not what is expected.
#[derive(Clone, Copy, Debug)]
pub enum Says {
    /// This number; of a decision, 1 for true.
    Is(usize),
    /// At least this number.
    AtLeast(usize),
}

/// What is asked in place of what the row asks.
#[derive(Clone, Copy, Debug)]
pub enum Instead {
    /// Under the control with this place.
    Under(usize, Release, Query),
    /// Under every control.
    Always(Release, Query),
}

/// A fact that is looked up.
#[derive(Clone, Copy, Debug)]
pub struct LookUp {
    /// The claim whose finding it is.
    pub claim: &'static str,
    /// Name of the finding.
    pub name: &'static str,
    /// Of what it is asked.
    pub of: Release,
    /// What is asked.
    pub query: Query,
    /// What is expected, whatever a control asks.
    pub wanted: Wanted,
    /// What the chapter says instead.
    pub says: Option<Says>,
    /// The condition that the chapter omits and that is violated here.
    pub violated: Option<&'static str>,
    /// Who says it.
    pub voice: Voice,
    /// Whether it decides nothing.
    pub beside: bool,
    /// What the controls ask.
    pub controls: &'static [Instead],
}

impl LookUp {
    /// A row of which the chapter says what is expected, and of which no control asks anything else.
    pub const fn new(claim: &'static str, name: &'static str, of: Release, query: Query, wanted: Wanted) -> Self {
        let (says, violated, voice) = (None, None, Voice::Sentence);
        LookUp { claim, name, of, query, wanted, says, violated, voice, beside: false, controls: &[] }
    }

    /// The row with what the controls ask.
    pub const fn controls(self, controls: &'static [Instead]) -> Self {
        LookUp { controls, ..self }
    }

    /// The row with what the chapter says.
    pub const fn says(self, says: Says) -> Self {
        LookUp { says: Some(says), ..self }
    }

    /// The row with the condition that the chapter omits.
    pub const fn violating(self, condition: &'static str) -> Self {
        LookUp { violated: Some(condition), ..self }
    }

    /// The row as one reading of the sentence.
    pub const fn reading(self, reading: &'static str) -> Self {
        LookUp { voice: Voice::Reading(reading), ..self }
    }

    /// The row as an opinion on this point.
    pub const fn opinion(self, point: &'static str) -> Self {
        LookUp { voice: Voice::Opinion(point), ..self }
    }

    /// The row as one that decides nothing.
    pub const fn context(self) -> Self {
        LookUp { beside: true, ..self }
    }
}
