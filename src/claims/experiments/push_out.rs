//! What it costs to move a sunken body out: projection, and a velocity bias.
//!
//! ```text
//!     projection   q ← max(q, 0) after the step, v untouched:     ΔE = m g δ
//!     velocity bias, ERP   v⁺ ≥ −ERP φ/h while φ < 0:             ΔT = ½ m (ERP δ/h)² from rest, and the lift on top
//! ```

use crate::exact_particle::{Ball, BallState};
use crate::scalar::{Rational, Scalar, ratio};
use crate::schemes::Activation;

/// A ball of 1 kg, g = 10 m/s².
pub fn ball<T: Scalar>(restitution: T) -> Ball<T> {
    Ball { mass: T::one(), gravity: T::ratio(10, 1), restitution }
}

/// Outcome of an elastic drop from 1 m over 20 s.
pub struct Drop<T> {
    /// E(20 s)/E(0).
    pub energy: T,
    /// Σ m g δ over all projections, over E(0).
    pub lift: T,
    /// How often the position was projected.
    pub projections: usize,
}

/// The elastic ball under Moreau–Jean with θ = ½ and h = 1/100 s, its position projected onto q ≥ 0 after each step or not.
pub fn elastic_drop<T: Scalar>(activation: Activation, project: bool) -> Drop<T> {
    elastic_throw(T::zero(), activation, project)
}

/// The same, thrown upwards with a velocity \[m/s\].
pub fn elastic_throw<T: Scalar>(velocity: T, activation: Activation, project: bool) -> Drop<T> {
    throw(T::one(), velocity, activation, project)
}

/// The same with another coefficient of restitution.
pub fn throw<T: Scalar>(restitution: T, velocity: T, activation: Activation, project: bool) -> Drop<T> {
    let (ball, h) = (ball(restitution), T::ratio(1, 100));
    let mut now = BallState { position: T::one(), velocity };
    let start = ball.energy(&now);
    let mut drop = Drop { energy: T::one(), lift: T::zero(), projections: 0 };
    for _ in 0..2000 {
        now = ball.moreau_jean(&now, &T::ratio(1, 2), activation, &h).motion;
        if project && now.position < T::zero() {
            drop.lift -= ball.gravity.clone() * now.position.clone() / start.clone();
            drop.projections += 1;
            now.position = T::zero();
        }
    }
    drop.energy = ball.energy(&now) / start;
    drop
}

/// One step of a plastic ball whose contact asks for v⁺ ≥ −ERP φ/h while it is closed; position update q + h v⁺.
pub fn biased_step(ball: &Ball<Rational>, now: &BallState<Rational>, erp: &Rational, h: &Rational) -> BallState<Rational> {
    let free = now.velocity.clone() - ball.gravity.clone() * h.clone();
    let wanted = -(erp.clone() * now.position.clone()) / h.clone();
    let velocity = if now.position <= ratio(0, 1) && free < wanted { wanted } else { free };
    BallState { position: now.position.clone() + h.clone() * velocity.clone(), velocity }
}

/// Gain of kinetic and of potential energy \[J\] over one step of 1/60 s of a plastic ball that rested 1 mm deep, with a velocity bias.
pub fn biased_gain(erp: &Rational, gravity: &Rational) -> [Rational; 2] {
    let ball = Ball { gravity: gravity.clone(), ..ball(ratio(0, 1)) };
    let sunk = sunk();
    let next = biased_step(&ball, &sunk, erp, &ratio(1, 60));
    [ball.kinetic_energy(&next.velocity), gravity.clone() * (next.position - sunk.position)]
}

/// The same for a step without bias whose position is then projected.
pub fn projected_gain(gravity: &Rational) -> [Rational; 2] {
    let ball = Ball { gravity: gravity.clone(), ..ball(ratio(0, 1)) };
    let sunk = sunk();
    let next = ball.moreau_jean(&sunk, &ratio(1, 1), Activation::Gap, &ratio(1, 60)).motion;
    [ball.kinetic_energy(&next.velocity), -(gravity.clone() * sunk.position)]
}

/// At rest, 1 mm deep.
pub fn sunk() -> BallState<Rational> {
    BallState { position: ratio(-1, 1000), velocity: ratio(0, 1) }
}
