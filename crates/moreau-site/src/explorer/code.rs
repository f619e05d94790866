//! Numbers of a run as text: whole millionths, their differences, and how often nothing changes, in base64.
//!
//! ```text
//!     a channel:  order d, then the d-th differences of its integers (d ≤ 3, before the first there are zeros)
//!     an integer: zigzag (0, −1, 1, −2, … ↦ 0, 1, 2, 3, …) in groups of seven bits, the low ones first, 128 added where more follow
//!     zeros:      one zero, then how many more follow
//! ```
//! The program of the page reads the same; a number is given back exactly as it was rounded.

use data_encoding::BASE64;
use moreau_exact::{Error, Result};

/// Digits after the point of every number but residuals.
pub const DECIMALS: i32 = 6;

/// The highest difference that is tried.
const ORDERS: u8 = 3;

/// A number in whole millionths of its unit.
pub fn fixed(value: f64) -> i64 {
    (value * 10f64.powi(DECIMALS)).round() as i64
}

/// Residual codes below this are words: 1 is exactly zero, 2 is no finite number.
const FIRST: i64 = 1000;

/// Moves the exponents of all numbers above zero.
const BIAS: i64 = 400;

/// A residual with two significant digits as an integer: exponent and the two digits.
pub fn residual(value: f64) -> i64 {
    if value == 0.0 {
        return 1;
    }
    let text = format!("{:.1e}", value.abs());
    let parts = text.split_once('e').and_then(|(digits, exponent)| {
        let digits: i64 = digits.replace('.', "").parse().ok()?;
        Some((digits, exponent.parse::<i64>().ok()?))
    });
    parts.map_or(2, |(digits, exponent)| FIRST + 100 * (exponent + BIAS) + digits)
}

/// The channels as text; all have the same length, which the text does not hold.
pub fn encode(channels: &[Vec<i64>]) -> String {
    let bytes: Vec<u8> = channels.iter().flat_map(|channel| shortest(channel)).collect();
    BASE64.encode(&bytes)
}

/// The channels of a text of `encode`, each with so many numbers.
///
/// # Errors
/// [`Error::Unsupported`] where the text is not one of `encode`.
pub fn decode(text: &str, length: usize) -> Result<Vec<Vec<i64>>> {
    let broken = || Error::Unsupported("the text holds no run".into());
    let bytes = BASE64.decode(text.as_bytes()).map_err(|_| broken())?;
    let (mut channels, mut rest) = (Vec::new(), bytes.as_slice());
    while let Some((&order, mut tail)) = rest.split_first() {
        let mut numbers = Vec::with_capacity(length);
        while numbers.len() < length {
            let value = taken(&mut tail).ok_or_else(broken)?;
            let more = if value == 0 { taken(&mut tail).ok_or_else(broken)? } else { 0 };
            numbers.extend(std::iter::repeat_n(signed(value), more as usize + 1));
        }
        (0..order).for_each(|_| summed(&mut numbers));
        channels.push(numbers);
        rest = tail;
    }
    Ok(channels)
}

/// The channel with the order that makes it shortest.
fn shortest(channel: &[i64]) -> Vec<u8> {
    let mut differences = channel.to_vec();
    let mut best = written(0, &differences);
    for order in 1..=ORDERS {
        let mut before = 0;
        differences.iter_mut().for_each(|number| before = std::mem::replace(number, *number - before));
        let tried = written(order, &differences);
        if tried.len() < best.len() {
            best = tried;
        }
    }
    best
}

fn written(order: u8, numbers: &[i64]) -> Vec<u8> {
    let mut bytes = vec![order];
    let mut at = 0;
    while at < numbers.len() {
        let number = numbers[at];
        put(&mut bytes, ((number << 1) ^ (number >> 63)) as u64);
        at += 1;
        if number == 0 {
            let more = numbers[at..].iter().take_while(|number| **number == 0).count();
            put(&mut bytes, more as u64);
            at += more;
        }
    }
    bytes
}

fn put(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 128 {
        bytes.push((value % 128) as u8 + 128);
        value /= 128;
    }
    bytes.push(value as u8);
}

fn taken(bytes: &mut &[u8]) -> Option<u64> {
    let (mut value, mut scale) = (0u64, 1u64);
    loop {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        value += u64::from(byte % 128) * scale;
        if byte < 128 {
            return Some(value);
        }
        scale = scale.checked_mul(128)?;
    }
}

fn signed(value: u64) -> i64 {
    (value >> 1) as i64 ^ -((value & 1) as i64)
}

fn summed(numbers: &mut [i64]) {
    let mut sum = 0;
    numbers.iter_mut().for_each(|number| {
        sum += *number;
        *number = sum;
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_exactly_and_what_repeats_takes_no_room() {
        let fall: Vec<i64> = (0..500).map(|k| 1_100_000 - 85 * k * k).collect();
        let channels = [fall, vec![0; 500], (0..500).map(|k| if k % 7 == 0 { -k } else { 1_i64 << (k % 40) }).collect(), vec![-3; 500]];
        let text = encode(&channels);
        assert_eq!(decode(&text, 500).expect("its own text"), channels);
        assert!(encode(&channels[..2]).len() < 40, "a parabola and rest are a few numbers");
        assert!(decode(&text[..text.len() - 8], 500).is_err() && decode("?", 1).is_err());
    }

    #[test]
    fn a_residual_keeps_two_digits_and_says_what_is_no_number() {
        assert_eq!([0.0, f64::NAN, f64::INFINITY].map(residual), [1, 2, 2]);
        assert_eq!([1.0, 3.14e-9, 9.96e-5, 2.5e12].map(residual), [41_010, 40_131, 40_610, 42_225]);
        assert_eq!((fixed(0.1234564), fixed(-1e-7), fixed(-2.0000006)), (123_456, 0, -2_000_001));
    }
}
