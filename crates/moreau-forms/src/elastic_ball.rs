//! The elastic ball: E = ½ m v² + m g q is constant through flights and impacts, and the motion has a period.
//!
//! ```text
//!     period = 2 v_max/g ,   v_max = √(2E/m) ;      a θ-scheme keeps  E − (θ − ½) m g h v  instead of E.
//! ```

use moreau_exact::scalar::Scalar;

/// A ball of mass m under gravity g that loses nothing at its impacts (e = 1), in any ordered field.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticBall<T: Scalar> {
    /// m \[kg\].
    pub mass: T,
    /// g \[m/s²\].
    pub gravity: T,
}

impl<T: Scalar> ElasticBall<T> {
    /// E = ½ m v² + m g q \[J\].
    pub fn energy(&self, height: &T, velocity: &T) -> T {
        let kinetic = T::ratio(1, 2) * velocity.clone() * velocity.clone();
        self.mass.clone() * (kinetic + self.gravity.clone() * height.clone())
    }

    /// I = E − (θ − ½) m g h v \[J\], what a θ-scheme with step h conserves.
    ///
    /// In flight v⁺ = v − g h and q⁺ = q + h(θv⁺ + (1 − θ)v) change E by −(θ − ½) m g² h², and v by −g h. At an impact
    /// v⁺ = −v and the same position update change E by −2(θ − ½) m g h v, and v by −2v. In both cases
    /// ΔE = (θ − ½) m g h Δv, whatever θ.
    pub fn discrete_invariant(&self, theta: &T, h: &T, height: &T, velocity: &T) -> T {
        let slope = (theta.clone() - T::ratio(1, 2)) * self.mass.clone() * self.gravity.clone() * h.clone();
        self.energy(height, velocity) - slope * velocity.clone()
    }
}

impl ElasticBall<f64> {
    /// Speed at the floor, √(2E/m) \[m/s\].
    pub fn impact_speed(&self, energy: f64) -> f64 {
        (2.0 * energy / self.mass).sqrt()
    }

    /// Time between impacts, 2√(2E/m)/g \[s\].
    pub fn period(&self, energy: f64) -> f64 {
        2.0 * self.impact_speed(energy) / self.gravity
    }

    /// Largest distance of E from E₀ under a θ-scheme of step h: |θ − ½| m g h · (|v₀| + max |v|) \[J\].
    pub fn energy_oscillation(&self, theta: f64, h: f64, initial_speed: f64, largest_speed: f64) -> f64 {
        (theta - 0.5).abs() * self.mass * self.gravity * h * (initial_speed + largest_speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::BALL_ROUNDING;
    use moreau_exact::scalar::{Rational, ratio};

    fn ball() -> ElasticBall<Rational> {
        ElasticBall { mass: ratio(3, 2), gravity: ratio(981, 100) }
    }

    /// q + h(θv⁺ + (1 − θ)v), written out here so that no scheme is involved.
    fn advance(q: &Rational, v: &Rational, v_post: &Rational, theta: &Rational, h: &Rational) -> Rational {
        q + h * (theta * v_post + (ratio(1, 1) - theta) * v)
    }

    #[test]
    fn flights_and_impacts_keep_the_discrete_invariant_exactly_for_every_theta() {
        let (h, ball) = (ratio(1, 64), ball());
        for theta in [ratio(0, 1), ratio(1, 3), ratio(1, 2), ratio(1, 1)] {
            for (q, v) in [(ratio(1, 2), ratio(-7, 3)), (ratio(-1, 100), ratio(-2, 1)), (ratio(2, 1), ratio(5, 1))] {
                let before = ball.discrete_invariant(&theta, &h, &q, &v);
                for v_post in [&v - &ball.gravity * &h, -v.clone()] {
                    let q_post = advance(&q, &v, &v_post, &theta, &h);
                    assert_eq!(ball.discrete_invariant(&theta, &h, &q_post, &v_post), before);
                }
            }
        }
    }

    #[test]
    fn a_plastic_step_does_not_keep_it() {
        let (h, ball, theta) = (ratio(1, 64), ball(), ratio(1, 2));
        let (q, v, v_post) = (ratio(0, 1), ratio(-2, 1), ratio(0, 1));
        let q_post = advance(&q, &v, &v_post, &theta, &h);
        assert_ne!(ball.discrete_invariant(&theta, &h, &q_post, &v_post), ball.discrete_invariant(&theta, &h, &q, &v));
    }

    #[test]
    fn the_period_is_twice_the_fall_from_the_apex() {
        let ball = ElasticBall { mass: 2.0, gravity: 9.81 };
        let fall = (2.0f64 * 1.0 / 9.81).sqrt();
        assert!((ball.period(ball.energy(&1.0, &0.0)) - 2.0 * fall).abs() <= BALL_ROUNDING);
    }

    #[test]
    fn theta_one_half_keeps_the_energy_itself() {
        let ball = ElasticBall { mass: 2.0, gravity: 9.81 };
        assert_eq!(ball.energy_oscillation(0.5, 0.1, 0.0, 4.0), 0.0);
        assert_eq!(ball.discrete_invariant(&0.5, &0.1, &1.0, &3.0), ball.energy(&1.0, &3.0));
    }
}
