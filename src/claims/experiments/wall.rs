//! A mass of 1 kg that flies at 1 m/s to a wall ⅓ m away, without forces, stepped in rationals with h = 2⁻ᵏ s to t = 1 s.
//!
//! ```text
//!     v(t) = −1 for t < ⅓, e after it ,     P = (1 + e) δ_⅓
//!     v_h = v_{n+1} on (t_n, t_{n+1}] ,      P_h = Σ P_{n+1} δ_{t_{n+1}}
//! ```
//! ⅓ = (n + c) h with c = ⅓ for even k and ⅔ for odd k: no step of a power of two ends at the impact.

use crate::checks::Finding;
use crate::exact_particle::{Ball, BallState, BallStep};
use crate::scalar::{Rational, Scalar, ratio};
use crate::schemes::Activation;

/// How the steps are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepping {
    /// Stewart–Trinkle, plastic.
    StewartTrinkle,
    /// Moreau–Jean with activation at φ ≤ 0 and e = ½, θ = ½.
    MoreauJean,
    /// The same, plastic.
    PlasticMoreauJean,
}

/// The motion in steps.
pub struct Approach {
    /// h \[s\].
    pub step: Rational,
    /// Each step's end and impulse.
    pub outcomes: Vec<BallStep<Rational>>,
}

/// The motion with h = 2⁻ᵏ s.
pub fn approach(stepping: Stepping, k: u32) -> Approach {
    let (steps, half) = (1usize << k, ratio(1, 2));
    let step = ratio(1, steps as i64);
    let restitution = if stepping == Stepping::PlasticMoreauJean { ratio(0, 1) } else { half.clone() };
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution };
    let mut now = BallState { position: ratio(1, 3), velocity: ratio(-1, 1) };
    let outcomes = (0..steps).map(|_| {
        let outcome = match stepping {
            Stepping::StewartTrinkle => ball.stewart_trinkle(&now, &step),
            Stepping::MoreauJean | Stepping::PlasticMoreauJean => ball.moreau_jean(&now, &half, Activation::Gap, &step),
        };
        now = outcome.motion.clone();
        outcome
    });
    Approach { outcomes: outcomes.collect(), step }
}

impl Approach {
    /// The ends of the steps with what happened in them.
    fn ends(&self) -> impl Iterator<Item = (Rational, &BallStep<Rational>)> {
        (1..).map(|n| ratio(n, 1) * &self.step).zip(&self.outcomes)
    }

    /// v_h(t), 0 < t ≤ 1.
    pub fn velocity_at(&self, time: &Rational) -> Rational {
        let step = self.ends().find(|(end, _)| end >= time).map(|(_, outcome)| outcome.motion.velocity.clone());
        step.unwrap_or_else(|| ratio(0, 1))
    }

    /// The total variation of v_h from v = −1 on \[m/s\].
    pub fn variation(&self) -> Rational {
        let mut before = ratio(-1, 1);
        let mut sum = ratio(0, 1);
        for outcome in &self.outcomes {
            let change = &outcome.motion.velocity - &before;
            before = outcome.motion.velocity.clone();
            sum += if change < ratio(0, 1) { -change } else { change };
        }
        sum
    }

    /// ∫|v_h − v| dt for the limit that rebounds at `rebound` \[m\].
    pub fn distance(&self, rebound: &Rational) -> Rational {
        let size = |x: Rational| if x < ratio(0, 1) { -x } else { x };
        let impact = ratio(1, 3);
        self.ends().fold(ratio(0, 1), |sum, (end, outcome)| {
            let start = &end - &self.step;
            let split = if impact <= start {
                start.clone()
            } else if impact >= end {
                end.clone()
            } else {
                impact.clone()
            };
            let v = &outcome.motion.velocity;
            sum + (&split - start) * size(v + ratio(1, 1)) + (end - split) * size(v - rebound)
        })
    }

    /// ∫ g dP_h.
    pub fn tested(&self, g: impl Fn(&Rational) -> Rational) -> Rational {
        self.ends().fold(ratio(0, 1), |sum, (end, outcome)| sum + g(&end) * &outcome.impulse)
    }

    /// P_h of the times within `width` of `centre` \[N·s\].
    pub fn window(&self, centre: &Rational, width: &Rational) -> Rational {
        self.tested(|time| ratio(i64::from((time - centre) <= *width && (centre - time) <= *width), 1))
    }

    /// Σ f(v_n, v_{n+1}) P_{n+1} \[J\].
    pub fn work(&self, f: impl Fn(&Rational, &Rational) -> Rational) -> Rational {
        let mut before = ratio(-1, 1);
        self.outcomes.iter().fold(ratio(0, 1), |sum, outcome| {
            let after = outcome.motion.velocity.clone();
            let part = f(&before, &after) * &outcome.impulse;
            before = after;
            sum + part
        })
    }
}

/// A continuous function of slope at most 2 on \[0, 1\], with its name.
type Test = (&'static str, fn(&Rational) -> Rational);

/// What the impulses are tested with; none of them vanishes at ⅓.
pub const TESTS: [Test; 3] =
    [("t", |t| t.clone()), ("t²", |t| t * t), ("|t − 1/2|", |t| if *t > ratio(1, 2) { t - ratio(1, 2) } else { ratio(1, 2) - t })];

/// |∫g dP_h − m g(⅓)| \[N·s\].
pub fn weak_error(approach: &Approach, g: fn(&Rational) -> Rational, mass: &Rational) -> Rational {
    (approach.tested(g) - g(&ratio(1, 3)) * mass).magnitude()
}

/// What [`weak_error`] may be for a slope of at most 2: all of P_h lies within 2h of ⅓, which makes 4 h m \[N·s\].
pub fn weak_bound(approach: &Approach, mass: &Rational) -> Rational {
    ratio(4, 1) * &approach.step * mass
}

/// The error of a motion for each of the three functions, against its bound.
pub fn weakly(approach: &Approach, mass: &Rational, label: &str) -> Vec<Finding> {
    let bound = Scalar::to_f64(&weak_bound(approach, mass));
    let finding = |(name, g): Test| {
        let error = Scalar::to_f64(&weak_error(approach, g, mass));
        Finding::at_most(format!("error of ∫g dP_h, g = {name}, {label}"), error, bound, "N·s")
    };
    TESTS.map(finding).to_vec()
}

/// The mass of P_h − m δ_⅓: no step ends at ⅓.
pub fn mass_apart(approach: &Approach, mass: &Rational) -> Rational {
    let at_impact = approach.window(&ratio(1, 3), &ratio(0, 1));
    approach.tested(|_| ratio(1, 1)) - &at_impact + (at_impact - mass).magnitude()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impact_lies_where_the_steps_say() {
        for k in [4, 5] {
            let (plastic, c) = (approach(Stepping::StewartTrinkle, k), ratio(if k % 2 == 0 { 1 } else { 2 }, 3));
            assert_eq!(plastic.velocity_at(&ratio(1, 3)), -&c);
            assert_eq!(plastic.outcomes.iter().map(|one| one.impulse.clone()).fold(ratio(0, 1), |a, b| a + b), ratio(1, 1));
            assert_eq!(plastic.distance(&ratio(0, 1)), ratio(2, 1) * &c * (ratio(1, 1) - &c) * &plastic.step);
        }
    }
}
