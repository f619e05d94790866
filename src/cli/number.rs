//! Numbers on the command line.

/// A number, also as a fraction such as `1/240`, whose sign stands before it; nothing where the text is neither, or too large for one.
pub fn number(text: &str) -> Option<f64> {
    let whole = |part: &str| part.trim().parse::<f64>().ok().filter(|_| !is_too_large(part));
    match text.split_once('/') {
        Some((above, below)) => whole(above).zip(whole(below).filter(|below| *below > 0.0)).map(|(above, below)| above / below),
        None => whole(text),
    }
}

/// A number of seconds for an option, also as a fraction; whether it is one that can be used its command says.
pub fn seconds(text: &str) -> Result<f64, &'static str> {
    let wrong = if text.split('/').any(is_too_large) { TOO_LARGE } else { "give seconds, such as 0.001 or 1/240" };
    number(text).ok_or(wrong)
}

/// A number for an option; whether it is one that can be used its command says.
pub fn real(text: &str) -> Result<f64, &'static str> {
    if is_too_large(text) {
        return Err(TOO_LARGE);
    }
    text.trim().parse().map_err(|_| "give a number, such as 0.5 or 1e-6")
}

/// What is said of a number such as 1e400.
const TOO_LARGE: &str = "give a smaller number: the largest that can be computed with is about 1.8e308";

/// Whether a text is a number beyond those of 64 bits, which would be read as infinite; `inf` says so itself, and has no numeral.
fn is_too_large(text: &str) -> bool {
    text.chars().any(|letter| letter.is_ascii_digit()) && text.trim().parse().is_ok_and(f64::is_infinite)
}

/// A whole number for an option that may be 0.
pub fn whole(text: &str) -> Result<usize, String> {
    digits(text, "0 or more")
}

/// A whole number for an option that counts from 1; 0 its command refuses, which knows what it is for and how far it goes.
pub fn count(text: &str) -> Result<usize, String> {
    digits(text, "at least 1")
}

fn digits(text: &str, least: &str) -> Result<usize, String> {
    let text = text.trim();
    let is_whole = !text.is_empty() && text.chars().all(|letter| letter.is_ascii_digit());
    // what has digits alone is no number only where it is too large
    text.parse().map_err(|_| match is_whole {
        true => format!("give a smaller number, at most {}", usize::MAX),
        false => format!("give a whole number, {least}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_decimals_and_as_fractions() {
        for (text, value) in [("1/240", 1.0 / 240.0), ("0.001", 0.001), ("-1", -1.0), (" 3 / 4 ", 0.75), ("1e-3", 1e-3)] {
            assert_eq!((number(text), seconds(text)), (Some(value), Ok(value)), "{text}");
        }
        for wrong in ["x", "1/2/3", "", "1/", "/2", "1/x", "1/0", "-1/-240"] {
            assert_eq!(number(wrong), None, "{wrong}");
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn whole_numbers_are_told_apart_from_others_and_from_those_that_are_too_large() {
        for (text, value) in [("0", 0), ("7", 7), (" 12 ", 12)] {
            assert_eq!((whole(text), count(text)), (Ok(value), Ok(value)), "{text}");
        }
        for wrong in ["", "x", "-1", "1.5", "1e3", "٣"] {
            let said = [whole(wrong), count(wrong)].map(|read| read.expect_err("no whole number"));
            assert_eq!(said, ["give a whole number, 0 or more", "give a whole number, at least 1"], "{wrong}");
        }
        for large in ["1e400", "-1e400", " 1e999 ", &"9".repeat(400)] {
            assert_eq!((number(large), seconds(large), real(large)), (None, Err(TOO_LARGE), Err(TOO_LARGE)), "{large}");
        }
        assert_eq!((seconds("1/1e400"), seconds("1e400/2"), real("1e308")), (Err(TOO_LARGE), Err(TOO_LARGE), Ok(1e308)));
        assert_eq!([seconds("inf"), real("-inf")], [Ok(f64::INFINITY), Ok(f64::NEG_INFINITY)]);
        let large = "9".repeat(30);
        assert_eq!(whole(&large), Err(format!("give a smaller number, at most {}", usize::MAX)));
        assert_eq!((real("1e-6"), real("x").is_err(), real("1/2").is_err()), (Ok(1e-6), true, true));
    }
}
