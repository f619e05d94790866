//! Whether something slow goes on for ever, or comes to rest.
//!
//! ```text
//!     T/2 ──► 3T/4 ──► T        Δ₁ = x(3T/4) − x(T/2) ,   Δ₂ = x(T) − x(3T/4)
//!     creeps:   |Δ₂| > least · T/4 ,   Δ₁ Δ₂ > 0 ,   |Δ₂| ≥ |Δ₁|/2
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
    let at = |share: f64| {
        let wanted = from + share * (end - from);
        let k = times.iter().position(|&t| t >= wanted)?;
        Some((times[k], *positions.get(k)?))
    };
    let (Some(half), Some(late), Some(last)) = (at(0.5), at(0.75), at(1.0)) else { return false };
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
    fn what_was_before_does_not_count_and_a_few_samples_tell_nothing() {
        assert!(!of(|t| t.min(1.0), 2.0, 0.0));
        assert!(!creeps(&[], &[], 0.0, 0.0) && !creeps(&[0.0, 1.0], &[0.0, 1.0], 0.0, 0.0));
        assert!(!creeps(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 1.0], 0.0, 0.0), "what is no number is no creep");
    }
}
