//! Explicit Euler: every force and the position update at the old state.
//!
//! ```text
//!     v⁺ = v + h M⁻¹F(q, v) + M⁻¹Hᵀr ,   q⁺ = q + h v          spring: |R|² = 1 + s²
//! ```

use super::{Agreement, Cone, ContactLaw, Level, System, on_a_ball, on_a_spring};
use crate::integrators::ExplicitEuler;
use crate::scalar::ratio;
use crate::schemes::{Activation, Euler};

pub static SYSTEM: System = System {
    name: "explicit Euler",
    level: Level::Velocity,
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
            measure: || on_a_spring::steps(&Euler::Explicit, &ExplicitEuler),
        },
        Agreement {
            against: "closed form",
            quantity: "growth of the spring's energy, (1 + s²)ⁿ, relative",
            unit: "1",
            measure: || on_a_spring::energy(&Euler::Explicit, 1.0 + on_a_spring::STEP.powi(2), 0.0),
        },
        Agreement {
            against: "exact rationals",
            quantity: "position after each step of a bouncing ball",
            unit: "m",
            measure: || {
                on_a_ball::positions(&Euler::Explicit, |ball, now, h| ball.moreau_jean(now, &ratio(0, 1), Activation::Gap, h).motion)
            },
        },
    ],
};

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        let wrong = |mistake| planted(Euler::Explicit, mistake);
        caught(on_a_spring::steps(&wrong(Mistake::Ahead), &ExplicitEuler));
        caught(on_a_spring::energy(&wrong(Mistake::Ahead), 1.0 + on_a_spring::STEP.powi(2), 0.0));
        caught(on_a_ball::positions(&wrong(Mistake::Ahead), |ball, now, h| ball.moreau_jean(now, &ratio(0, 1), Activation::Gap, h).motion));
    }
}
