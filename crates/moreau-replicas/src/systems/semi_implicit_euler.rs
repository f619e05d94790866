//! Semi-implicit (symplectic) Euler: forces at the old state, positions by the new velocity.
//!
//! ```text
//!     v⁺ = v + h M⁻¹F(q, v) + M⁻¹Hᵀr ,   q⁺ = q + h v⁺         spring: q² + v² − s q v is constant
//! ```

use super::planted::{ahead, heavy};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball, on_a_spring};
use moreau_checks::defects::schemes::{AHEAD, HEAVY};
use moreau_dynamics::integrators::{Damping, SemiImplicitEuler};
use moreau_dynamics::schemes::{Activation, Euler, Scheme};
use moreau_exact::Result;
use moreau_exact::scalar::ratio;

pub static SYSTEM: System = System {
    name: "semi-implicit Euler",
    level: ConstraintLevel::Velocity,
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
            measure: |_| on_a_spring::steps(&Euler::SemiImplicit, &SemiImplicitEuler { damping: Damping::Explicit }),
            planted: &[ahead(|_| {
                on_a_spring::steps(&AHEAD.subject.of(Euler::SemiImplicit), &SemiImplicitEuler { damping: Damping::Explicit })
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "the spring's invariant q² + v² − s q v, relative",
            unit: "1",
            measure: |_| on_a_spring::energy(&Euler::SemiImplicit, 1.0, -on_a_spring::STEP),
            planted: &[ahead(|_| on_a_spring::energy(&AHEAD.subject.of(Euler::SemiImplicit), 1.0, -on_a_spring::STEP))],
        },
        Agreement {
            against: "exact rationals",
            quantity: "position after each step of a bouncing ball",
            unit: "m",
            measure: |_| positions(&Euler::SemiImplicit),
            planted: &[heavy(|_| positions(&HEAVY.subject.of(Euler::SemiImplicit)))],
        },
    ],
};

/// Moreau–Jean's step of a bouncing ball with θ = 1 moves on by the new velocity.
fn positions(scheme: &dyn Scheme) -> Result<Measured> {
    on_a_ball::positions(scheme, |ball, now, h| ball.moreau_jean(now, &ratio(1, 1), Activation::Gap, h).motion)
}
