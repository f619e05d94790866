//! Project Chrono's NSC: Anitescu's step with a bound on how fast a penetration is undone; four algorithms for its convex problem.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + max(φ/h, −v_r) n ∈ K_μ*
//! ```

use super::planted::{Kind, half_friction, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, anitescu, on_a_slope};
use crate::chrono::Chrono;
use moreau_checks::defects::schemes::HALF_FRICTION;
use moreau_contact::solvers::{Auto, Solvers};
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Anitescu, Scheme, simulate};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::dvector;

pub static SYSTEM: System = System {
    name: "Chrono NSC",
    level: ConstraintLevel::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Associated,
    algorithm: "projected over-relaxation, Barzilai–Borwein, accelerated projected gradient, ADMM",
    restitution: "Newton's e above a rebound speed",
    position_update: "q + h v⁺",
    schemes: &["chrono"],
    held_against: &[
        Agreement {
            against: "closed form",
            quantity: "gap of a sliding block, μ h v",
            unit: "m",
            measure: |_| on_a_slope::sliding_gap(&Chrono::default()),
            planted: &[half_friction(|_| on_a_slope::sliding_gap(&HALF_FRICTION.subject.of(Chrono::default())))],
        },
        Agreement {
            against: "closed form",
            quantity: "creep of a block that sticks",
            unit: "m/s",
            measure: |_| on_a_slope::creep(&Chrono::default()),
            planted: &[half_friction(|_| on_a_slope::creep(&HALF_FRICTION.subject.of(Chrono::default())))],
        },
        Agreement {
            against: "closed form",
            quantity: "depth undone at the recovery speed",
            unit: "m",
            measure: |_| recovery(&Chrono::default()),
            planted: &[mistake(Kind::Scheme, "systems/anitescu-in-its-place", "Anitescu, which undoes any depth at once", |_| {
                recovery(&Anitescu)
            })],
        },
        Agreement {
            against: "Clarabel 0.11, polished",
            quantity: "contact velocities of a stack of five boxes, the four algorithms",
            unit: "m/s",
            measure: |_| four_algorithms(&Chrono::default()),
            planted: &[
                mistake(
                    Kind::Solver,
                    "systems/one-answers-another-problem",
                    "one of them answers a problem with 10 % more free velocity",
                    |_| anitescu::stack_answered_wrongly(&Chrono::default(), Solvers::own().by_name("apgd")?.as_ref()),
                ),
                mistake(Kind::Solver, "systems/one-tells-velocities-before", "one of them tells velocities before its impulses", |_| {
                    anitescu::stack_against_clarabel(&Chrono::default(), &anitescu::Untouched(Solvers::own().by_name("apgd")?), 1)
                }),
            ],
        },
    ],
};

/// Depth of a ball of 1 kg at rest 0.1 m deep against d − k h v_r, for the ten steps h = 1/64 s that need v_r = 0.6 m/s \[m\].
fn recovery(scheme: &dyn Scheme) -> Result<Measured> {
    let (depth, h, steps) = (0.1, 1.0 / 64.0, 10);
    let start = State { time: 0.0, position: dvector![-depth], velocity: dvector![0.0] };
    let run = simulate(scheme, &Auto, &PointMass::ball_on_floor(1.0, 9.81, 0.0), start, h, steps)?;
    let compare = |(k, state): (usize, &State)| {
        let difference = (state.position[0] + depth - 0.6 * h * k as f64).abs();
        Measured::within(difference, rounding(16 * (k + 1), depth))
    };
    Measured::worst(run.samples.iter().enumerate().map(compare)).ok_or_else(|| Error::Unsupported("no step was taken".into()))
}

fn four_algorithms(scheme: &dyn Scheme) -> Result<Measured> {
    let found =
        ["psor", "bb", "apgd", "admm"].map(|name| anitescu::stack_against_clarabel(scheme, Solvers::own().by_name(name)?.as_ref(), 5));
    Measured::worst(found.into_iter().collect::<Result<Vec<_>>>()?).ok_or_else(|| Error::Unsupported("no algorithm was asked".into()))
}
