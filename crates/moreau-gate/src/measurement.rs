//! A measured number, what the ideal and the declared law expect of it, and the verdict that follows.
//!
//! ```text
//!     declared law predicts, value off the prediction      fail
//!     value as the ideal within its derived allowance       pass
//!     value as predicted, off the ideal                     documented difference
//!     value off the ideal, nothing predicted                fail
//! ```

pub use moreau_checks::Expectation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The verdict of a measurement or of a check, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The engine said that it cannot express the question.
    Unsupported,
    /// As Coulomb–Signorini demands, within the derived error of the discretisation.
    Pass,
    /// Not as Coulomb–Signorini demands, but as the engine's declared law predicts.
    Difference,
    /// The engine gave no answer where it should have.
    Errored,
    /// Neither.
    Fail,
}

impl Verdict {
    /// The word used in tables.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Unsupported => "unsupported",
            Verdict::Pass => "pass",
            Verdict::Difference => "difference",
            Verdict::Errored => "errored",
            Verdict::Fail => "fail",
        }
    }

    /// Whether a build should stop.
    pub fn is_bad(self) -> bool {
        matches!(self, Verdict::Errored | Verdict::Fail)
    }
}

/// One measured number with its expectations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measurement {
    /// What was measured; the same words at every time step.
    pub quantity: String,
    /// Its unit, `1` for pure numbers.
    pub unit: String,
    /// The measured value.
    pub value: f64,
    /// Half the range of the value over repeated, slightly perturbed runs; 0 if it was measured once.
    #[serde(default)]
    pub spread: f64,
    /// Coulomb–Signorini, with the derived error of a sound discretisation at this h.
    pub ideal: Expectation,
    /// What the engine's declared law predicts at this h, where it predicts anything else than the ideal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<Expectation>,
}

impl Measurement {
    /// A measured number that is compared with the ideal alone.
    pub fn new(quantity: impl Into<String>, unit: &str, value: f64, ideal: Expectation) -> Self {
        Measurement { quantity: quantity.into(), unit: unit.into(), value, spread: 0.0, ideal, model: None }
    }

    /// Adds the prediction of the declared law, if there is one.
    pub fn predicted(mut self, model: Option<Expectation>) -> Self {
        self.model = model;
        self
    }

    /// The verdict by the module's table.
    ///
    /// ```
    /// use moreau_checks::Expectation;
    /// use moreau_gate::{Measurement, Verdict};
    ///
    /// let creep = |value: f64| Measurement::new("creep", "m/s", value, Expectation::at_most(0.0, 1e-6, "Coulomb holds the block"));
    /// let declared = || Some(Expectation::equal(1e-3, 1e-5, "the declared law"));
    /// assert_eq!((creep(0.0).verdict(), creep(1e-3).verdict()), (Verdict::Pass, Verdict::Fail));
    /// assert_eq!(creep(1e-3).predicted(declared()).verdict(), Verdict::Difference); // documented
    /// assert_eq!(creep(0.0).predicted(declared()).verdict(), Verdict::Fail); // not as declared, though ideal
    /// ```
    pub fn verdict(&self) -> Verdict {
        match (&self.model, self.ideal.holds(self.value)) {
            (Some(model), _) if !model.holds(self.value) => Verdict::Fail,
            (_, true) => Verdict::Pass,
            (Some(_), false) => Verdict::Difference,
            (None, false) => Verdict::Fail,
        }
    }

    /// The modelling error: how far the declared law's own prediction is from the ideal.
    pub fn modelling_error(&self) -> f64 {
        self.model.as_ref().map_or(0.0, |model| self.ideal.miss(model.value))
    }

    /// What neither the declared law nor the ideal explains: solver and discretisation together.
    pub fn remainder(&self) -> f64 {
        self.model.as_ref().unwrap_or(&self.ideal).miss(self.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(value: f64, model: Option<f64>) -> Verdict {
        let ideal = Expectation::equal(0.0, 0.25, "ideal");
        Measurement::new("x", "m", value, ideal).predicted(model.map(|value| Expectation::equal(value, 0.25, "law"))).verdict()
    }

    #[test]
    fn the_four_rows_of_the_table_and_both_sides_of_each_boundary() {
        assert_eq!(measured(0.25, None), Verdict::Pass);
        assert_eq!(measured(0.26, None), Verdict::Fail);
        assert_eq!(measured(1.25, Some(1.0)), Verdict::Difference);
        assert_eq!(measured(1.26, Some(1.0)), Verdict::Fail);
        assert_eq!(measured(0.0, Some(1.0)), Verdict::Fail, "an engine must do what it declares, even where the ideal is better");
        assert_eq!(measured(0.2, Some(0.4)), Verdict::Pass);
    }

    #[test]
    fn what_remains_is_what_the_declared_law_leaves_and_without_one_what_the_ideal_leaves() {
        let ideal = Expectation::equal(0.0, 0.25, "ideal");
        let plain = Measurement::new("x", "m", 1.25, ideal);
        let lawful = plain.clone().predicted(Some(Expectation::equal(1.0, 0.25, "law")));
        assert_eq!((plain.modelling_error(), plain.remainder()), (0.0, 1.25));
        assert_eq!((lawful.modelling_error(), lawful.remainder()), (1.0, 0.25));
    }

    #[test]
    fn what_is_not_finite_never_passes() {
        assert_eq!(measured(f64::NAN, None), Verdict::Fail);
        assert_eq!(measured(f64::INFINITY, None), Verdict::Fail);
    }
}
