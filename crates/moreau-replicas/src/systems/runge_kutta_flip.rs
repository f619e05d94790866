//! Runge–Kutta with a flip of the velocity where a step ends in an obstacle: what an integrator without contact is made to do.
//!
//! ```text
//!     (q⁺, v_free) = RK4(q, v) ,   v⁺ = −e v_free if φ(q⁺) ≤ 0 and v_free < 0         spring: |R|² = 1 − s⁶/72 + s⁸/576
//! ```

use super::planted::{Mistake, planted};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, PlantedMistake, System, on_a_ball, on_a_spring};
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
            planted: &[PlantedMistake {
                mistake: "positions moved on by half the change of velocity as well",
                measure: |_| on_a_spring::steps(&planted(RungeKuttaFlip, Mistake::Ahead), &RungeKutta),
            }],
        },
        Agreement {
            against: "closed form",
            quantity: "the spring's energy, (1 − s⁶/72 + s⁸/576)ⁿ, relative",
            unit: "1",
            measure: |_| on_a_spring::energy(&RungeKuttaFlip, amplification(), 0.0),
            planted: &[PlantedMistake {
                mistake: "positions moved on by half the change of velocity as well",
                measure: |_| on_a_spring::energy(&planted(RungeKuttaFlip, Mistake::Ahead), amplification(), 0.0),
            }],
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball",
            unit: "m/s",
            measure: |_| on_a_ball::velocities(&RungeKuttaFlip, flip),
            planted: &[PlantedMistake {
                mistake: "forces 10 % too strong",
                measure: |_| on_a_ball::velocities(&planted(RungeKuttaFlip, Mistake::Heavy), flip),
            }],
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
