//! Numbers for readers: six significant digits, plain where that is short, scientific otherwise; and the larger of two.

use std::fmt::{self, Display, Formatter};

/// The larger of two numbers, NaN if one is.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// Whether all are finite numbers, looked at without a way out, several at once.
///
/// ```
/// use moreau_exact::number::are_finite;
///
/// assert!(are_finite(&[1.0, -f64::MAX, 5e-324]) && !are_finite(&[0.0, f64::NEG_INFINITY]) && !are_finite(&[f64::NAN]));
/// ```
pub fn are_finite(numbers: &[f64]) -> bool {
    // the exponent of what is no finite number is all ones, so that one more carries into the first bit
    const EXPONENT: u64 = f64::INFINITY.to_bits();
    const ONE: u64 = 1 << (f64::MANTISSA_DIGITS - 1);
    numbers.iter().fold(0, |carried, x| carried | ((x.to_bits() & EXPONENT) + ONE)) >> 63 == 0
}

/// A number with at most six significant digits and no trailing zeros.
///
/// ```
/// use moreau_exact::number::significant;
///
/// assert_eq!([2.0 / 3.0, 9.81, 3.6718184e-4].map(significant), ["0.666667", "9.81", "3.67182e-4"]);
/// ```
pub fn significant(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    if (0.001..1e6).contains(&size) {
        let decimals = (5 - size.log10().floor() as i32).max(0) as usize;
        return trimmed(&format!("{value:.decimals$}")).into();
    }
    let scientific = format!("{value:.5e}");
    match scientific.split_once('e') {
        Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
        None => scientific,
    }
}

/// A number with at most two significant digits, as [`significant`] writes it.
pub fn two_digits(value: f64) -> String {
    significant(format!("{value:.1e}").parse().unwrap_or(value))
}

/// A number, rounded to the second digit of its uncertainty, as [`significant`] writes it.
///
/// ```
/// use moreau_exact::number::to_two_digits_of;
///
/// assert_eq!(to_two_digits_of(0.42, 0.598432), "0.6");
/// assert_eq!(to_two_digits_of(1e-9, 0.598432), "0.598432");
/// assert_eq!(to_two_digits_of(0.0, 1.25), "1.25");
/// ```
pub fn to_two_digits_of(uncertainty: f64, value: f64) -> String {
    let decimals = 1.0 - uncertainty.log10().floor();
    if !(0.0..18.0).contains(&decimals) {
        return significant(value);
    }
    let decimals = decimals as usize;
    significant(format!("{value:.decimals$}").parse().unwrap_or(value))
}

/// A number followed by its unit; pure numbers have the unit `1` and show none.
///
/// ```
/// use moreau_exact::number::with_unit;
///
/// assert_eq!((with_unit("0.5", "N·s"), with_unit("0.5", "1")), ("0.5 N·s".into(), "0.5".into()));
/// ```
pub fn with_unit(number: &str, unit: &str) -> String {
    if unit == "1" { number.into() } else { format!("{number} {unit}") }
}

/// A count with its word in the singular or the plural: `1 entry`, `2 entries`, `0 rows`. What is never written costs nothing.
/// ```
/// use moreau_exact::number::counted;
///
/// assert_eq!([(1, "entry"), (2, "entry"), (0, "row")].map(|(n, word)| counted(n, word).to_string()), ["1 entry", "2 entries", "0 rows"]);
/// ```
pub fn counted(count: usize, word: &str) -> Counted<'_> {
    Counted { count, word }
}

/// What [`counted`] writes.
#[derive(Clone, Copy, Debug)]
pub struct Counted<'a> {
    count: usize,
    word: &'a str,
}

impl Display for Counted<'_> {
    fn fmt(&self, text: &mut Formatter) -> fmt::Result {
        let Counted { count, word } = self;
        match word.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u'])) {
            _ if *count == 1 => write!(text, "1 {word}"),
            Some(stem) => write!(text, "{count} {stem}ies"),
            None => write!(text, "{count} {word}s"),
        }
    }
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_survive_and_zeros_do_not() {
        assert_eq!(significant(0.25), "0.25");
        assert_eq!(significant(1.0), "1");
        assert_eq!(significant(-3.0e-17), "-3e-17");
        assert_eq!(significant(std::f64::consts::PI), "3.14159");
        assert_eq!(significant(123_456.7), "123457");
        assert_eq!(significant(200.0), "200");
        assert_eq!(significant(1.5e6), "1.5e6");
        assert_eq!(significant(-0.0), "0");
        assert_eq!(significant(f64::NAN), "NaN");
    }

    #[test]
    fn pure_numbers_show_no_unit() {
        assert_eq!(with_unit("2", "1"), "2");
        assert_eq!(with_unit("2", "m/s"), "2 m/s");
    }
}
