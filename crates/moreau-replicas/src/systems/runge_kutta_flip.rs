//! Runge–Kutta with a flip of the velocity where a step ends in an obstacle: what an integrator without contact is made to do.
//!
//! ```text
//!     (q⁺, v_free) = RK4(q, v) ,   v⁺ = −e v_free if φ(q⁺) ≤ 0 and v_free < 0         spring: |R|² = 1 − s⁶/72 + s⁸/576
//! ```

use super::planted::{ahead, heavy};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, System, on_a_ball, on_a_spring};
use moreau_checks::defects::schemes::{AHEAD, HEAVY};
use moreau_dynamics::exact_particle::{Ball, BallState};
use moreau_dynamics::integrators::RungeKutta;
use moreau_dynamics::schemes::RungeKuttaFlip;
use moreau_exact::scalar::{Rational, ratio};

pub static SYSTEM: System = System {
    name: "Runge–Kutta with a flip",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e on the velocity that arrives",
    position_update: "classical Runge–Kutta, not corrected by the impulse",
    schemes: &["runge-kutta-flip"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "state after each step of a spring, relative",
            unit: "1",
            measure: |_| on_a_spring::steps(&RungeKuttaFlip, &RungeKutta),
            planted: &[ahead(|_| on_a_spring::steps(&AHEAD.subject.of(RungeKuttaFlip), &RungeKutta))],
        },
        Agreement {
            against: "closed form",
            quantity: "the spring's energy, (1 − s⁶/72 + s⁸/576)ⁿ, relative",
            unit: "1",
            measure: |_| on_a_spring::energy(&RungeKuttaFlip, amplification(), 0.0),
            planted: &[ahead(|_| on_a_spring::energy(&AHEAD.subject.of(RungeKuttaFlip), amplification(), 0.0))],
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball",
            unit: "m/s",
            measure: |_| on_a_ball::velocities(&RungeKuttaFlip, flip),
            planted: &[heavy(|_| on_a_ball::velocities(&HEAVY.subject.of(RungeKuttaFlip), flip))],
        },
    ],
};

/// |R|² at s = hω.
fn amplification() -> f64 {
    let s = on_a_spring::STEP;
    1.0 - s.powi(6) / 72.0 + s.powi(8) / 576.0
}

/// Constant gravity: the parabola, then the flip.
fn flip(ball: &Ball<Rational>, now: &BallState<Rational>, h: &Rational) -> BallState<Rational> {
    let free = &now.velocity - &ball.gravity * h;
    let position = &now.position + h * (&now.velocity + &free) * ratio(1, 2);
    let zero = ratio(0, 1);
    let velocity = if position <= zero && free < zero { -(&ball.restitution * free) } else { free };
    BallState { position, velocity }
}
