//! The mass on a belt: m q̈ + k q = friction of a belt that moves at v_b, with μ_s N while it sticks and μ_k N while it slips.
//!
//! ```text
//!     δ_s = μ_s N/k ,  δ_k = μ_k N/k ,  Δ = δ_s − δ_k ≥ 0 ,  ω = √(k/m)
//!     stick   q̇ = v_b  until q = δ_s
//!     slip    q = δ_k + Δ cos ωτ + (v_b/ω) sin ωτ ,   until q̇ = v_b again:  tan(ωτ/2) = −ωΔ/v_b ,  ωτ = 2(π − atan(ωΔ/v_b))
//!             then q = δ_k − Δ
//!     period  T = 2Δ/v_b + (2/ω)(π − atan(ωΔ/v_b))
//! ```
//! For Δ = 0 the slip touches v_b at one instant of each period and the stick phase has no length.

use moreau_exact::{Error, Result};
use std::f64::consts::PI;

/// A mass on a spring, dragged along by a belt.
///
/// # Source
/// den Hartog, *Mechanical Vibrations* (1956), stick–slip; the equations of the header.
///
/// ```
/// use moreau_forms::BeltOscillator;
///
/// let mass = BeltOscillator::new(10.0, 0.1, 0.03, 0.02)?; // ω, v_b, δ_s, δ_k
/// assert!((mass.stick_duration() - 0.2).abs() < 1e-12); // 2 (δ_s − δ_k)/v_b
/// let (position, velocity) = mass.state(0.0);
/// assert!((position - 0.03).abs() < 1e-12 && (velocity - 0.1).abs() < 1e-12); // it begins to slip at δ_s, with the belt
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeltOscillator {
    /// ω \[rad/s\].
    pub frequency: f64,
    /// v_b > 0 \[m/s\].
    pub belt: f64,
    /// δ_s \[m\].
    pub sticking: f64,
    /// δ_k ≤ δ_s \[m\].
    pub slipping: f64,
}

impl BeltOscillator {
    /// ω, v_b, δ_s and δ_k.
    ///
    /// # Errors
    /// If ω or v_b is not positive, or not 0 ≤ δ_k ≤ δ_s.
    pub fn new(frequency: f64, belt: f64, sticking: f64, slipping: f64) -> Result<Self> {
        for (field, value) in [("frequency", frequency), ("belt", belt)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        if !(0.0 <= slipping && slipping <= sticking && sticking.is_finite()) {
            return Err(Error::invalid("sticking", format!("is {sticking}"), "sticking friction is not less than slipping friction"));
        }
        Ok(BeltOscillator { frequency, belt, sticking, slipping })
    }

    /// Δ \[m\].
    fn excess(&self) -> f64 {
        self.sticking - self.slipping
    }

    /// How long a stick phase of the limit cycle lasts, 2Δ/v_b \[s\].
    pub fn stick_duration(&self) -> f64 {
        2.0 * self.excess() / self.belt
    }

    /// How long a slip phase lasts \[s\].
    pub fn slip_duration(&self) -> f64 {
        2.0 / self.frequency * (PI - (self.frequency * self.excess() / self.belt).atan())
    }

    /// The period of the limit cycle \[s\].
    pub fn period(&self) -> f64 {
        self.stick_duration() + self.slip_duration()
    }

    /// (q, v) at a time τ ≥ 0 after the mass began to slip at q = δ_s, on the limit cycle.
    pub fn state(&self, since_slip: f64) -> (f64, f64) {
        let time = since_slip.rem_euclid(self.period());
        let (slip, w) = (self.slip_duration(), self.frequency);
        if time >= slip {
            return (self.slipping - self.excess() + self.belt * (time - slip), self.belt);
        }
        let (sine, cosine) = (w * time).sin_cos();
        let position = self.slipping + self.excess() * cosine + self.belt / w * sine;
        (position, self.belt * cosine - w * self.excess() * sine)
    }

    /// (q, v) at a time t ≥ 0 of a mass that starts on the belt, at q = 0 with v = v_b.
    pub fn carried_from_zero(&self, time: f64) -> (f64, f64) {
        let release = self.sticking / self.belt;
        if time < release { (self.belt * time, self.belt) } else { self.state(time - release) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_slip_ends_at_belt_speed_as_far_below_the_slipping_position_as_it_began_above() {
        for excess in [0.0, 0.1, 1.0, 10.0] {
            let belt = BeltOscillator::new(3.0, 0.2, 0.5 + excess, 0.5).expect("valid");
            let w = belt.frequency;
            let (sine, cosine) = (w * belt.slip_duration()).sin_cos();
            let position = 0.5 + excess * cosine + 0.2 / w * sine;
            let speed = 0.2 * cosine - w * excess * sine;
            assert!((position - (0.5 - excess)).abs() <= rounding(64, 1.0 + excess));
            assert!((speed - 0.2).abs() <= rounding(64, 1.0 + w * excess));
        }
    }

    #[test]
    fn the_mass_never_outruns_the_belt_and_the_cycle_closes() {
        let belt = BeltOscillator::new(3.0, 0.2, 0.7, 0.5).expect("valid");
        for k in 0..200 {
            let (_, v) = belt.state(belt.period() * k as f64 / 200.0);
            assert!(v <= 0.2 + rounding(16, 1.0));
        }
        let (q, v) = belt.carried_from_zero(0.7 / 0.2 + 3.0 * belt.period());
        assert!((q - 0.7).abs() <= rounding(256, 1.0) && (v - 0.2).abs() <= rounding(256, 3.0), "{q} {v}");
    }

    #[test]
    fn the_friction_does_as_much_work_as_the_spring_stores_over_a_slip() {
        // while it slips friction is the constant force k δ_k: ½ v² + ½ ω² (q − δ_k)² is kept
        let belt = BeltOscillator::new(3.0, 0.2, 0.7, 0.5).expect("valid");
        let energy = |time: f64| {
            let (q, v) = belt.state(time);
            0.5 * v * v + 4.5 * (q - 0.5) * (q - 0.5)
        };
        for k in 1..50 {
            assert!((energy(belt.slip_duration() * k as f64 / 50.0) - energy(0.0)).abs() <= rounding(64, 1.0));
        }
        assert!(BeltOscillator::new(3.0, 0.2, 0.4, 0.5).is_err());
    }
}
