//! Nonsmooth generalised-α: second order between contacts, with a damping of high frequencies that is chosen; Moreau–Jean's law at contacts.
//!
//! ```text
//!     (1−α_m) a⁺ + α_m a = (1−α_f) M⁻¹F(q⁺, v⁺) + α_f M⁻¹F(q, v) ,      K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u_n n
//! ```

use super::{Agreement, Cone, ContactLaw, Level, Measured, System, on_a_ball, on_a_spring};
use crate::Result;
use crate::schemes::{GeneralisedAlpha, Scheme};

pub static SYSTEM: System = System {
    name: "nonsmooth generalised-α",
    level: Level::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e",
    position_update: "q + h v + h²((½−β) a + β a⁺) + ½h M⁻¹Hᵀr",
    schemes: &["generalised-alpha"],
    held_against: &[
        Agreement {
            against: "closed form",
            quantity: "the spring's energy at ρ = 1, where it stays, relative",
            unit: "1",
            measure: || kept(&trapezoidal()?),
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball",
            unit: "m/s",
            measure: || bounced(&GeneralisedAlpha::default()),
        },
    ],
};

fn trapezoidal() -> Result<GeneralisedAlpha> {
    GeneralisedAlpha::new(1.0)
}

fn kept(scheme: &dyn Scheme) -> Result<Measured> {
    on_a_spring::energy(scheme, 1.0, 0.0)
}

fn bounced(scheme: &dyn Scheme) -> Result<Measured> {
    on_a_ball::velocities(scheme, |ball, now, h| ball.generalised_alpha(now, h).motion)
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        caught(kept(&GeneralisedAlpha::default()));
        caught(bounced(&planted(GeneralisedAlpha::default(), Mistake::Heavy)));
    }
}
