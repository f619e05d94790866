//! The undamped oscillator with a stop: q̈ = −ω² q, q ≥ s, v⁺ = −e v⁻ at q = s; released from rest at q₀ > s.
//!
//! ```text
//!     t₁ = arccos(s/q₀)/ω ,   V₁ = ω √(q₀² − s²)          (it reaches the stop iff q₀ ≥ |s|)
//!     after impact k:   q = s cos ωτ + (U_k/ω) sin ωτ ,   U_k = e V_k = e^k V₁
//!     flight            q = s  ⇔  tan(ωτ/2) = U/(ω s) :   τ_k = (2/ω) atan2(U_k, ω s) ,   V_{k+1} = U_k
//! ```
//! s < 0: the impacts end when the mass no longer reaches the stop. s = 0: they come every π/ω for ever. s > 0: the spring presses against
//! the stop, τ_k → 2U_k/(ω² s), and for e < 1 infinitely many impacts happen in finite time, as under gravity.

use moreau_exact::{Error, Result};

/// An undamped oscillator above a stop.
///
/// # Source
/// Shaw and Holmes, *A periodically forced piecewise linear oscillator* (1983), without forcing.
///
/// ```
/// use moreau_forms::StopOscillator;
/// use std::f64::consts::{FRAC_PI_2, PI};
///
/// let through_rest = StopOscillator::new(1.0, 0.0, 1.0, 0.5)?; // ω, stop, start, e
/// assert!((through_rest.first_impact_time() - FRAC_PI_2).abs() < 1e-12);
/// assert!((through_rest.flight(3) - PI).abs() < 1e-12); // at s = 0 every flight is half a period: no accumulation
/// assert!(StopOscillator::new(1.0, 0.1, 1.0, 0.5)?.accumulation_time().is_finite()); // pressed against the stop it ends
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopOscillator {
    frequency: f64,
    stop: f64,
    start: f64,
    restitution: f64,
}

impl StopOscillator {
    /// ω \[rad/s\], stop s \[m\], start q₀ \[m\], restitution e < 1 or e = 1.
    ///
    /// # Errors
    /// If ω is not positive, q₀ < |s| (the mass would never reach the stop) or e ∉ \[0, 1\].
    pub fn new(frequency: f64, stop: f64, start: f64, restitution: f64) -> Result<Self> {
        if !(frequency.is_finite() && frequency > 0.0) {
            return Err(Error::invalid("frequency", format!("is {frequency}"), "use a positive number"));
        }
        if !(stop.is_finite() && start.is_finite() && start > stop.abs()) {
            return Err(Error::invalid("start", format!("is {start}"), "start farther out than the stop, or the mass never reaches it"));
        }
        if !(0.0..=1.0).contains(&restitution) {
            return Err(Error::invalid("restitution", format!("is {restitution}"), "use a number in [0, 1]"));
        }
        Ok(StopOscillator { frequency, stop, start, restitution })
    }

    /// t₁ \[s\].
    pub fn first_impact_time(&self) -> f64 {
        (self.stop / self.start).acos() / self.frequency
    }

    /// V_k, the speed just before impact k ≥ 1 \[m/s\].
    pub fn impact_speed(&self, impact: usize) -> f64 {
        let first = self.frequency * ((self.start - self.stop) * (self.start + self.stop)).sqrt();
        first * self.restitution.powf(impact as f64 - 1.0)
    }

    /// τ_k, the flight after impact k \[s\].
    pub fn flight(&self, impact: usize) -> f64 {
        2.0 / self.frequency * self.impact_speed(impact + 1).atan2(self.frequency * self.stop)
    }

    /// When the impacts accumulate \[s\]: finite for s > 0 and e < 1; summed until the flights no longer count.
    pub fn accumulation_time(&self) -> f64 {
        if self.stop <= 0.0 || self.restitution == 1.0 {
            return f64::INFINITY;
        }
        let mut time = self.first_impact_time();
        for impact in 1.. {
            let next = time + self.flight(impact);
            if next == time {
                break;
            }
            time = next;
        }
        time
    }

    /// (q, v) at a time t ≥ 0; for s > 0 at rest on the stop from the accumulation time on.
    pub fn state(&self, time: f64) -> (f64, f64) {
        let mut impact_time = self.first_impact_time();
        if time < impact_time {
            let (sine, cosine) = (self.frequency * time).sin_cos();
            return (self.start * cosine, -self.frequency * self.start * sine);
        }
        for impact in 1.. {
            let (speed, flight) = (self.impact_speed(impact + 1), self.flight(impact));
            if time < impact_time + flight {
                let (sine, cosine) = (self.frequency * (time - impact_time)).sin_cos();
                let (s, w) = (self.stop, self.frequency);
                return (s * cosine + speed / w * sine, speed * cosine - s * w * sine);
            }
            if impact_time + flight == impact_time {
                break;
            }
            impact_time += flight;
        }
        (self.stop, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use std::f64::consts::PI;

    fn oscillator(stop: f64, restitution: f64) -> StopOscillator {
        StopOscillator::new(2.0, stop, 1.0, restitution).expect("valid")
    }

    #[test]
    fn a_stop_at_the_neutral_position_is_hit_every_half_period() {
        let at_zero = oscillator(0.0, 0.5);
        assert!((at_zero.first_impact_time() - PI / 4.0).abs() <= rounding(4, 1.0));
        for impact in 1..20 {
            assert!((at_zero.flight(impact) - PI / 2.0).abs() <= rounding(4, 2.0));
        }
        assert!(at_zero.accumulation_time().is_infinite());
    }

    #[test]
    fn each_flight_ends_on_the_stop_at_the_speed_it_began_with() {
        for stop in [-0.5, 0.0, 0.5] {
            let oscillator = oscillator(stop, 0.8);
            let mut time = oscillator.first_impact_time();
            for impact in 1..12 {
                let end = time + oscillator.flight(impact);
                let (q, v) = oscillator.state(end * (1.0 - 4.0 * f64::EPSILON));
                assert!((q - stop).abs() <= rounding(64, 4.0) && (v + oscillator.impact_speed(impact + 1)).abs() <= rounding(64, 4.0));
                time = end;
            }
        }
    }

    #[test]
    fn a_pressed_stop_has_an_accumulation_time_which_weak_bounces_reach_as_under_gravity() {
        let pressed = oscillator(0.5, 0.5);
        let end = pressed.accumulation_time();
        assert_eq!(pressed.state(end * 1.01), (0.5, 0.0));
        // the last flights are those of a ball under ω² s
        let flight = pressed.flight(30);
        assert!((flight / (2.0 * pressed.impact_speed(31) / (4.0 * 0.5)) - 1.0).abs() <= rounding(16, 1.0));
    }

    #[test]
    fn energy_falls_by_e_squared_at_each_impact() {
        let pressed = oscillator(0.5, 0.8);
        let energy = |time: f64| {
            let (q, v) = pressed.state(time);
            0.5 * v * v + 2.0 * q * q
        };
        let mut time = pressed.first_impact_time();
        for impact in 1..10 {
            let expected = 0.5 * (0.8 * pressed.impact_speed(impact)).powi(2) + 2.0 * 0.25;
            for part in [0.1, 0.5, 0.9] {
                assert!((energy(time + part * pressed.flight(impact)) - expected).abs() <= rounding(64, 4.0));
            }
            time += pressed.flight(impact);
        }
        assert!(StopOscillator::new(2.0, 1.5, 1.0, 0.5).is_err());
    }
}
