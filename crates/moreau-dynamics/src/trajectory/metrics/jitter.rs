//! Root mean square of a velocity at rest.

/// √(Σ_k v_k²/n) \[m/s\] of the samples at or after `from`; `None` if there is none.
pub fn jitter(times: &[f64], velocities: &[f64], from: f64) -> Option<f64> {
    let resting: Vec<f64> = times.iter().zip(velocities).filter(|(t, _)| **t >= from).map(|(_, v)| v * v).collect();
    if resting.is_empty() { None } else { Some((resting.iter().sum::<f64>() / resting.len() as f64).sqrt()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_samples_at_rest_count() {
        assert_eq!(jitter(&[0.0, 1.0, 2.0], &[9.0, 3.0, -3.0], 1.0), Some(3.0));
        assert_eq!(jitter(&[1.0, 2.0, 3.0, 4.0], &[3.0, 3.0, 3.0, -13.0], 1.0), Some(7.0), "the mean of squares, not of magnitudes");
        assert_eq!(jitter(&[0.0], &[9.0], 1.0), None);
    }
}
