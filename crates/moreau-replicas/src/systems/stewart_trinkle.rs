//! Stewart–Trinkle: the gap at the end of the step, linearised, in one linear complementarity problem with polyhedral friction.
//!
//! ```text
//!     0 ≤ r_n ⟂ φ/h + u_n⁺ ≥ 0 ,   r_t = Σ Dⱼβⱼ ,   0 ≤ β ⟂ Dᵀu⁺ + σ ≥ 0 ,   0 ≤ σ ⟂ μ r_n − Σβⱼ ≥ 0
//! ```

use super::planted::{Planted, ahead, half_friction, heavy};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, System, on_a_ball, on_a_slope};
use moreau_checks::defects::schemes::{AHEAD, Alteration, HALF_FRICTION, HEAVY, Mistaken};
use moreau_dynamics::schemes::StewartTrinkle;

pub static SYSTEM: System = System {
    name: "Stewart–Trinkle",
    level: ConstraintLevel::Position,
    cone: Cone::Polyhedral,
    law: ContactLaw::Coulomb,
    algorithm: "lexicographic Lemke; in space Gauss–Seidel first",
    restitution: "none: plastic",
    position_update: "q + h v⁺",
    schemes: &["stewart-trinkle"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a landing ball",
            unit: "m/s",
            measure: |_| on_a_ball::velocities(&StewartTrinkle::default(), |ball, now, h| ball.stewart_trinkle(now, h).motion),
            planted: &[heavy(|_| on_a_ball::velocities(&wrong(HEAVY), |ball, now, h| ball.stewart_trinkle(now, h).motion))],
        },
        Agreement {
            against: "exact rationals",
            quantity: "position after each step of a landing ball",
            unit: "m",
            measure: |_| on_a_ball::positions(&StewartTrinkle::default(), |ball, now, h| ball.stewart_trinkle(now, h).motion),
            planted: &[ahead(|_| on_a_ball::positions(&wrong(AHEAD), |ball, now, h| ball.stewart_trinkle(now, h).motion))],
        },
        Agreement {
            against: "closed form",
            quantity: "speed of a block sliding down a slope",
            unit: "m/s",
            measure: |_| on_a_slope::sliding_speed(&StewartTrinkle::default()),
            planted: &[half_friction(|_| on_a_slope::sliding_speed(&wrong(HALF_FRICTION)))],
        },
        Agreement {
            against: "closed form",
            quantity: "creep of a block that sticks",
            unit: "m/s",
            measure: |_| on_a_slope::creep(&StewartTrinkle::default()),
            planted: &[half_friction(|_| on_a_slope::creep(&wrong(HALF_FRICTION)))],
        },
    ],
};

fn wrong(mistake: Planted<Alteration>) -> Mistaken<StewartTrinkle> {
    mistake.subject.of(StewartTrinkle::default())
}
