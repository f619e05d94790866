//! The root of a function in a bracket, to rounding.

use moreau_contact::tolerance::solvers::ROOT_STEPS;
use moreau_exact::Result;

/// The place in \[low, high\] where f, not negative at `low` and negative at `high`, changes its sign: the Illinois rule with a bisection
/// every third step. Of the two neighbours that enclose it the one is taken where |f| is less.
///
/// # Errors
/// Those of f.
pub fn falling_root(mut f: impl FnMut(f64) -> Result<f64>, low: f64, high: f64) -> Result<f64> {
    let (mut low, mut high) = (low, high);
    let (at_low, at_high) = (f(low)?, f(high)?);
    let (mut weight_low, mut weight_high) = (at_low, at_high);
    let (mut best_low, mut best_high) = (at_low.abs(), at_high.abs());
    let mut last_moved_low = None;
    for step in 1..=ROOT_STEPS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let secant = low - weight_low * (high - low) / (weight_high - weight_low);
        let x = if step % 3 != 0 && secant > low && secant < high { secant } else { middle };
        let value = f(x)?;
        let moved_low = value >= 0.0;
        let repeated = last_moved_low == Some(moved_low);
        last_moved_low = Some(moved_low);
        if moved_low {
            (low, weight_low, best_low) = (x, value, value);
            weight_high *= if repeated { 0.5 } else { 1.0 };
        } else {
            (high, weight_high, best_high) = (x, value, -value);
            weight_low *= if repeated { 0.5 } else { 1.0 };
        }
        if value == 0.0 {
            return Ok(x);
        }
    }
    Ok(if best_high < best_low { high } else { low })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_to_the_last_bit() {
        for power in [1, 2, 3, 9] {
            let root = falling_root(|x| Ok(2.0 - x.powi(power)), 0.0, 3.0).expect("no error");
            assert!((root - 2f64.powf(1.0 / f64::from(power))).abs() <= 2.0 * f64::EPSILON, "{power}: {root}");
        }
    }

    #[test]
    fn a_jump_is_enclosed_by_neighbours() {
        let root = falling_root(|x| Ok(if x < 0.3 { 1.0 } else { -2.0 }), 0.0, 1.0).expect("no error");
        assert!((root - 0.3).abs() <= f64::EPSILON);
    }
}
