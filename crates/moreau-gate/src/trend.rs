//! How a deviation from the ideal depends on the time step: where it comes from.
//!
//! ```text
//!     |value − ideal| ≈ C h^p      p ≈ 0   the model: refining the step does not help
//!                                  p > ¼   the discretisation: it vanishes with h
//!                                  else    irregular: look at the solver
//! ```

use crate::tolerance::CONSTANT_ORDER;
use crate::{StepOutcome, Verdict};
use moreau_dynamics::trajectory::order::{Refinement, fit_order};
use moreau_exact::number::significant;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A deviation over the sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Trend {
    /// What was measured.
    pub quantity: String,
    /// The fitted order p.
    pub order: f64,
    /// Largest minus smallest order between neighbouring steps.
    pub spread: f64,
    /// Where the deviation comes from.
    pub cause: Origin,
    /// The largest step \[s\] at which it is more than a sound discretisation may make, and how many times that; absent if it nowhere is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excess: Option<[f64; 2]>,
}

/// Where a deviation comes from, by its dependence on h.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Cause")]
pub enum Origin {
    /// Independent of h.
    Model,
    /// Vanishes with h.
    Discretisation,
    /// Neither.
    Irregular,
}

/// The trends of the quantities that deviate at some step, in the order in which they were measured.
pub fn trends(steps: &[StepOutcome]) -> Vec<Trend> {
    let mut quantities: Vec<&str> = Vec::new();
    for one in steps.iter().flat_map(|step| &step.measurements) {
        if matches!(one.verdict(), Verdict::Difference | Verdict::Fail) && !quantities.contains(&one.quantity.as_str()) {
            quantities.push(&one.quantity);
        }
    }
    quantities.into_iter().filter_map(|quantity| trend(quantity, steps)).collect()
}

fn trend(quantity: &str, steps: &[StepOutcome]) -> Option<Trend> {
    let mut levels: Vec<Refinement> = Vec::new();
    for step in steps {
        let measured = step.measurements.iter().find(|one| one.quantity == quantity)?;
        levels.push(Refinement { time_step: step.time_step?, error: measured.ideal.miss(measured.value) });
    }
    levels.sort_by(|a, b| a.time_step.total_cmp(&b.time_step));
    let three = levels.len() >= 3;
    let fit = fit_order(levels).ok().filter(|_| three)?;
    let slopes = fit.levels.windows(2).map(|pair| (pair[1].error / pair[0].error).ln() / (pair[1].time_step / pair[0].time_step).ln());
    let slopes: Vec<f64> = slopes.collect();
    let cause = if slopes.iter().all(|slope| slope.abs() <= CONSTANT_ORDER) {
        Origin::Model
    } else if slopes.iter().all(|slope| *slope > CONSTANT_ORDER) {
        Origin::Discretisation
    } else {
        Origin::Irregular
    };
    Some(Trend { quantity: quantity.into(), order: fit.slope, spread: fit.spread, cause, excess: excess(quantity, steps) })
}

/// [h, deviation/allowance] of the largest step at which the quantity fails.
fn excess(quantity: &str, steps: &[StepOutcome]) -> Option<[f64; 2]> {
    let failing = |step: &StepOutcome| {
        let one = step.measurements.iter().find(|one| one.quantity == quantity && one.verdict() == Verdict::Fail)?;
        let expectation = one.model.as_ref().unwrap_or(&one.ideal);
        Some([step.time_step?, expectation.miss(one.value) / expectation.tolerance])
    };
    steps.iter().filter_map(failing).max_by(|a, b| a[0].total_cmp(&b[0]))
}

impl std::fmt::Display for Trend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.cause {
            Origin::Model => write!(f, "{}: independent of h (order {:.2}), as an error of the model is", self.quantity, self.order),
            Origin::Discretisation => {
                write!(f, "{}: vanishes with h (order {:.2}), as an error of the discretisation does", self.quantity, self.order)
            }
            Origin::Irregular => write!(f, "{}: irregular in h (order {:.2}, spread {:.2})", self.quantity, self.order, self.spread),
        }?;
        let Some([h, times]) = self.excess else { return Ok(()) };
        write!(f, "; at h = {} s it is {} times what is allowed there", significant(h), significant(times))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Expectation, Measurement};

    fn cause(value: fn(f64) -> f64) -> Option<Origin> {
        let step = |h: f64| StepOutcome::new(Some(h), Ok(vec![Measurement::new("x", "m", value(h), Expectation::equal(0.0, 0.0, ""))]));
        trends(&[0.1, 0.01, 0.001].map(step)).first().map(|trend| trend.cause)
    }

    #[test]
    fn no_cause_stands_beside_a_failure_without_how_far_it_is_from_what_is_allowed() {
        let step = |h: f64| StepOutcome::new(Some(h), Ok(vec![Measurement::new("x", "m", 3.0 * h, Expectation::equal(0.0, h.sqrt(), ""))]));
        let told = |steps: [f64; 3]| trends(&steps.map(step)).first().map(ToString::to_string);
        let text = told([0.25, 0.01, 0.001]).expect("fails at the largest step");
        assert!(text.contains("order 1.00") && text.ends_with("; at h = 0.25 s it is 1.5 times what is allowed there"), "{text}");
        assert_eq!(told([0.1, 0.01, 0.001]), None);
        for steps in [[0.16, 0.25, 0.001], [0.25, 0.16, 0.001]] {
            let text = told(steps).expect("fails at two steps");
            assert!(
                text.ends_with("; at h = 0.25 s it is 1.5 times what is allowed there"),
                "the largest step, wherever it stands: {text}"
            );
        }
    }

    #[test]
    fn a_deviation_is_told_by_its_order() {
        assert_eq!(cause(|_| 2.0), Some(Origin::Model));
        assert_eq!(cause(|h| 3.0 * h), Some(Origin::Discretisation));
        assert_eq!(cause(f64::sqrt), Some(Origin::Discretisation));
        assert_eq!(cause(|h| if h > 0.05 { 1.0 } else { h }), Some(Origin::Discretisation));
        assert_eq!(cause(|h| if h < 0.005 { 1.0 } else { h }), Some(Origin::Irregular));
        assert_eq!(cause(|h| if h > 0.005 { 1.0 } else { h }), Some(Origin::Irregular), "constant between two steps only");
        assert_eq!(cause(|_| 0.0), None, "nothing deviates");
    }
}
