//! What is expected of a measured number: the one place that holds a number against a bound.
//!
//! ```text
//!     equal      |x − value| ≤ tolerance
//!     at most     x ≤ value + tolerance
//!     at least    x ≥ value − tolerance
//! ```
//! How much of a bound is used is 0 at its centre and 1 at its edge:
//! ```text
//!     equal      |x − value| / tolerance
//!     at most     x / limit  if limit > 0 ,    limit / x  if limit < 0 ,    limit = value + tolerance
//!     at least    the same of −x and −(value − tolerance)
//! ```

use crate::relation::Relation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An expected value or bound, the allowed deviation from it, and the reason for that allowance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Expectation {
    /// The expected value or bound.
    pub value: f64,
    /// The derived allowance.
    pub tolerance: f64,
    /// How the measured value must relate to the expected one: equal, at most or at least.
    pub relation: Relation,
    /// Where value and tolerance come from, in a few words.
    pub why: String,
}

impl Expectation {
    /// |measured − value| ≤ tolerance.
    pub fn equal(value: f64, tolerance: f64, why: impl Into<String>) -> Self {
        Expectation { value, tolerance, relation: Relation::Equal, why: why.into() }
    }

    /// measured ≤ value + tolerance.
    pub fn at_most(value: f64, tolerance: f64, why: impl Into<String>) -> Self {
        Expectation { value, tolerance, relation: Relation::AtMost, why: why.into() }
    }

    /// measured ≥ value − tolerance.
    pub fn at_least(value: f64, tolerance: f64, why: impl Into<String>) -> Self {
        Expectation { value, tolerance, relation: Relation::AtLeast, why: why.into() }
    }

    /// How far the measured value is on the wrong side, 0 if it is not.
    pub fn miss(&self, measured: f64) -> f64 {
        let difference = measured - self.value;
        match self.relation {
            Relation::Equal => difference.abs(),
            Relation::AtMost => difference.max(0.0),
            Relation::AtLeast => (-difference).max(0.0),
        }
    }

    /// Whether the measured value is as expected; never for a value that is not finite.
    pub fn holds(&self, measured: f64) -> bool {
        measured.is_finite() && self.value.is_finite() && self.miss(measured) <= self.tolerance
    }

    /// The size of the bound: the tolerance of an equality, else |limit|.
    pub fn size(&self) -> f64 {
        match self.relation {
            Relation::Equal => self.tolerance,
            Relation::AtMost => (self.value + self.tolerance).abs(),
            Relation::AtLeast => (self.value - self.tolerance).abs(),
        }
    }

    /// How much of the bound a measured value uses, by the module's table; `None` where there is nothing to divide by, or no number.
    ///
    /// ```
    /// use moreau_checks::Expectation;
    ///
    /// let speed = Expectation::equal(0.5, 0.25, "e v, one step of gravity");
    /// assert_eq!((speed.used(0.625), speed.holds(0.625)), (Some(0.5), true)); // half of what is allowed
    /// assert!(!speed.holds(0.8) && !speed.holds(f64::NAN));
    /// ```
    pub fn used(&self, measured: f64) -> Option<f64> {
        let one_sided = |x: f64, limit: f64| match limit {
            limit if limit > 0.0 => x.max(0.0) / limit,
            limit if limit < 0.0 && x < 0.0 => limit / x,
            _ => f64::NAN,
        };
        let used = match self.relation {
            Relation::Equal => (measured - self.value).abs() / self.tolerance,
            Relation::AtMost => one_sided(measured, self.value + self.tolerance),
            Relation::AtLeast => one_sided(-measured, self.tolerance - self.value),
        };
        Some(used).filter(|used| measured.is_finite() && used.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_never_as_expected() {
        for expectation in [Expectation::equal(1.0, 1.0, ""), Expectation::at_most(1.0, 1.0, ""), Expectation::at_least(1.0, 1.0, "")] {
            assert!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].iter().all(|x| !expectation.holds(*x) && expectation.used(*x).is_none()));
        }
        assert!(!Expectation::at_most(f64::INFINITY, 0.0, "no bound is no check").holds(0.0));
        assert!(!Expectation::equal(0.0, f64::NAN, "no bound is no check").holds(0.0));
    }

    #[test]
    fn bounds_are_one_sided() {
        assert!(Expectation::at_most(1.0, 0.0, "").holds(-5.0) && !Expectation::at_most(1.0, 0.0, "").holds(1.5));
        assert!(Expectation::at_least(1.0, 0.0, "").holds(5.0) && !Expectation::at_least(1.0, 0.0, "").holds(0.5));
    }

    #[test]
    fn a_bound_is_used_up_at_its_edge_and_not_at_its_centre() {
        let cases = [
            (Expectation::equal(2.0, 0.5, ""), 2.0, 1.5),
            (Expectation::at_most(2.0, 0.5, ""), 0.0, 2.5),
            (Expectation::at_most(-2.0, 0.5, ""), -1.5e12, -1.5),
            (Expectation::at_least(2.0, 0.5, ""), 1.5e12, 1.5),
            (Expectation::at_least(-2.0, 0.5, ""), 0.0, -2.5),
        ];
        for (expectation, centre, edge) in cases {
            assert!(expectation.used(centre) <= Some(1e-11) && expectation.used(edge) == Some(1.0), "{expectation:?}");
            let size = if expectation.relation == Relation::Equal { edge - expectation.value } else { edge };
            assert_eq!(expectation.size(), size.abs(), "{expectation:?}");
            assert!(expectation.holds(centre) && expectation.holds(edge), "{expectation:?}");
        }
    }

    #[test]
    fn where_there_is_nothing_to_divide_by_no_share_is_told() {
        assert_eq!(Expectation::equal(1.0, 0.0, "").used(1.0), None);
        assert_eq!(Expectation::at_most(0.0, 0.0, "").used(-1.0), None);
        assert_eq!(Expectation::at_least(1.0, 0.0, "").used(-1.0), None);
    }
}
