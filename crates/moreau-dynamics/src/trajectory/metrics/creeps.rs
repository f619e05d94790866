//! Whether something slow goes on for ever, or comes to rest.
//!
//! ```text
//!     t₁, t₂ the first samples from the half and from three quarters of the way between `from` and the last one, t₃
//!     s₁ = (x(t₂) − x(t₁))/(t₂ − t₁) ,   s₂ = (x(t₃) − x(t₂))/(t₃ − t₂)
//!     creeps:   |s₂| > least ,   s₁ s₂ > 0 ,   2|s₂| ≥ |s₁|
//! ```
//! What decays has lost more than half of its way from one quarter to the next once its time constant is below T/(4 ln 2); what swings goes
//! back.

/// Whether a coordinate still goes the same way at the end of a motion from `from` to the last time, at a mean speed above `least`
/// \[m/s\]; not with fewer than three samples in the second half.
///
/// ```
/// use moreau_dynamics::trajectory::metrics::creeps;
///
/// let times: Vec<f64> = (0..=8).map(f64::from).collect();
/// let steady: Vec<f64> = times.iter().map(|t| 0.5 * t).collect();
/// let sinking: Vec<f64> = times.iter().map(|t| (-t).exp()).collect();
/// assert!(creeps(&times, &steady, 0.0, 0.1) && !creeps(&times, &sinking, 0.0, 0.0));
/// ```
pub fn creeps(times: &[f64], positions: &[f64], from: f64, least: f64) -> bool {
    let Some(&end) = times.last() else { return false };
    let at = |k: usize| Some((times[k], *positions.get(k)?));
    let after = |share: f64| times.iter().position(|&t| t >= from + share * (end - from)).and_then(at);
    let (Some(half), Some(late), Some(last)) = (after(0.5), after(0.75), at(times.len() - 1)) else { return false };
    if half.0 >= late.0 || late.0 >= last.0 {
        return false;
    }
    let speed = |(t0, x0): (f64, f64), (t1, x1): (f64, f64)| (x1 - x0) / (t1 - t0);
    let (before, after) = (speed(half, late), speed(late, last));
    after.abs() > least && before * after > 0.0 && 2.0 * after.abs() >= before.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(position: impl Fn(f64) -> f64, from: f64, least: f64) -> bool {
        let times: Vec<f64> = (0..=400).map(|k| 0.01 * f64::from(k)).collect();
        creeps(&times, &times.iter().map(|t| position(*t)).collect::<Vec<_>>(), from, least)
    }

    #[test]
    fn what_goes_on_at_one_speed_creeps_and_what_stands_does_not() {
        assert!(of(|t| 0.001 * t, 0.0, 0.0005) && of(|t| -0.001 * t, 0.0, 0.0005), "either way");
        assert!(!of(|_| 1.0, 0.0, 0.0), "stands");
        assert!(!of(|t| 0.001 * t, 0.0, 0.002), "is slower than what counts");
        assert!(of(|t| 0.001 * t * t, 0.0, 0.0005), "grows");
    }

    #[test]
    fn what_decays_or_swings_comes_to_rest() {
        assert!(!of(|t| (-4.0 * t).exp(), 0.0, 0.0));
        assert!(of(|t| (-0.1 * t).exp(), 0.0, 0.0), "too slowly to be told from creep");
        assert!(!of(|t| (t * std::f64::consts::PI).cos(), 0.0, 0.0), "it is where it was after its period, to rounding or back again");
    }

    #[test]
    fn the_last_sample_is_the_last_whatever_rounding_makes_of_its_time() {
        let times: Vec<f64> = (0..=34).map(|k| 0.01 * f64::from(k)).collect();
        let (from, end) = (0.03, times[34]);
        assert!(from + (end - from) > end, "the sum is beyond the last time");
        assert!(creeps(&times, &times.iter().map(|t| 0.01 * t).collect::<Vec<_>>(), from, 0.0));
    }

    #[test]
    fn what_was_before_does_not_count_and_a_few_samples_tell_nothing() {
        assert!(!of(|t| t.min(1.0), 2.0, 0.0));
        assert!(!creeps(&[], &[], 0.0, 0.0) && !creeps(&[0.0, 1.0], &[0.0, 1.0], 0.0, 0.0));
        assert!(!creeps(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 1.0], 0.0, 0.0), "what is no number is no creep");
    }
}
