//! Nonsmooth generalised-α: second order between contacts, with a damping of high frequencies that is chosen; Moreau–Jean's law at
//! contacts.
//!
//! ```text
//!     (1−α_m) a⁺ + α_m a = (1−α_f) M⁻¹F(q⁺, v⁺) + α_f M⁻¹F(q, v) ,      K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u_n n
//! ```
//! Siconos's class of that name is the smooth method within its event-driven strategy: single steps in flight are compared, see
//! [`crate::siconos::alpha`].

use super::planted::{Kind, heavy, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball, on_a_spring};
use crate::siconos::alpha::SiconosAlpha;
use crate::stored::{StoredRuns, read_by};
use moreau_checks::defects::schemes::HEAVY;
use moreau_dynamics::schemes::{GeneralisedAlpha, Scheme};
use moreau_exact::{Error, Result};

pub static SYSTEM: System = System {
    name: "nonsmooth generalised-α",
    level: ConstraintLevel::Velocity,
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
            measure: |_| kept(&trapezoidal()?),
            planted: &[mistake(Kind::Scheme, "systems/damped", "damped, ρ below 1", |_| kept(&GeneralisedAlpha::default()))],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "velocity after single steps between contacts of springs and a fall, NewMarkAlphaOSI at ρ = 1, 0.8 and 0.2",
            unit: "m/s",
            measure: |runs| siconos(runs, |run| run.scheme()),
            planted: &[mistake(Kind::Scheme, "systems/spectral-radius", "ρ = 0.79 throughout", |runs| {
                siconos(runs, |_| GeneralisedAlpha::new(0.79))
            })],
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball",
            unit: "m/s",
            measure: |_| bounced(&GeneralisedAlpha::default()),
            planted: &[heavy(|_| bounced(&HEAVY.subject.of(GeneralisedAlpha::default())))],
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
    "siconos/spring__generalised-alpha__h0.01.json",
    "siconos/spring_trapezoidal__generalised-alpha__h0.02.json",
    "siconos/spring_stiff__generalised-alpha__h0.05.json",
    "siconos/fall__generalised-alpha__h0.05.json",
];

fn siconos(runs: &dyn StoredRuns, scheme: impl Fn(&SiconosAlpha) -> Result<GeneralisedAlpha>) -> Result<Measured> {
    let found = SICONOS.iter().map(|path| {
        let run = read_by(runs, path, SiconosAlpha::from_json)?;
        Ok(Measured::within(run.deviations(&scheme(&run)?)?[1], run.tolerances()[1]))
    });
    Measured::worst(found.collect::<Result<Vec<_>>>()?).ok_or_else(|| Error::Unsupported("no run is stored".into()))
}
