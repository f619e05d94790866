//! Moreau–Jean: the impact law at velocity level.
//!
//! ```text
//!     K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u   at active contacts
//! ```

use super::planted::{half_friction, heavy};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball, on_a_slope};
use moreau_checks::defects::schemes::{HALF_FRICTION, HEAVY};
use moreau_dynamics::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
use moreau_exact::Result;
use moreau_exact::scalar::exact;

pub static SYSTEM: System = System {
    name: "Moreau–Jean",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e, or Moreau's on the whole velocity",
    position_update: "q + h(θ v⁺ + (1−θ) v)",
    schemes: &["moreau-jean"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball, three activation rules",
            unit: "m/s",
            measure: |_| all_rules(|scheme| Box::new(scheme)),
            planted: &[heavy(|_| all_rules(|scheme| Box::new(HEAVY.subject.of(scheme))))],
        },
        Agreement {
            against: "closed form",
            quantity: "position of a ball through all impacts to rest, h = 1/1024 s",
            unit: "m",
            measure: |_| on_a_ball::drop_to_rest(&MoreauJean::default(), &MoreauJean::default()),
            planted: &[heavy(|_| on_a_ball::drop_to_rest(&HEAVY.subject.of(MoreauJean::default()), &MoreauJean::default()))],
        },
        Agreement {
            against: "closed form",
            quantity: "speed of a block sliding down a slope",
            unit: "m/s",
            measure: |_| on_a_slope::sliding_speed(&MoreauJean::default()),
            planted: &[heavy(|_| on_a_slope::sliding_speed(&HEAVY.subject.of(MoreauJean::default())))],
        },
        Agreement {
            against: "closed form",
            quantity: "creep of a block that sticks",
            unit: "m/s",
            measure: |_| on_a_slope::creep(&MoreauJean::default()),
            planted: &[half_friction(|_| on_a_slope::creep(&HALF_FRICTION.subject.of(MoreauJean::default())))],
        },
    ],
};

/// θ = 0.3 under the three activation rules.
fn all_rules(subject: impl Fn(MoreauJean) -> Box<dyn Scheme>) -> Result<Measured> {
    let theta = 0.3;
    let comparisons = Activation::ALL.into_iter().map(|activation| {
        let scheme = subject(MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly });
        on_a_ball::velocities(scheme.as_ref(), |ball, now, h| ball.moreau_jean(now, &exact(theta), activation, h).motion)
    });
    let comparisons = comparisons.collect::<Result<Vec<_>>>()?;
    Ok(Measured::worst(comparisons).expect("three rules"))
}
