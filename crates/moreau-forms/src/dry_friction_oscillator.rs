//! The dry-friction oscillator: m q̈ + k q ∈ −F Sgn(q̇), released from rest at q₀.
//!
//! ```text
//!     ω = √(k/m) ,  δ = F/k (half the width of the stick zone) ,  T_½ = π/ω
//!     half-cycle i, t ∈ [i T_½, (i+1) T_½]:   q = c_i + (q_i − c_i) cos ω(t − i T_½) ,   c_i = δ sign q_i
//!     turning points                          |q_i| = |q₀| − 2 i δ ,  alternating in sign
//!     it sticks for ever at the first i with |q_i| ≤ δ:   n = ⌈(|q₀| − δ)/(2δ)⌉ half-cycles
//! ```
//! The stick zone is the sliding mode of Filippov's convention on q̇ = 0: there both vector fields point at the surface.

use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use std::f64::consts::PI;

/// A mass on a spring and a rough floor, released at rest.
///
/// # Source
/// Chapter §1, the dry-friction oscillator; Lorenz (1924), den Hartog (1931) for the decrement 2δ a half-cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFrictionOscillator {
    frequency: f64,
    zone: f64,
    start: f64,
}

/// The turning points q₀, q₁, …, the last in the stick zone |q| ≤ δ, in any ordered field.
///
/// # Panics
/// If δ is not positive: the turning points would not end.
///
/// ```
/// use moreau_exact::scalar::ratio;
/// use moreau_forms::dry_friction_oscillator::turning_points;
///
/// let points = turning_points(&ratio(5, 1), &ratio(1, 1)); // from 5 δ, a decrement of 2 δ each
/// assert_eq!(points, [ratio(5, 1), ratio(-3, 1), ratio(1, 1)]); // the last one in the stick zone
/// ```
pub fn turning_points<T: Scalar>(start: &T, zone: &T) -> Vec<T> {
    assert!(*zone > T::zero(), "without friction the oscillation does not end");
    let mut points = vec![start.clone()];
    let mut last = start.clone();
    while last.magnitude() > *zone {
        let twice = zone.clone() + zone.clone();
        last = if last > T::zero() { twice - last } else { -(twice + last) };
        points.push(last.clone());
    }
    points
}

impl DryFrictionOscillator {
    /// Mass m \[kg\], stiffness k \[N/m\], friction F \[N\] and start q₀ \[m\].
    ///
    /// # Errors
    /// If m, k or F is not positive and finite, or q₀ is not finite.
    pub fn new(mass: f64, stiffness: f64, friction: f64, start: f64) -> Result<Self> {
        for (field, value) in [("mass", mass), ("stiffness", stiffness), ("friction", friction)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        if !start.is_finite() {
            return Err(Error::invalid("start", format!("is {start}"), "use a finite number"));
        }
        Ok(DryFrictionOscillator { frequency: (stiffness / mass).sqrt(), zone: friction / stiffness, start })
    }

    /// δ = F/k \[m\].
    pub fn zone(&self) -> f64 {
        self.zone
    }

    /// Number of half-cycles until it sticks.
    pub fn half_cycles(&self) -> usize {
        turning_points(&self.start, &self.zone).len() - 1
    }

    /// When it sticks for ever, n π/ω \[s\].
    pub fn sticking_time(&self) -> f64 {
        self.half_cycles() as f64 * PI / self.frequency
    }

    /// (q, v) at a time t ≥ 0 \[m, m/s\].
    pub fn state(&self, time: f64) -> (f64, f64) {
        let points = turning_points(&self.start, &self.zone);
        let half = PI / self.frequency;
        let cycle = (time / half).max(0.0) as usize;
        if cycle + 1 >= points.len() {
            return (points[points.len() - 1], 0.0);
        }
        let centre = self.zone.copysign(points[cycle]);
        let (sine, cosine) = (self.frequency * (time - cycle as f64 * half)).sin_cos();
        let amplitude = points[cycle] - centre;
        (centre + amplitude * cosine, -amplitude * self.frequency * sine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{DIFFERENCE, difference_error};
    use moreau_exact::scalar::{Rational, ratio};
    use moreau_exact::tolerance::rounding;

    #[test]
    fn turning_points_lose_twice_the_zone_until_they_lie_in_it() {
        let points: Vec<Rational> = turning_points(&ratio(1, 1), &ratio(3, 20));
        assert_eq!(points, [ratio(1, 1), ratio(-7, 10), ratio(2, 5), ratio(-1, 10)]);
        assert_eq!(turning_points(&ratio(-3, 20), &ratio(3, 20)).len(), 1, "the border of the zone belongs to it");
    }

    #[test]
    fn the_number_of_half_cycles_is_the_ceiling() {
        for (start, zone) in [(1.0, 0.15), (0.4, 0.15), (0.1, 0.15), (5.0, 0.03)] {
            let oscillator = DryFrictionOscillator::new(1.0, 1.0, zone, start).expect("valid");
            let expected = ((start - zone) / (2.0 * zone)).ceil().max(0.0);
            assert_eq!(oscillator.half_cycles() as f64, expected);
        }
    }

    #[test]
    fn the_motion_satisfies_its_equation_and_loses_the_work_of_friction() {
        let (m, k, f) = (2.0, 50.0, 4.0);
        let oscillator = DryFrictionOscillator::new(m, k, f, 1.0).expect("valid");
        let half = PI / (k / m).sqrt();
        for step in 1..40 {
            let time = 0.01 + 0.05 * step as f64;
            if (time / half).fract() * half < 0.005 || (time / half).fract() * half > half - 0.005 {
                continue;
            }
            let at = |time| oscillator.state(time);
            let acceleration = (at(time + DIFFERENCE).1 - at(time - DIFFERENCE).1) / (2.0 * DIFFERENCE);
            let (q, v) = at(time);
            // while it sticks friction balances the spring
            let friction = if v == 0.0 { k * q } else { -f * v.signum() };
            assert!((m * acceleration + k * q - friction).abs() <= m * difference_error(5.0, 25.0 * 5.0), "t = {time}");
        }
        // the energy lost in the first half-cycle is F times its path
        let (a, b) = (oscillator.state(0.0).0, oscillator.state(half).0);
        assert!((0.5 * k * (a * a - b * b) - f * (a - b)).abs() <= rounding(16, k));
    }

    #[test]
    fn it_rests_where_the_spring_cannot_move_it() {
        let oscillator = DryFrictionOscillator::new(1.0, 1.0, 0.15, 1.0).expect("valid");
        let (q, v) = oscillator.state(100.0);
        assert!(v == 0.0 && q.abs() <= oscillator.zone() && (q + 0.1).abs() <= rounding(8, 1.0));
        assert!((oscillator.sticking_time() - 3.0 * PI).abs() <= rounding(4, 10.0));
        assert!(DryFrictionOscillator::new(1.0, 1.0, 0.0, 1.0).is_err());
    }
}
