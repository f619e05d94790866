//! Pinocchio 3 and 4, Simple: Coulomb's law, hard or with compliance, by alternating directions; the step is the caller's.
//!
//! ```text
//!     K_μ ∋ r ⟂ y + μ‖y_t‖n ∈ K_μ* ,   y = (W + R) r + q ;     without the correction if `solve_ncp` is false
//! ```
//! Its step here is Moreau–Jean's with θ = 1, activation A and e = 0: `--theta 1 --activation A --solver admm`.

use super::planted::{Kind, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use crate::stored::{StoredRuns, problem_and_answer};
use crate::tolerance::references as tolerance;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{AlternatingDirections, ContactSolver};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

const HARD: [&str; 6] = [
    "pinocchio/box-stick.json",
    "pinocchio/box-slide.json",
    "pinocchio/ball-slide.json",
    "pinocchio/tower.json",
    "pinocchio/tower-heavy.json",
    "pinocchio/scattered.json",
];
const SOFT: [&str; 2] = ["pinocchio/box-soft.json", "pinocchio/scattered-soft.json"];
const RELAXED: [&str; 3] = ["pinocchio/box-slide-associated.json", "pinocchio/box-spin-associated.json", "pinocchio/tower-associated.json"];

const ENGINE: &str = "Pinocchio 4.1.0, ADMM";

pub static SYSTEM: System = System {
    name: "Pinocchio, Simple",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "ADMM with a proximal term and automatic ρ (`--solver admm`)",
    restitution: "the caller's",
    position_update: "q + h v⁺",
    schemes: &["moreau-jean"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "contact velocities of six hard problems",
            unit: "m/s",
            measure: |runs| compare(runs, &HARD, &AlternatingDirections::default()),
            planted: &[mistake(Kind::Reader, "systems/friction-slightly-larger", "μ a thousandth too large", |runs| {
                compare(runs, &HARD, &Rougher)
            })],
        },
        Agreement {
            against: ENGINE,
            quantity: "contact velocities of two compliant problems",
            unit: "m/s",
            measure: |runs| compare(runs, &SOFT, &AlternatingDirections::default()),
            planted: &[mistake(Kind::Reader, "systems/friction-slightly-larger", "μ a thousandth too large", |runs| {
                compare(runs, &SOFT, &Rougher)
            })],
        },
        Agreement {
            against: "Pinocchio 4.1.0, ADMM with solve_ncp = false",
            quantity: "contact velocities of three relaxed problems",
            unit: "m/s",
            measure: |runs| compare(runs, &RELAXED, &AlternatingDirections::default()),
            planted: &[mistake(Kind::Reader, "systems/friction-slightly-larger", "μ a thousandth too large", |runs| {
                compare(runs, &RELAXED, &Rougher)
            })],
        },
    ],
};

/// The largest difference of the contact velocities from the stored ones, over the stored problems \[m/s\].
fn compare(runs: &dyn StoredRuns, stored: &[&str], solver: &dyn ContactSolver) -> Result<Measured> {
    let found = stored.iter().map(|path| {
        let (problem, theirs) = problem_and_answer(runs, path)?;
        Ok(Measured::within((solver.solve(&problem, None)?.velocity - &theirs.velocity).amax(), tolerance::SAME_VELOCITY))
    });
    Measured::worst(found.collect::<Result<Vec<_>>>()?).ok_or_else(|| Error::Unsupported("no problem is stored".into()))
}

/// A mistake: our solver with μ a thousandth too large.
struct Rougher;

impl ContactSolver for Rougher {
    fn name(&self) -> &'static str {
        "rougher"
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let friction = problem.friction().iter().map(|mu| mu * 1.001).collect();
        let other = problem.clone().into_builder().friction(friction).build()?;
        AlternatingDirections::default().solve(&other, warm_start)
    }
}
