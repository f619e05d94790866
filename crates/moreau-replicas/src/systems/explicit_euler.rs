//! Explicit Euler: every force and the position update at the old state.
//!
//! ```text
//!     v⁺ = v + h M⁻¹F(q, v) + M⁻¹Hᵀr ,   q⁺ = q + h v          spring: |R|² = 1 + s²
//! ```

use super::planted::ahead;
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball, on_a_spring};
use moreau_checks::defects::schemes::AHEAD;
use moreau_dynamics::integrators::ExplicitEuler;
use moreau_dynamics::schemes::{Activation, Euler, Scheme};
use moreau_exact::Result;
use moreau_exact::scalar::ratio;

pub static SYSTEM: System = System {
    name: "explicit Euler",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e",
    position_update: "q + h v",
    schemes: &["explicit-euler"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "state after each step of a spring, relative",
            unit: "1",
            measure: |_| on_a_spring::steps(&Euler::Explicit, &ExplicitEuler),
            planted: &[ahead(|_| on_a_spring::steps(&AHEAD.subject.of(Euler::Explicit), &ExplicitEuler))],
        },
        Agreement {
            against: "closed form",
            quantity: "growth of the spring's energy, (1 + s²)ⁿ, relative",
            unit: "1",
            measure: |_| on_a_spring::energy(&Euler::Explicit, 1.0 + on_a_spring::STEP.powi(2), 0.0),
            planted: &[ahead(|_| on_a_spring::energy(&AHEAD.subject.of(Euler::Explicit), 1.0 + on_a_spring::STEP.powi(2), 0.0))],
        },
        Agreement {
            against: "exact rationals",
            quantity: "position after each step of a bouncing ball",
            unit: "m",
            measure: |_| positions(&Euler::Explicit),
            planted: &[ahead(|_| positions(&AHEAD.subject.of(Euler::Explicit)))],
        },
    ],
};

/// Moreau–Jean's step of a bouncing ball with θ = 0 moves on by the old velocity.
fn positions(scheme: &dyn Scheme) -> Result<Measured> {
    on_a_ball::positions(scheme, |ball, now, h| ball.moreau_jean(now, &ratio(0, 1), Activation::Gap, h).motion)
}
