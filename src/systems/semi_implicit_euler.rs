//! Semi-implicit (symplectic) Euler: forces at the old state, positions by the new velocity.
//!
//! ```text
//!     v⁺ = v + h M⁻¹F(q, v) + M⁻¹Hᵀr ,   q⁺ = q + h v⁺         spring: q² + v² − s q v is constant
//! ```

use super::{Agreement, Cone, ContactLaw, Level, System, on_a_ball, on_a_spring};
use crate::integrators::{Damping, SemiImplicitEuler};
use crate::scalar::ratio;
use crate::schemes::{Activation, Euler};

pub static SYSTEM: System = System {
    name: "semi-implicit Euler",
    level: Level::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e",
    position_update: "q + h v⁺",
    schemes: &["semi-implicit-euler"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "state after each step of a spring, relative",
            unit: "1",
            measure: || on_a_spring::steps(&Euler::SemiImplicit, &SemiImplicitEuler { damping: Damping::Explicit }),
        },
        Agreement {
            against: "closed form",
            quantity: "the spring's invariant q² + v² − s q v, relative",
            unit: "1",
            measure: || on_a_spring::energy(&Euler::SemiImplicit, 1.0, -on_a_spring::STEP),
        },
        Agreement {
            against: "exact rationals",
            quantity: "position after each step of a bouncing ball",
            unit: "m",
            measure: || {
                on_a_ball::positions(&Euler::SemiImplicit, |ball, now, h| ball.moreau_jean(now, &ratio(1, 1), Activation::Gap, h).motion)
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
        let wrong = |mistake| planted(Euler::SemiImplicit, mistake);
        caught(on_a_spring::steps(&wrong(Mistake::Ahead), &SemiImplicitEuler { damping: Damping::Explicit }));
        caught(on_a_spring::energy(&wrong(Mistake::Ahead), 1.0, -on_a_spring::STEP));
        caught(on_a_ball::positions(&wrong(Mistake::Heavy), |ball, now, h| ball.moreau_jean(now, &ratio(1, 1), Activation::Gap, h).motion));
    }
}
