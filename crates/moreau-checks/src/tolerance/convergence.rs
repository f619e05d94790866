//! What the errors of a Moreau–Jean scheme on the bouncing ball are to leading order, and how far they may stray.
//!
//! # The motion between impacts
//! With constant gravity, q_j lies on the exact parabola through any node whose velocity there is ṽ_j = v_j − (θ−½) g h.
//! So the discrete motion is a chain of exact flights, and only the impacts err. Let the flight that ends at impact n
//! have landing time L′ and landing speed W′, and let the active node be at L′ + s. An activation rule decides s:
//! φ + λ h u ≤ 0 (λ = 0 rule A, ½ rule B, 1 rule D) holds first at a node with s ∈ \[−λ h, (1−λ) h).
//! The step there gives v⁺ = −e v and q⁺ = q + h(θv⁺ + (1−θ)v); its parabola leaves the floor at T′ with speed W″:
//! ```text
//!     T′ = L′ + (1+e)/e · p ,    W″ = e W′ − g (1−e²)/e · p + ½(1−e) g h ,    p = s + (1−θ) h ,
//! ```
//! up to second order in h. Summing over n impacts, with p_i of impact i and m = n−1−i:
//! ```text
//!     launch   b_n  = −(θ−½) h + Σ_i [ (1+e)/e (2eᵐ − 1) p_i + (1 − eᵐ) h ]              (T′ − t_n)
//!     landing  b̂_n  = −(θ−½) h + Σ_i [ (1+e)/e (2eᵐ⁺¹ − 1) p_i + (1 − eᵐ⁺¹) h ]          (L′ − t_{n+1})
//!     velocity c_n  =            Σ_i [ (1+e)/e ((1+e)eᵐ − 1) p_i + (1 − ½(1+e)eᵐ) h ]    ((v_j − v(t_j))/g)
//! ```
//! The position error in flight n is affine between −W_n b_n and +W_n b̂_n, with W_n = eⁿV.
//!
//! # Bounds
//! All p_i are independent in \[1−λ−θ, 2−λ−θ\]·h: the largest of each sum is the upper bound. Of the first impact the phase
//! is known, because the steps h = t₁/(N + (j+½)/m) put it there: the best of m phases is the lower bound of the
//! envelope. Lengths are in V h, times in h, N = t₁/h. Terms of second order are bounded per impact by
//! (6 + ½B²) g h² in position – ½s² ≤ ½, h|v_k − W|(1+e) ≤ 2, ½x² ≤ 3.2 at the node x ≤ 2.5 h after the impact,
//! and ½b² from the shift B = max(|b_n|, |b̂_n|)/h – and by (6 + 5B²) g h² in ∫|v|: 2B² from the speed, 3B² from timing.
//!
//! # Zeno
//! From flight n on both motions stay below twice the apex e²ⁿ V t₁/2, within speeds 2eⁿV and within the remaining time
//! 2eⁿt₁/(1−e); cutting there bounds the rest, and any n may be chosen. The graph bound then grows like n ~ ln N.

use moreau_exact::tolerance::rounding;

/// Bounds of one error metric, in the unit of that metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower bound of the envelope over the shifted steps.
    pub lower: f64,
    /// Upper bound of the error at every step size.
    pub upper: f64,
}

/// Everything the leading terms depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impacts {
    /// θ.
    pub theta: f64,
    /// λ of the activation rule φ + λ h u ≤ 0.
    pub forecast: f64,
    /// e ∈ (0, 1\].
    pub restitution: f64,
    /// m, the number of shifted steps per level.
    pub shifts: usize,
    /// Impacts within the horizon; `None` if it ends past T∞.
    pub impacts: Option<usize>,
    /// The horizon in units of t₁.
    pub horizon: f64,
}

/// Which of the three sums.
#[derive(Clone, Copy)]
enum Shift {
    Launch,
    Landing,
    Velocity,
}

impl Impacts {
    /// p ∈ \[1−λ−θ, 2−λ−θ\] in units of h.
    /// Derived.
    pub fn offsets(&self) -> [f64; 2] {
        let low = 1.0 - self.forecast - self.theta;
        [low, low + 1.0]
    }

    /// The values of p at the first impact that the shifted steps produce.
    /// Derived.
    pub fn phases(&self) -> impl Iterator<Item = f64> {
        let (low, count) = (self.offsets()[0], self.shifts as f64);
        (0..self.shifts).map(move |j| low + (j as f64 + 0.5) / count)
    }

    /// Bounds of max |q_k − q(t_k)| in units of V h, with N steps to the first impact.
    /// Derived.
    pub fn position(&self, intervals: f64) -> Bounds {
        let e = self.restitution;
        let before = (self.theta - 0.5).abs();
        let launch = self.phases().map(|p| e * magnitude(self.sum(Shift::Launch, 1, Some(p)))).fold(before, f64::max);
        let tail = |n: usize| e.powi(2 * n as i32) * intervals;
        let mut worst = before;
        let upper = self.cut(tail, |n| {
            let remainder = (1..=n).map(|i| 6.0 + 0.5 * self.shift(i).powi(2)).sum::<f64>() / intervals;
            worst = worst.max(e.powi(n as i32) * self.shift(n) + remainder);
            worst
        });
        Bounds { lower: launch - (6.0 + 0.5 * self.shift(1).powi(2)) / intervals, upper }
    }

    /// ∫|v_h − v| dt in V h. In flight n the step function differs by c − u with u running through \[0, 1\] in each step,
    /// so its mean is ∫₀¹|c_n − u| du; the jump that ends it adds (1+e)eⁿ|b̂_n + s|.
    /// Derived.
    pub fn velocity_l1(&self, intervals: f64) -> Bounds {
        let e = self.restitution;
        let second_order = |n: usize| (6.0 + 5.0 * self.shift(n).powi(2)) / intervals;
        let first = |p: f64| {
            let [c, _] = self.sum(Shift::Velocity, 1, Some(p));
            (1.0 + e) * (p - 0.5).abs() + self.duration(1) * mean_distance(c)
        };
        let lower = 0.5 + self.phases().map(first).fold(0.0, f64::max) - second_order(1);
        let tail = |n: usize| 4.0 * e.powi(2 * n as i32) / (1.0 - e) * intervals;
        let mut sum = 0.5 + (1.0 + e) * self.jump(0);
        let upper = self.cut(tail, |n| {
            let [low, high] = self.sum(Shift::Velocity, n, None);
            sum += self.duration(n) * mean_distance(low).max(mean_distance(high)) + second_order(n);
            if Some(n) != self.impacts {
                sum += (1.0 + e) * e.powi(n as i32) * self.jump(n);
            }
            sum
        });
        Bounds { lower, upper }
    }

    /// Bounds of ess sup |v_h − v| in units of V. The error is the jump (1+e)V, which gravity changes over at most 3 steps.
    /// Derived.
    pub fn velocity_sup(&self, intervals: f64) -> Bounds {
        let jump = 1.0 + self.restitution;
        let shift = (1..=self.impacts.unwrap_or(4)).map(|n| self.stairs(n)).fold(0.0, f64::max);
        Bounds { lower: jump - 3.0 / intervals, upper: jump + (3.0 + shift) / intervals }
    }

    /// Distance of filled-in graphs in h/t₁.
    ///
    /// In flight n the steps lie between c − 1 and c above a line of slope −1: they are max(|c|, |c−1|)/√2 from it, which
    /// the best phase of the first impact attains, and 1/√2 before it. Near a jump shifted by x one moves √2 x along
    /// the line first: at most √2 x + max(|c|, |c−1|).
    /// Derived.
    pub fn graph(&self, intervals: f64) -> Bounds {
        let attained = |p: f64| {
            let [c, _] = self.sum(Shift::Velocity, 1, Some(p));
            c.abs().max((c - 1.0).abs())
        };
        let lower = std::f64::consts::FRAC_1_SQRT_2 * self.phases().map(attained).fold(1.0, f64::max);
        let tail = |n: usize| 2.0 * self.restitution.powi(n as i32) * intervals;
        let (mut worst, mut remainder) = (1.0 + std::f64::consts::SQRT_2 * self.jump(0), 0.0);
        let upper = self.cut(tail, |n| {
            // Second order in a shift of time is divided by the speed eⁿV.
            remainder += (6.0 + 5.0 * self.shift(n).powi(2)) / (intervals * self.restitution.powi(n as i32));
            let end = if Some(n) == self.impacts { 0.0 } else { self.jump(n) };
            worst = worst.max(std::f64::consts::SQRT_2 * end.max(self.jump(n - 1)) + self.stairs(n) + remainder);
            worst
        });
        Bounds { lower: lower - 3.0 / intervals, upper }
    }

    /// max(|c_n|, |c_n − 1|).
    fn stairs(&self, n: usize) -> f64 {
        let [low, high] = self.sum(Shift::Velocity, n, None);
        magnitude([low - 1.0, high])
    }

    /// Duration of flight n within the horizon, in t₁: 2eⁿ, or what is left after the last impact.
    fn duration(&self, n: usize) -> f64 {
        if Some(n) != self.impacts {
            return 2.0 * self.restitution.powi(n as i32);
        }
        self.horizon - 1.0 - (1..n).map(|i| 2.0 * self.restitution.powi(i as i32)).sum::<f64>()
    }

    /// The bound after all impacts, or the best cut of a Zeno sequence: min over n of max(bound to n, tail from n).
    fn cut(&self, tail: impl Fn(usize) -> f64, mut bound: impl FnMut(usize) -> f64) -> f64 {
        if let Some(impacts) = self.impacts {
            return (1..=impacts).map(bound).fold(0.0, f64::max);
        }
        let (mut best, mut n) = (f64::INFINITY, 1);
        loop {
            let (to, from) = (bound(n), tail(n));
            best = best.min(to + from);
            if from <= to / 64.0 {
                return best;
            }
            n += 1;
        }
    }

    /// max(|b_n|, |b̂_n|)/h.
    fn shift(&self, n: usize) -> f64 {
        magnitude(self.sum(Shift::Launch, n, None)).max(magnitude(self.sum(Shift::Landing, n, None)))
    }

    /// |b̂_n + s|/h: how far the jump that ends flight n is from its time.
    fn jump(&self, n: usize) -> f64 {
        let [low, high] = self.sum(Shift::Landing, n, None);
        magnitude([low - self.forecast, high + 1.0 - self.forecast])
    }

    /// The interval of one of the three sums, in h, with p of the first impact given or free.
    fn sum(&self, shift: Shift, n: usize, first: Option<f64>) -> [f64; 2] {
        let e = self.restitution;
        let start = match shift {
            Shift::Velocity => 0.0,
            Shift::Launch | Shift::Landing => 0.5 - self.theta,
        };
        (0..n).fold([start; 2], |[low, high], i| {
            let power = e.powi((n - 1 - i) as i32);
            let (slope, constant) = match shift {
                Shift::Launch => (2.0 * power - 1.0, 1.0 - power),
                Shift::Landing => (2.0 * power * e - 1.0, 1.0 - power * e),
                Shift::Velocity => ((1.0 + e) * power - 1.0, 1.0 - 0.5 * (1.0 + e) * power),
            };
            let range = if i == 0 { first.map_or(self.offsets(), |p| [p, p]) } else { self.offsets() };
            let [a, b] = range.map(|p| (1.0 + e) / e * slope * p + constant);
            [low + a.min(b), high + a.max(b)]
        })
    }
}

/// ∫₀¹ |c − u| du.
fn mean_distance(c: f64) -> f64 {
    if (0.0..=1.0).contains(&c) { 0.5 * (c * c + (1.0 - c) * (1.0 - c)) } else { (c - 0.5).abs() }
}

/// The largest absolute value in an interval.
fn magnitude([low, high]: [f64; 2]) -> f64 {
    low.abs().max(high.abs())
}

/// Rounding of a motion of `steps` steps along a slope with speeds and lengths below 16: each step adds at most 16
/// roundings of numbers below 16, and a creep speed divides by a duration of at least ½.
/// Derived.
pub fn slide_rounding(steps: usize) -> f64 {
    2.0 * rounding(16 * steps, 16.0)
}

/// Relative second-order part of the errors of a slide of `steps` steps with 0 < μ² ≤ ¼.
///
/// Under Coulomb's law the leading term is exact. Under the associated law the deficit a h μ² is reached as
/// a h μ²(1 − rˡ), r = μ²/(1+μ²): over all steps μ² Σ rˡ ≤ μ²(1+μ²) steps' worth of a h is missing, relative to n steps of
/// at least ¼ a h each (½ − μ² of the position, ½\[(1−μ²)² + μ⁴\] of ∫|v|). Rounding is far below.
/// Derived.
pub fn slide_second_order(friction: f64, steps: usize) -> f64 {
    let squared = friction * friction;
    4.0 * squared * (1.0 + squared) / steps as f64
}
