//! A finding: one measured number, compared with one expectation.

use crate::bearing::Bearing;
use crate::expectation::Expectation;
use crate::relation::Relation;
use moreau_exact::number::two_digits;
use moreau_exact::scalar::Rational;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// One measured number, what was expected of it and how far it may differ.
///
/// ```
/// use moreau_checks::Finding;
///
/// let depth = Finding::at_most("depth", 1e-4, 1e-3, "m");
/// assert!(depth.holds());
/// assert!(!Finding::at_least("rebound", 0.2, 0.5, "m/s").holds());
/// ```
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Finding {
    /// What was measured.
    pub name: String,
    /// The measured value (the nearest `f64` if it is exact); `null` if it is not finite.
    #[schemars(with = "Option<f64>")]
    pub measured: f64,
    /// What is expected of it; written as `expected`, `tolerance` and `relation`.
    #[serde(flatten, serialize_with = "flat")]
    #[schemars(with = "Flat")]
    pub expectation: Expectation,
    /// Unit, `1` for pure numbers.
    pub unit: &'static str,
    /// Measured and expected value as exact rationals or decisions, where the comparison was exact; else it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<[String; 2]>,
    /// What it has to do with the sentence that it belongs to.
    #[serde(skip)]
    pub bearing: Bearing,
    #[serde(skip)]
    pub(crate) rational: Option<Rational>,
    /// Whether the measured value is as expected.
    holds: bool,
}

/// An expectation under the names that it has in a finding.
#[derive(Serialize, JsonSchema)]
struct Flat {
    /// The expected number.
    expected: f64,
    /// How far the measured one may differ.
    tolerance: f64,
    /// How they are compared.
    relation: Relation,
}

/// Writes an expectation without its reason, which stands in the check.
fn flat<S: Serializer>(expectation: &Expectation, serializer: S) -> Result<S::Ok, S::Error> {
    let Expectation { value, tolerance, relation, .. } = *expectation;
    Flat { expected: value, tolerance, relation }.serialize(serializer)
}

impl Finding {
    fn compare(name: impl Into<String>, measured: f64, expectation: Expectation, unit: &'static str) -> Self {
        let holds = expectation.holds(measured);
        let (name, bearing) = (name.into(), Bearing::default());
        Finding { name, measured, expectation, unit, exact: None, bearing, rational: None, holds }
    }

    /// |measured − expected| ≤ tolerance.
    pub fn equal(name: impl Into<String>, measured: f64, expected: f64, tolerance: f64, unit: &'static str) -> Self {
        Self::compare(name, measured, Expectation::equal(expected, tolerance, ""), unit)
    }

    /// measured ≤ bound.
    pub fn at_most(name: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Self::compare(name, measured, Expectation::at_most(bound, 0.0, ""), unit)
    }

    /// measured ≤ bound + tolerance.
    pub fn at_most_within(name: impl Into<String>, measured: f64, bound: f64, tolerance: f64, unit: &'static str) -> Self {
        Self::compare(name, measured, Expectation::at_most(bound, tolerance, ""), unit)
    }

    /// measured ≥ bound.
    pub fn at_least(name: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Self::compare(name, measured, Expectation::at_least(bound, 0.0, ""), unit)
    }

    /// Exact equality of rationals, tolerance zero.
    pub fn exact(name: impl Into<String>, measured: &Rational, expected: &Rational, unit: &'static str) -> Self {
        let mut finding = Self::equal(name, measured.to_f64().value(), expected.to_f64().value(), 0.0, unit);
        finding.holds = measured == expected;
        finding.exact = Some([measured.to_string(), expected.to_string()]);
        finding.rational = Some(measured.clone());
        finding
    }

    /// A count that must be the expected one.
    pub fn count(name: impl Into<String>, measured: usize, expected: usize) -> Self {
        Self::exact(name, &Rational::from(measured), &Rational::from(expected), "1")
    }

    /// A decision that must come out as expected (1 true, 0 false).
    pub fn decision(name: impl Into<String>, measured: bool, expected: bool) -> Self {
        let mut finding = Self::count(name, usize::from(measured), usize::from(expected));
        finding.exact = Some([measured.to_string(), expected.to_string()]);
        finding
    }

    /// Whether the measured value is as expected.
    pub fn holds(&self) -> bool {
        self.holds
    }

    /// How much of its bound the measured value uses, see [`Expectation::used`]; `None` for what is compared exactly.
    pub fn used(&self) -> Option<f64> {
        self.expectation.used(self.measured).filter(|_| self.exact.is_none())
    }

    /// Whether the finding is a decision, true or false.
    pub fn is_decision(&self) -> bool {
        self.exact.as_ref().is_some_and(|[measured, _]| measured == "true" || measured == "false")
    }

    /// The finding with `holds` computed afresh from its numbers, which may have been changed.
    pub(crate) fn judged_again(mut self) -> Self {
        let rounded = self.expectation.holds(self.measured);
        self.holds = rounded && self.exact.as_ref().is_none_or(|[measured, expected]| measured == expected);
        self
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Expectation { value, tolerance, relation, .. } = &self.expectation;
        let sign = relation.sign();
        let unit = if self.unit == "1" { String::new() } else { format!(" {}", self.unit) };
        let used = self.used().map(|used| format!("; {} of the bound", two_digits(used))).unwrap_or_default();
        match &self.exact {
            Some([measured, expected]) => write!(f, "{}: {measured}{unit} (expected {sign} {expected}, exact)", self.name),
            None if *relation == Relation::Equal => {
                write!(f, "{}: {:.10e}{unit} (expected {sign} {value:.10e} ± {tolerance:.1e}{used})", self.name, self.measured)
            }
            None => write!(f, "{}: {:.10e}{unit} (expected {sign} {value:.10e}{used})", self.name, self.measured),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    #[test]
    fn both_sides_of_each_boundary() {
        assert!(Finding::equal("x", 1.5, 1.0, 0.5, "m").holds());
        assert!(!Finding::equal("x", 1.75, 1.0, 0.5, "m").holds());
        assert!(!Finding::equal("x", 0.25, 1.0, 0.5, "m").holds());
        assert!(Finding::at_most("x", 1.0, 1.0, "m").holds());
        assert!(!Finding::at_most("x", 1.0 + 1e-15, 1.0, "m").holds());
        assert!(Finding::at_least("x", 1.0, 1.0, "m").holds());
        assert!(!Finding::at_least("x", 1.0 - 1e-15, 1.0, "m").holds());
    }

    #[test]
    fn a_decision_reads_as_one() {
        let finding = Finding::decision("copositive", true, false);
        assert!(!finding.holds() && finding.measured == 1.0);
        assert_eq!(finding.to_string(), "copositive: true (expected = false, exact)");
    }

    #[test]
    fn nan_never_holds() {
        assert!(!Finding::equal("x", f64::NAN, 1.0, 1.0, "m").holds());
        assert!(!Finding::at_most("x", f64::NAN, 1.0, "m").holds());
        assert!(!Finding::at_least("x", f64::INFINITY, 1.0, "m").holds());
    }

    #[test]
    fn what_is_exact_uses_no_bound() {
        assert_eq!(Finding::count("k", 3, 3).used(), None);
        let half = Finding::equal("x", 1.25, 1.0, 0.5, "m");
        assert_eq!(half.used(), Some(0.5));
        assert!(half.to_string().ends_with("± 5.0e-1; 0.5 of the bound)"), "{half}");
    }

    #[test]
    fn exact_findings_see_differences_below_the_spacing_of_floats() {
        let tiny = ratio(1, 1_000_000_000_000_000_000) / ratio(1_000_000_000, 1);
        assert!(!Finding::exact("x", &(ratio(1, 1) + tiny), &ratio(1, 1), "1").holds());
    }
}
