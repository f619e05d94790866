//! The trapezoidal rule on a pendulum, q̈ = −sin q with E = ½ω² − cos q: the smallest nonlinear system.
//!
//! ```text
//!     q⁺ = q + h (ω + ω⁺)/2 ,   ω⁺ = ω − h (sin q + sin q⁺)/2 .
//! ```
//! One step changes the energy by the error of the trapezoidal quadrature of sin, exactly
//! E⁺ − E = (q⁺ − q)³ sin(ξ)/12 with ξ between q and q⁺.

/// Angle and angular velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// q \[rad\].
    pub angle: f64,
    /// ω \[rad/s\].
    pub rate: f64,
}

impl Swing {
    /// E = ½ω² − cos q.
    pub fn energy(self) -> f64 {
        0.5 * self.rate * self.rate - self.angle.cos()
    }

    /// One step of the trapezoidal rule.
    pub fn step(self, h: f64) -> Swing {
        self.theta_step(h, 0.5)
    }

    /// One θ step; the fixed-point iteration contracts with θ²h² and runs until it no longer moves.
    pub fn theta_step(self, h: f64, theta: f64) -> Swing {
        let mut next = self;
        loop {
            let rate = self.rate - h * ((1.0 - theta) * self.angle.sin() + theta * next.angle.sin());
            let angle = self.angle + h * ((1.0 - theta) * self.rate + theta * rate);
            let moved = (angle - next.angle).abs();
            let improved = moved > f64::EPSILON * (1.0 + angle.abs());
            next = Swing { angle, rate };
            if !improved {
                return next;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_satisfies_the_trapezoidal_rule_to_rounding() {
        let (now, h) = (Swing { angle: 1.3, rate: 0.7 }, 0.1);
        let next = now.step(h);
        let bound = crate::tolerance::rounding(8, 2.0);
        assert!((next.angle - now.angle - 0.5 * h * (now.rate + next.rate)).abs() <= bound);
        assert!((next.rate - now.rate + 0.5 * h * (now.angle.sin() + next.angle.sin())).abs() <= bound);
    }
}
