//! A number of a motion with its unit, and what of it is rounding.

use crate::number::{significant, with_unit};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;

/// One number of the summary; no value where it is not defined for this motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Quantity {
    /// What it is.
    pub name: &'static str,
    /// Its value.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: &'static str,
    /// What rounding alone can make of it: a value that is not larger says no more than 0; absent where that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounding: Option<f64>,
}

/// A value with its unit, or that it is rounding.
pub(super) fn shown(value: f64, unit: &str, rounding: Option<f64>) -> String {
    match rounding {
        Some(bound) if value != 0.0 && value.abs() <= bound => format!("{} (rounding)", with_unit("0", unit)),
        _ => with_unit(&significant(value), unit),
    }
}

/// What stands in place of a residual that is none, as where numbers are too large for their squares.
pub const NO_NUMBER: &str = "no number";

/// A number with two digits, or that it is none.
pub fn short(number: f64) -> String {
    if number.is_nan() { NO_NUMBER.into() } else { format!("{number:.1e}") }
}

/// The defined quantities, one per line.
pub fn lines(quantities: &[Quantity]) -> String {
    let mut text = String::new();
    for Quantity { name, value, unit, rounding } in quantities {
        if let Some(value) = value {
            writeln!(text, "  {name:42} {}", shown(*value, unit, *rounding)).expect("writing to a String cannot fail");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_told_in_words() {
        assert_eq!([short(f64::NAN), short(0.25), short(f64::INFINITY)], ["no number", "2.5e-1", "inf"]);
    }

    #[test]
    fn undefined_quantities_have_no_line() {
        let quantity = |value| Quantity { name: "creep", value, unit: "m/s", rounding: None };
        assert_eq!(lines(&[quantity(None)]), "");
        assert!(lines(&[quantity(Some(0.5))]).ends_with(" 0.5 m/s\n"));
    }

    #[test]
    fn what_rounding_makes_is_shown_as_such_and_nothing_else_is() {
        assert_eq!(shown(1e-17, "J", Some(1e-15)), "0 J (rounding)");
        assert_eq!(shown(-1e-15, "J", Some(1e-15)), "0 J (rounding)");
        assert_eq!([shown(0.0, "J", Some(1e-15)), shown(2e-15, "J", Some(1e-15)), shown(1e-17, "J", None)], ["0 J", "2e-15 J", "1e-17 J"]);
    }
}
