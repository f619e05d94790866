//! The non-negative orthant `{x : xᵢ ≥ 0}`, the cone of frictionless contact; it is its own dual.

/// Whether every entry is non-negative (NaN is not).
pub fn contains(x: &[f64]) -> bool {
    x.iter().all(|&entry| entry >= 0.0)
}

/// Replaces `x` by the nearest point of the orthant, `max(xᵢ, 0)`; NaN stays NaN.
pub fn project(x: &mut [f64]) {
    x.iter_mut().filter(|entry| **entry < 0.0).for_each(|entry| *entry = 0.0);
}

/// Euclidean distance from `x` to the orthant, the norm of its negative part.
pub fn distance(x: &[f64]) -> f64 {
    x.iter().filter(|entry| entry.is_nan() || **entry < 0.0).fold(0.0, |norm: f64, &entry| norm.hypot(entry))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_negative_part_is_dropped_and_measured() {
        let mut x = [3.0, -3.0, 0.0, -4.0];
        assert!(!contains(&x));
        assert_eq!(distance(&x), 5.0);
        project(&mut x);
        assert_eq!(x, [3.0, 0.0, 0.0, 0.0]);
        assert!(contains(&x) && distance(&x) == 0.0);
    }

    #[test]
    fn nan_is_neither_contained_nor_near() {
        let mut x = [f64::NAN];
        assert!(!contains(&x) && distance(&x).is_nan());
        project(&mut x);
        assert!(x[0].is_nan());
    }
}
