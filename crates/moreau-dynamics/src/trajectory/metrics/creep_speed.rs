//! Mean speed of something that should stand: |x(T) − x(t₀)|/(T − t₀).

/// Mean velocity (x(T) − x(t₀))/(T − t₀) \[m/s\] from the first sample at or after `from` to the last.
///
/// `None` if fewer than two samples lie there.
///
/// ```
/// use moreau_dynamics::trajectory::metrics::creep_speed;
///
/// assert_eq!(creep_speed(&[0.0, 1.0, 2.0, 3.0], &[0.0, 5.0, 5.5, 6.0], 1.0), Some(0.5)); // m/s, from the second sample on
/// ```
pub fn creep_speed(times: &[f64], positions: &[f64], from: f64) -> Option<f64> {
    let start = times.iter().position(|&t| t >= from)?;
    let (first, last) = ((times[start], positions.get(start)?), (times[times.len() - 1], positions.get(times.len() - 1)?));
    (last.0 > first.0).then(|| (last.1 - first.1) / (last.0 - first.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transient_before_the_start_does_not_count() {
        assert_eq!(creep_speed(&[0.0, 1.0, 2.0, 3.0], &[9.0, 1.0, 1.5, 2.0], 1.0), Some(0.5));
        assert_eq!(creep_speed(&[0.0, 1.0], &[0.0, 1.0], 1.0), None);
        assert_eq!(creep_speed(&[], &[], 0.0), None);
        assert_eq!(creep_speed(&[0.0, 4.0], &[1.0, -1.0], 0.0), Some(-0.5), "creep has a sign");
    }
}
