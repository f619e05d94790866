//! How a Moreau–Jean step carries the bouncing ball through its Zeno point: bounds, with their proofs.
//!
//! # Units and steps
//! Lengths in g h², speeds in g h, time in steps; x = q/(g h²), w = v/(g h). A step is
//! ```text
//!     not active:  w⁺ = w − 1 ,      active:  w⁺ = max(w − 1, −e w) ,      x⁺ = x + θ w⁺ + (1−θ) w ,
//! ```
//! active when x + a w ≤ b with (a, b) = (0, 0) for rule A, (½, 0) for B, (1, 1) for D. An active step with
//! w > 1/(1+e) is a free step. Assume ½ ≤ θ ≤ 1 and 0 < e < 1, and write κ = θ + a ≥ ½. The ball starts at rest and
//! high; σ_k = e^k σ₀ are its exact impact speeds, T∞ = σ₀ (1+e)/(1−e).
//!
//! # 1. Energy
//! `E = ½w² + x + (½−θ) w` is conserved by free steps; a step w → −e w changes it by `½(1−e) w (1 − (1+e) w)`
//! (substitute). A bounce (w = −s < 0) therefore loses `½(1−e) s (1 + (1+e) s)`; a catch (0 ≤ w ≤ 1/(1+e)) gains at
//! most (1−e)/(8(1+e)).
//!
//! # 2. Where a bounce happens
//! After an inactive step, x = x₋ + w₋ − θ with w₋ = w + 1 and x₋ + a w₋ > b, so a bounce of speed s has
//! `b − (1−a)(s−1) − θ < x ≤ b + a s`.
//!
//! # 3. From bounce to bounce
//! Let the next bounce have speed s', and y = e s. Energy conservation between the two with the interval of 2 gives
//! ```text
//!     ½s'² + p s' ≤ ½y² + q y + r    with p = κ − 3/2, q = ½ + (κ−1)/e, r = κ − 1 ,
//!     ½s'² + p s' ≥ ½y² + q y + r    with p = κ − ½,  q = ½ + (κ−2)/e, r = 1 − κ .
//! ```
//! Completing squares, s' ≤ y + δ₊ with δ₊ = q − p + √(p² − q² + 2r)₊ from the first line and s' ≥ y − δ₋ with
//! δ₋ = p − q + √(q² − p² − 2r)₊ from the second; δ = max(δ₊, δ₋). The same argument from the start to the first
//! bounce gives |s₀ − σ₀| ≤ δ₀. By induction |s_k − σ_k| ≤ Δ = δ₀ + δ/(1−e).
//!
//! # 4. No capture while fast
//! A ball caught at its apex has E ≤ b + ½, and after a bounce E > ½y² + q₋y + b + 1 − κ. Hence it is not caught, and
//! the next bounce is faster than 1, while s ≥ S = max(1 + δ₋, −q₋ + √(q₋² + 2κ − 1))/e. Let K be the number of
//! k with σ_k ≥ S + Δ: bounces 0…K take place.
//!
//! # 5. Time up to bounce K
//! From bounce to bounce pass e s + s' + 1 steps, against e σ_k + σ_{k+1} exactly; so bounce K comes within
//! Δ + K(1+e)Δ + K steps of its exact time, which precedes T∞ by 2eσ_K/(1−e). As K = O(log(V/(g h))), the settling
//! time is early by at most O(log 1/h) steps: O(h log 1/h) seconds.
//!
//! # 6. After bounce K
//! Speeds stay below S₁ = σ_K + Δ. Two consecutive active states with |w| ≤ 1/(1+e) are absorbing: from there
//! w_j = (−e)^j w, and x_j + a w_j lies between its first two values, both ≤ b, so every later step is active. Before
//! that, a catch is followed at once by a fall and a bounce that loses at least eight times the catch's gain. So the
//! energy intervals of the bounces, shortened by an eighth, do not overlap, and Σs = Σ loss/(½(1−e)(1+(1+e)s)) is at
//! most 8/7 of the integral of 1/(½(1−e)(1+(1+e)s)) over the energy, where E ≤ ½s² + (κ−½)s + b by 2:
//! ```text
//!     Σ s ≤ 8/7 · 2/(1−e) · ( S₁ max(1/(1+e), κ−½) + κ − 1 + ⅛ − min(½y² + q₋y) ) ,    0 ≤ y ≤ e S₁ ,
//! ```
//! the last terms being the lowest energy a bounce can leave. Free steps lower w by 1 each, bounces raise it by
//! (1+e)s: at most (1+e)Σs + 1 free steps. Between two free flights lie at most three active steps, so the ball
//! is absorbed within 4((1+e)Σs + 2) steps after bounce K.
//!
//! # 7. Where it comes to rest
//! In the limit w = 0 an active state has x ≤ b. The energy left by the last bounce is at least b + 1 − κ +
//! min(½y² + q₋y) − ⅛ (a second bounce within one step costs at most ⅛), and the final contraction costs at most ⅛.

use moreau_exact::tolerance::rounding;

/// The numbers of one drop: scheme, restitution and σ₀ = V/(g h).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drop {
    /// a of the activation rule x + a w ≤ b.
    pub forecast: f64,
    /// b of the activation rule x + a w ≤ b.
    pub offset: f64,
    /// θ ∈ \[½, 1\].
    pub theta: f64,
    /// e ∈ (0, 1).
    pub restitution: f64,
    /// σ₀, speed of the first exact impact in units of g h.
    pub impact_speed: f64,
}

/// Bounds in steps and units of g h².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// K of 4: bounces that surely take place.
    pub bounces: i32,
    /// By how many steps the ball may be absorbed before T∞ (section 5 of the header).
    pub early: f64,
    /// By how many steps the ball may be absorbed after T∞ (sections 5 and 6 of the header).
    pub late: f64,
    /// How deep the ball may be at any time, in g h² (section 2 of the header, plus one for the moves of less than a step's fall).
    pub depth: f64,
    /// Lowest and highest place of rest, in g h² (section 7 of the header).
    pub rest: [f64; 2],
}

impl Drop {
    /// T∞ in steps, σ₀ (1+e)/(1−e).
    /// Derived.
    pub fn accumulation(&self) -> f64 {
        self.impact_speed * (1.0 + self.restitution) / (1.0 - self.restitution)
    }

    /// δ₀ of 3, how far the first impact speed is from the exact one, in g h; the restitution plays no part.
    ///
    /// Energy conservation from rest at x₀ = ½σ₀² to a bounce in the interval of 2 gives
    /// ½s² + (κ−3/2)s ≤ ½σ₀² − b + κ − 1 and ½s² + (κ−½)s ≥ ½σ₀² − b.
    /// Derived.
    pub fn first_impact(&self) -> f64 {
        let kappa = self.theta + self.forecast;
        let above = 1.5 - kappa + root((kappa - 1.5).powi(2) + 2.0 * (kappa - 1.0 - self.offset));
        let below = kappa - 0.5 + root(2.0 * self.offset - (kappa - 0.5).powi(2));
        above.max(below)
    }

    /// The bounds proved in the header of this module.
    /// Derived.
    pub fn bounds(&self) -> Bounds {
        let Drop { forecast: a, offset: b, theta, restitution: e, impact_speed: sigma } = *self;
        let kappa = theta + a;
        let q_minus = 0.5 + (kappa - 2.0) / e;
        let delta_minus = {
            let (p, q, r) = (kappa - 0.5, q_minus, 1.0 - kappa);
            p - q + root(q * q - p * p - 2.0 * r)
        };
        let delta_plus = {
            let (p, q, r) = (kappa - 1.5, 0.5 + (kappa - 1.0) / e, kappa - 1.0);
            q - p + root(p * p - q * q + 2.0 * r)
        };
        let first_impact = self.first_impact();
        let deviation = first_impact + delta_minus.max(delta_plus) / (1.0 - e);
        let fast = (1.0 + delta_minus).max(-q_minus + root(q_minus * q_minus + 2.0 * kappa - 1.0)) / e;
        let bounces = bounces_above(sigma, e, fast + deviation);
        let slow = e.powi(bounces) * sigma;
        let lowest = {
            let y = (-q_minus).max(0.0).min(e * (slow + deviation));
            0.5 * y * y + q_minus * y
        };
        let speeds = {
            let top = (slow + deviation) * (kappa - 0.5).max(1.0 / (1.0 + e));
            8.0 / 7.0 * 2.0 / (1.0 - e) * (top + (kappa - 1.0 + 0.125 - lowest).max(0.0))
        };
        let error = deviation + f64::from(bounces) * (1.0 + (1.0 + e) * deviation);
        let impact = sigma + first_impact;
        let depth = (1.0 - a) * (impact - 1.0) + theta - b + (1.0 - theta - theta * e).max(0.0) * impact;
        Bounds {
            bounces,
            early: error + 2.0 * e * slow / (1.0 - e),
            late: error + 4.0 * ((1.0 + e) * speeds + 2.0),
            depth: depth.max(0.0) + 1.0,
            rest: [b + 1.0 - kappa + lowest - 0.25, b],
        }
    }

    /// Speed \[g h\] left `steps` steps after absorption: e^steps/(1+e), and the rounding of v − g h + r/m in each
    /// step, which the factor e sums to a geometric series.
    /// Derived.
    pub fn remaining_speed(&self, steps: usize) -> f64 {
        let e = self.restitution;
        e.powf(steps as f64) / (1.0 + e) + rounding(8, 2.0) / (1.0 - e)
    }

    /// sup |q_h − q| \[g h²\] on the steps up to the second apex, t = (1+e)σ₀.
    ///
    /// Up to the bounce both velocities fall alike, up to 1 for the step function; after it they differ by
    /// |e(s₀ − σ₀) + n₀ + 1 − σ₀| ≤ (1+e)δ₀ + 1 and again 1. In the at most δ₀ + 1 steps between the two impacts they
    /// differ by at most (1+e)(σ₀ + δ₀) + δ₀ + 2. The rule θ v⁺ + (1−θ) v adds θ times the variation of v_h,
    /// which is one per step and (1+e)(σ₀ + δ₀) at the bounce.
    /// Derived.
    pub fn position_error(&self) -> f64 {
        let (e, error) = (self.restitution, self.first_impact());
        let steps = (1.0 + e) * self.impact_speed;
        let jump = (1.0 + e) * (self.impact_speed + error);
        steps * ((1.0 + e) * error + 2.0) + (error + 1.0) * (jump + error + 2.0) + self.theta * (steps + jump)
    }

    /// Rounding of a place \[g h²\] after n steps: one addition of size max|x| each.
    /// Derived.
    pub fn place_rounding(&self, steps: usize) -> f64 {
        rounding(2 * steps, self.impact_speed * self.impact_speed)
    }
}

/// √x, 0 for negative x.
fn root(x: f64) -> f64 {
    x.max(0.0).sqrt()
}

/// The number of k ≥ 0 with e^k σ ≥ `threshold`.
fn bounces_above(sigma: f64, e: f64, threshold: f64) -> i32 {
    let mut speed = sigma;
    let mut count = 0;
    while speed >= threshold {
        speed *= e;
        count += 1;
    }
    count
}

/// Speed at which a ball under rule C (φ + h v ≤ 0 and v ≤ 0) sinks, in g h: (1−e)/(2(1+e)).
///
/// At rest the rule alternates: w = −s is active and becomes e s; w = e s > 0 is not active and becomes e s − 1. The
/// cycle closes for s = 1/(1+e), and in its two steps x falls by (1−e)s for every θ.
/// Derived.
pub fn sinking_speed(restitution: f64) -> f64 {
    (1.0 - restitution) / (2.0 * (1.0 + restitution))
}

/// Steps after which the sinking speed of a ball with e ≤ 0.9, dropped from at most 10 steps of fall, is measured: it
/// bounces for at most 190 steps, and the 2-cycle is approached by the factor e every two steps.
/// Set.
pub const SINKING_STEPS: usize = 1000;

/// Error \[m/s\] of a sinking speed measured over the last two steps: the difference of two places, each the result of fewer
/// than 16 operations on lengths of at most |q| + g h², divided by 2h; and what 400 contractions leave of g h.
/// Derived.
pub fn sinking_error(position: f64, gravity: f64, h: f64, restitution: f64) -> f64 {
    rounding(2 * 16, position + gravity * h * h) / (2.0 * h) + gravity * h * contraction(restitution, 400, 1.0)
}

/// What is left of a deviation after `steps` contractions by e, and the rounding of a number of size 1.
/// Derived.
pub fn contraction(restitution: f64, steps: i32, deviation: f64) -> f64 {
    restitution.powi(steps) * deviation + rounding(4, 1.0)
}
