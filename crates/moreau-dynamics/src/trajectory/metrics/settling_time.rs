//! The time after which a motion stays at rest.

/// The first sample time from which on every speed is at most `threshold` \[m/s\]; `None` if the last one is faster.
pub fn settling_time(times: &[f64], speeds: &[f64], threshold: f64) -> Option<f64> {
    // Not `speed > threshold`: a NaN is not at rest.
    let resting = speeds.iter().rev().take_while(|speed| speed.abs() <= threshold).count();
    if resting == 0 { None } else { times.get(speeds.len() - resting).copied() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pause_is_not_rest() {
        let times = [0.0, 1.0, 2.0, 3.0];
        assert_eq!(settling_time(&times, &[0.0, 1.0, 0.0, 0.0], 0.1), Some(2.0));
        assert_eq!(settling_time(&times, &[0.0, 0.0, 0.0, 1.0], 0.1), None);
        assert_eq!(settling_time(&times, &[0.0, 0.0, f64::NAN, 0.0], 0.1), Some(3.0));
        assert_eq!(settling_time(&times, &[0.0, -1.0, -0.1, 0.1], 0.1), Some(2.0), "falling is not rest");
    }
}
