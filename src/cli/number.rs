//! Numbers on the command line.

/// A number, also as a fraction such as `1/240`; nothing where the text is neither.
pub fn number(text: &str) -> Option<f64> {
    let whole = |part: &str| part.trim().parse::<f64>().ok();
    match text.split_once('/') {
        Some((above, below)) => whole(above).zip(whole(below)).map(|(above, below)| above / below),
        None => whole(text),
    }
}

/// A number of seconds for an option, also as a fraction; whether it is one that can be used its command says.
pub fn seconds(text: &str) -> Result<f64, &'static str> {
    number(text).ok_or("give seconds, such as 0.001 or 1/240")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_decimals_and_as_fractions() {
        for (text, value) in [("1/240", 1.0 / 240.0), ("0.001", 0.001), ("-1", -1.0), (" 3 / 4 ", 0.75), ("1e-3", 1e-3)] {
            assert_eq!((number(text), seconds(text)), (Some(value), Ok(value)), "{text}");
        }
        for wrong in ["x", "1/2/3", "", "1/", "/2", "1/x"] {
            assert_eq!(number(wrong), None, "{wrong}");
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
