//! Axes: their labels with units, linear or logarithmic, and the numbers at them.

use super::paper::span;
use moreau_exact::number::significant;
use moreau_exact::tolerance::EPSILON;
use moreau_exact::{Error, Result};
use std::ops::Range;

/// How numbers are spread over an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithms.
    Logarithmic,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit, e.g. `energy [J]`.
    pub label: String,
    /// How numbers are spread over it.
    pub scale: Scale,
    /// What it shows of the numbers; all of them if absent.
    pub range: Option<Range<f64>>,
}

/// How many numbers there should be at an axis.
const NUMBERS: f64 = 6.0;
/// Decades from which on a logarithmic axis numbers its decades alone.
const DECADES: f64 = 1.7;
/// Decades beyond which it leaves some of them out.
const MANY_DECADES: f64 = 9.0;

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Axis { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Axis { label: label.into(), scale: Scale::Logarithmic, range: None }
    }

    /// The same from `low` to `high`.
    pub fn within(self, low: f64, high: f64) -> Self {
        Axis { range: Some(low..high), ..self }
    }

    /// Where a number lies on the paper: itself, or its logarithm.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => value.log10(),
        }
    }

    /// The range of places that shows the values.
    pub(super) fn extent(&self, values: impl Iterator<Item = f64>) -> Result<Range<f64>> {
        let range = match &self.range {
            Some(range) => self.place(range.start)..self.place(range.end),
            None => span(values.map(|value| self.place(value)), 0.05),
        };
        if range.start.is_finite() && range.end.is_finite() && range.start < range.end {
            return Ok(range);
        }
        Err(Error::Unsupported(format!("the axis `{}` has no range from {} to {}", self.label, range.start, range.end)))
    }

    /// The places with a number.
    pub(super) fn marks(&self, range: &Range<f64>) -> Vec<f64> {
        match self.scale {
            Scale::Linear => multiples(range, round_step((range.end - range.start) / NUMBERS)),
            Scale::Logarithmic if range.end - range.start > DECADES => multiples(range, ((range.end - range.start) / MANY_DECADES).ceil()),
            Scale::Logarithmic => within_decades(range),
        }
    }

    /// What is written at a place.
    pub(super) fn number(&self, place: f64, range: &Range<f64>) -> String {
        match self.scale {
            // what is left where the axis crosses zero
            Scale::Linear if place.abs() <= EPSILON * 16.0 * (range.end - range.start) => "0".into(),
            Scale::Linear => significant(place),
            Scale::Logarithmic if range.end - range.start > DECADES => format!("10{}", raised(place.round() as i32)),
            Scale::Logarithmic => significant(10f64.powf(place)),
        }
    }
}

/// The multiples of a step within a range.
fn multiples(range: &Range<f64>, step: f64) -> Vec<f64> {
    let room = step * EPSILON.sqrt(); // an end that rounding puts outside is inside
    let (first, last) = (((range.start - room) / step).ceil() as i64, ((range.end + room) / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

/// The step of the form 1, 2 or 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let decade = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|digit| digit * decade).find(|step| *step >= least).unwrap_or(10.0 * decade)
}

/// 1, 2 and 5 times the powers of ten within a range of logarithms.
fn within_decades(range: &Range<f64>) -> Vec<f64> {
    let decades = range.start.floor() as i32..=range.end.ceil() as i32;
    let all = decades.flat_map(|k| [1.0f64, 2.0, 5.0].map(|digit| digit.log10() + f64::from(k)));
    all.filter(|place| range.contains(place)).collect()
}

/// A number as an exponent.
fn raised(number: i32) -> String {
    let digit = |character: char| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => char::from_u32('⁰' as u32 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
    };
    number.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(axis: &Axis, range: Range<f64>) -> Vec<String> {
        axis.marks(&range).into_iter().map(|place| axis.number(place, &range)).collect()
    }

    #[test]
    fn an_axis_has_a_few_round_numbers() {
        assert_eq!(numbers(&Axis::linear("t [s]"), -0.5..1.1), ["-0.5", "0", "0.5", "1"]);
        assert_eq!(numbers(&Axis::logarithmic("h [s]"), -3.0..-1.0), ["10⁻³", "10⁻²", "10⁻¹"]);
        assert_eq!(numbers(&Axis::logarithmic("h [s]"), -2.1..-0.9), ["0.01", "0.02", "0.05", "0.1"]);
        assert_eq!(numbers(&Axis::logarithmic("r [N·s]"), -12.0..0.0).len(), 7);
    }

    #[test]
    fn an_axis_without_a_range_is_refused() {
        assert!(Axis::linear("x [m]").within(1.0, 1.0).extent(std::iter::empty()).is_err());
        assert!(Axis::logarithmic("x [m]").extent([0.0, 1.0].into_iter()).is_err());
        assert_eq!(Axis::logarithmic("x [m]").within(0.1, 10.0).extent(std::iter::empty()).expect("two decades"), -1.0..1.0);
    }

    #[test]
    fn exponents_are_raised() {
        assert_eq!(raised(-1023456789), "⁻¹⁰²³⁴⁵⁶⁷⁸⁹");
    }
}
