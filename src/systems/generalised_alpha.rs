//! Nonsmooth generalised-α: second order between contacts, with a damping of high frequencies that is chosen; Moreau–Jean's law at
//! contacts.
//!
//! ```text
//!     (1−α_m) a⁺ + α_m a = (1−α_f) M⁻¹F(q⁺, v⁺) + α_f M⁻¹F(q, v) ,      K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u_n n
//! ```
//! Siconos's class of that name is the smooth method within its event-driven strategy: single steps in flight are compared, see
//! [`crate::checks::siconos_alpha`].

use super::{Agreement, Cone, ContactLaw, Level, Measured, System, on_a_ball, on_a_spring};
use crate::checks::siconos_alpha::SiconosAlpha;
use crate::schemes::{GeneralisedAlpha, Scheme};
use crate::{Error, Result};

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
            against: "Siconos 4.4.0",
            quantity: "velocity after single steps between contacts of springs and a fall, NewMarkAlphaOSI at ρ = 1, 0.8 and 0.2",
            unit: "m/s",
            measure: || siconos(|run| run.scheme()),
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

const SICONOS: &[&str] = &[
    include_str!("../../references/siconos/spring__generalised-alpha__h0.01.json"),
    include_str!("../../references/siconos/spring_trapezoidal__generalised-alpha__h0.02.json"),
    include_str!("../../references/siconos/spring_stiff__generalised-alpha__h0.05.json"),
    include_str!("../../references/siconos/fall__generalised-alpha__h0.05.json"),
];

fn siconos(scheme: impl Fn(&SiconosAlpha) -> Result<GeneralisedAlpha>) -> Result<Measured> {
    let runs = SICONOS.iter().map(|text| {
        let run = SiconosAlpha::from_json(text)?;
        Ok(Measured { difference: run.deviations(&scheme(&run)?)?[1], tolerance: run.tolerances()[1] })
    });
    Measured::worst(runs.collect::<Result<Vec<_>>>()?).ok_or_else(|| Error::Unsupported("no run is stored".into()))
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        caught(kept(&GeneralisedAlpha::default()));
        caught(siconos(|_| GeneralisedAlpha::new(0.79)));
        caught(bounced(&planted(GeneralisedAlpha::default(), Mistake::Heavy)));
    }
}
