//! The bouncing ball: q̈ = −g, q ≥ 0, and v⁺ = −e v⁻ at every impact; dropped from rest at height q₀.
//!
//! ```text
//!     t₁ = √(2 q₀/g) ,   t_k = t₁ [1 + 2 (e + … + e^{k−1})] ,   speed before impact k: g t₁ e^{k−1} ,
//!     T∞ = t₁ (1 + e)/(1 − e) .
//! ```
//! The impacts accumulate at T∞ if e < 1; from there on the ball rests.

use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};
use moreau_exact::{Error, Result};

/// A ball dropped from rest on a floor at height zero.
///
/// # Source
/// Chapter §0, the Zeno example; elementary ballistics.
///
/// ```
/// use moreau_forms::BouncingBall;
///
/// let ball = BouncingBall::new(10.0, 5.0, 0.5)?; // g, height, e
/// assert_eq!(ball.first_impact_time(), 1.0);
/// assert_eq!(ball.impact_speed(2), 5.0);
/// assert_eq!(ball.accumulation_time(), 3.0); // (1 + e)/(1 − e) times the first: infinitely many impacts
/// assert_eq!((ball.impacts_until(2.25), ball.impacts_until(3.0)), (Some(2), None));
/// assert_eq!(ball.state(4.0), (0.0, 0.0));
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BouncingBall {
    gravity: f64,
    height: f64,
    restitution: f64,
}

/// t_k/t₁ = 1 + 2(e + … + e^{k−1}), k ≥ 1, in any ordered field.
pub fn impact_time_ratio<T: Scalar>(restitution: &T, impact: usize) -> T {
    decided(
        || flight_by_flight(restitution, impact),
        |found| {
            let [e, time] = [restitution, found].map(rational::<T, Rational>);
            let parts = vec![("restitution", Part::from(e?)), ("impact", Part::Counts(vec![impact])), ("value", Part::from(time?))];
            Some(Witness::new("impact-time", parts))
        },
    )
}

fn flight_by_flight<T: Scalar>(restitution: &T, impact: usize) -> T {
    let (mut power, mut sum) = (T::one(), T::one());
    for _ in 1..impact {
        power *= restitution.clone();
        sum = sum + power.clone() + power.clone();
    }
    sum
}

/// T∞/t₁ = (1 + e)/(1 − e), e < 1, in any ordered field.
///
/// ```
/// use moreau_exact::scalar::ratio;
/// use moreau_forms::bouncing_ball::{accumulation_time_ratio, impact_time_ratio};
///
/// let e = ratio(1, 2);
/// assert_eq!(accumulation_time_ratio(&e), ratio(3, 1));
/// assert_eq!(impact_time_ratio(&e, 3), ratio(5, 2)); // 1 + 2 (½ + ¼)
/// ```
pub fn accumulation_time_ratio<T: Scalar>(restitution: &T) -> T {
    (T::one() + restitution.clone()) / (T::one() - restitution.clone())
}

impl BouncingBall {
    /// A ball under gravity g \[m/s²\], dropped from rest at `height` q₀ \[m\], with restitution e.
    ///
    /// # Errors
    /// If g or q₀ is not positive and finite, or e is outside \[0, 1\].
    pub fn new(gravity: f64, height: f64, restitution: f64) -> Result<Self> {
        for (field, value) in [("gravity", gravity), ("height", height)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        if !(0.0..=1.0).contains(&restitution) {
            return Err(Error::invalid("restitution", format!("is {restitution}"), "use a number in [0, 1]"));
        }
        Ok(BouncingBall { gravity, height, restitution })
    }

    /// t₁ = √(2 q₀/g) \[s\].
    pub fn first_impact_time(&self) -> f64 {
        (2.0 * self.height / self.gravity).sqrt()
    }

    /// t_k \[s\], k ≥ 1; for e = 0 every k gives t₁.
    ///
    /// # Panics
    /// If k = 0.
    pub fn impact_time(&self, impact: usize) -> f64 {
        assert!(impact >= 1, "impacts are counted from 1");
        self.first_impact_time() * (1.0 + 2.0 * self.restitution * self.geometric_sum(impact - 1))
    }

    /// T∞ = t₁ (1 + e)/(1 − e) \[s\], infinite for e = 1.
    pub fn accumulation_time(&self) -> f64 {
        self.first_impact_time() * accumulation_time_ratio(&self.restitution)
    }

    /// Speed just before impact k, g t₁ e^{k−1} \[m/s\].
    pub fn impact_speed(&self, impact: usize) -> f64 {
        self.gravity * self.first_impact_time() * self.restitution.powf(impact as f64 - 1.0)
    }

    /// Height of the apex after impact k (k = 0: the drop), q₀ e^{2k} \[m\].
    pub fn apex_height(&self, impact: usize) -> f64 {
        self.height * self.restitution.powf(2.0 * impact as f64)
    }

    /// Number of impacts in (0, t]; `None` once they are infinitely many (0 < e < 1, t ≥ T∞).
    pub fn impacts_until(&self, time: f64) -> Option<usize> {
        let first = self.first_impact_time();
        let e = self.restitution;
        if time < first {
            return Some(0);
        }
        if e == 0.0 {
            return Some(1);
        }
        let remaining = self.accumulation_time() - time;
        if remaining <= 0.0 {
            return None;
        }
        // T∞ − t_k = 2 t₁ e^k/(1 − e) gives k up to rounding; one neighbour on either side settles it.
        let estimate =
            if e == 1.0 { 0.5 * (time / first + 1.0) } else { (remaining * (1.0 - e) / (2.0 * first)).ln() / self.log_restitution() };
        let mut impact = (estimate.max(1.0)) as usize;
        if self.impact_time(impact) > time {
            impact -= 1;
        } else if self.impact_time(impact + 1) <= time {
            impact += 1;
        }
        Some(impact.max(1))
    }

    /// Height and velocity (q, v) at a time t ≥ 0; v is continuous from the right, and (0, 0) from T∞ on.
    pub fn state(&self, time: f64) -> (f64, f64) {
        match self.impacts_until(time) {
            Some(0) => (self.height - 0.5 * self.gravity * time * time, -self.gravity * time),
            None => (0.0, 0.0),
            Some(_) if self.restitution == 0.0 => (0.0, 0.0),
            Some(impact) => {
                let launch = self.restitution * self.impact_speed(impact);
                let elapsed = (time - self.impact_time(impact)).max(0.0);
                ((elapsed * (launch - 0.5 * self.gravity * elapsed)).max(0.0), launch - self.gravity * elapsed)
            }
        }
    }

    /// Total variation of v over \[0, t\]: g min(t, T∞) from flight and (1 + e) g t₁ e^{k−1} from each impact \[m/s\].
    pub fn velocity_variation(&self, time: f64) -> f64 {
        let jumps = match self.impacts_until(time) {
            Some(count) => self.geometric_sum(count),
            None => 1.0 / (1.0 - self.restitution),
        };
        let scale = self.gravity * self.first_impact_time();
        self.gravity * time.min(self.accumulation_time()) + (1.0 + self.restitution) * scale * jumps
    }

    /// The corner points (t, v) of the velocity on \[0, `until`\], two per impact: v⁻ and v⁺.
    ///
    /// Impacts slower than ε times the first are left out: they move no point of the graph by more than the rounding of
    /// the first impact's speed.
    pub fn velocity_corners(&self, until: f64) -> Vec<[f64; 2]> {
        let mut corners = vec![[0.0, 0.0]];
        for impact in 1.. {
            let (time, speed) = (self.impact_time(impact), self.impact_speed(impact));
            if time >= until || speed <= f64::EPSILON * self.impact_speed(1) {
                break;
            }
            corners.extend([[time, -speed], [time, self.restitution * speed]]);
        }
        let [time, velocity] = corners[corners.len() - 1];
        let end = self.accumulation_time().min(until);
        if end < until || velocity == 0.0 && time > 0.0 {
            corners.extend([[end.max(time), 0.0], [until, 0.0]]);
        } else {
            corners.push([until, self.state(until).1]);
        }
        corners
    }

    /// T + V per unit mass, ½v² + g q \[J/kg\], at a time t.
    pub fn specific_energy(&self, time: f64) -> f64 {
        let (height, velocity) = self.state(time);
        0.5 * velocity * velocity + self.gravity * height
    }

    /// 1 + e + … + e^{n−1}, without cancellation as e → 1.
    fn geometric_sum(&self, terms: usize) -> f64 {
        if terms == 0 {
            0.0
        } else if self.restitution == 1.0 {
            terms as f64
        } else {
            -(terms as f64 * self.log_restitution()).exp_m1() / (1.0 - self.restitution)
        }
    }

    /// ln e, accurate as e → 1.
    fn log_restitution(&self) -> f64 {
        (self.restitution - 1.0).ln_1p()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::BALL_ROUNDING;
    use moreau_exact::scalar::{Rational, ratio};

    fn ball(restitution: f64) -> BouncingBall {
        BouncingBall::new(9.81, 1.0, restitution).expect("valid")
    }

    fn close(a: f64, b: f64, scale: f64) {
        assert!((a - b).abs() <= BALL_ROUNDING * scale, "{a} against {b}");
    }

    #[test]
    fn impact_times_agree_with_the_exact_rational_ratios() {
        for (numerator, denominator) in [(4, 5), (1, 2), (19, 20), (1, 1), (0, 1)] {
            let ball = ball(numerator as f64 / denominator as f64);
            for impact in 1..60 {
                let exact: Rational = impact_time_ratio(&ratio(numerator, denominator), impact);
                let expected = ball.first_impact_time() * Scalar::to_f64(&exact);
                close(ball.impact_time(impact), expected, expected);
            }
        }
    }

    #[test]
    fn accumulation_time_is_the_limit_of_the_exact_impact_times() {
        let e = ratio(4, 5);
        let limit = accumulation_time_ratio(&e);
        assert_eq!(limit, ratio(9, 1));
        // T∞ − t_k = 2 t₁ e^k/(1 − e), exactly.
        let mut power = ratio(1, 1);
        for impact in 1..40 {
            power *= &e;
            assert_eq!(&limit - impact_time_ratio(&e, impact), ratio(2, 1) * &power / (ratio(1, 1) - &e));
        }
        assert!(ball(1.0).accumulation_time().is_infinite());
    }

    #[test]
    fn printed_times_of_the_chapter_example() {
        let ball = ball(0.8);
        for (impact, printed) in [(1, 0.451523641), (2, 1.173961467), (3, 1.751911727), (4, 2.214271935), (5, 2.584160102)] {
            assert!((ball.impact_time(impact) - printed).abs() <= 0.5e-9);
        }
        assert!((ball.accumulation_time() - 4.063712768872).abs() <= 0.5e-12);
    }

    #[test]
    fn each_flight_ends_where_the_next_impact_begins() {
        for e in [0.3, 0.8, 0.95, 1.0] {
            let ball = ball(e);
            for impact in 1..30 {
                let flight = ball.impact_time(impact + 1) - ball.impact_time(impact);
                close(flight, 2.0 * e * ball.impact_speed(impact) / 9.81, ball.impact_time(impact + 1));
            }
        }
    }

    #[test]
    fn energy_is_constant_in_flight_and_drops_by_e_squared_at_impacts() {
        let ball = ball(0.8);
        for impact in 1..20 {
            let (start, end) = (ball.impact_time(impact), ball.impact_time(impact + 1));
            let expected = 9.81 * ball.apex_height(impact);
            for k in 1..10 {
                close(ball.specific_energy(start + 0.1 * k as f64 * (end - start)), expected, 9.81);
            }
        }
    }

    #[test]
    fn velocity_is_the_derivative_of_height_between_impacts() {
        // A parabola's central difference is its derivative; only rounding remains, ε q₀/δ.
        let ball = ball(0.7);
        let delta = 1e-4;
        for k in 1..200 {
            let time = 0.01 * k as f64;
            if ball.impacts_until(time - delta) == ball.impacts_until(time + delta) {
                let slope = (ball.state(time + delta).0 - ball.state(time - delta).0) / (2.0 * delta);
                close(slope, ball.state(time).1, 1.0 / delta);
            }
        }
    }

    #[test]
    fn velocity_is_continuous_from_the_right_at_an_impact() {
        for e in [0.5, 0.8, 1.0] {
            let ball = ball(e);
            for impact in 1..25 {
                let time = ball.impact_time(impact);
                assert_eq!(ball.impacts_until(time), Some(impact));
                close(ball.state(time).1, e * ball.impact_speed(impact), 9.81);
                let before = time - 1e-9 * ball.impact_speed(impact);
                assert_eq!(ball.impacts_until(before), Some(impact - 1));
                assert!(ball.state(before).1 < 0.0);
            }
        }
    }

    #[test]
    fn the_ball_rests_from_the_accumulation_time_on() {
        let ball = ball(0.8);
        let end = ball.accumulation_time();
        assert_eq!(ball.impacts_until(end), None);
        assert_eq!(ball.state(end), (0.0, 0.0));
        assert_eq!(ball.state(2.0 * end), (0.0, 0.0));
        assert!(ball.impacts_until(end * 0.999).is_some());
    }

    #[test]
    fn a_plastic_ball_rests_after_one_impact_and_an_elastic_one_never() {
        let plastic = ball(0.0);
        assert_eq!(plastic.accumulation_time(), plastic.first_impact_time());
        assert_eq!(plastic.impacts_until(10.0), Some(1));
        assert_eq!(plastic.state(plastic.first_impact_time()), (0.0, 0.0));
        let elastic = ball(1.0);
        let period = 2.0 * elastic.first_impact_time();
        close(elastic.state(10.0 * period).0, 1.0, 10.0);
        assert_eq!(elastic.impacts_until(10.0 * period), Some(10));
    }

    #[test]
    fn total_variation_agrees_with_a_sum_over_impacts_and_with_its_limit() {
        let ball = ball(0.8);
        let time = 0.5 * (ball.impact_time(7) + ball.impact_time(8));
        let jumps: f64 = (1..=7).map(|k| 1.8 * ball.impact_speed(k)).sum();
        close(ball.velocity_variation(time), 9.81 * time + jumps, 100.0);
        let limit = 2.0 * 9.81 * ball.first_impact_time() * 9.0;
        close(ball.velocity_variation(10.0), limit, limit);
        assert!((limit - 79.730).abs() < 0.5e-3);
    }

    #[test]
    fn the_velocity_corners_have_the_total_variation_of_the_velocity() {
        for e in [0.0, 0.3, 0.8, 1.0] {
            let ball = ball(e);
            for until in [0.3, 1.0, 2.5, 6.0] {
                let corners = ball.velocity_corners(until);
                let variation: f64 = corners.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs()).sum();
                close(variation, ball.velocity_variation(until), 100.0);
                assert!(corners.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
                assert_eq!(corners[corners.len() - 1][0], until);
                for pair in corners.windows(2).filter(|pair| pair[1][0] - pair[0][0] > 1e-6) {
                    let middle = 0.5 * (pair[0][0] + pair[1][0]);
                    close(ball.state(middle).1, 0.5 * (pair[0][1] + pair[1][1]), 100.0);
                }
            }
        }
    }

    #[test]
    fn numbers_that_cannot_be_meant_are_refused() {
        for (gravity, height, restitution) in
            [(0.0, 1.0, 0.5), (9.81, -1.0, 0.5), (9.81, 1.0, 1.5), (f64::NAN, 1.0, 0.5), (9.81, 1.0, f64::NAN)]
        {
            assert!(BouncingBall::new(gravity, height, restitution).is_err());
        }
    }
}
