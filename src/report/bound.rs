//! How a proved bound is printed.

/// A bound to four digits that is not below it.
pub(super) fn above(bound: f64) -> String {
    if bound == 0.0 {
        return "0".into();
    }
    let digits = format!("{bound:.3e}");
    let rounded: f64 = digits.parse().expect("it was printed");
    if rounded >= bound {
        return digits;
    }
    let (mantissa, exponent) = digits.split_once('e').expect("an exponent");
    let thousandths = mantissa.replace('.', "").parse::<i64>().expect("digits") + 1;
    format!("{}.{:03}e{exponent}", thousandths / 1000, thousandths % 1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_proved_bound_is_printed_no_smaller_than_it_is() {
        for bound in [1.0 / 3.0, 2.0 / 3.0, 9.99951, 1e-300, 7e-13, 12345.0] {
            let printed: f64 = above(bound).parse().unwrap();
            assert!(printed >= bound && printed <= bound * 1.002, "{bound} {printed}");
        }
        assert_eq!(above(0.0), "0");
    }
}
