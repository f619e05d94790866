//! Pinocchio 3 and 4, Simple: Coulomb's law, hard or with compliance, by alternating directions; the step is the caller's.
//!
//! ```text
//!     K_μ ∋ r ⟂ y + μ‖y_t‖n ∈ K_μ* ,   y = (W + R) r + q ;     without the correction if `solve_ncp` is false
//! ```
//! Its step here is Moreau–Jean's with θ = 1, activation A and e = 0: `--theta 1 --activation A --solver admm`.

use super::{Agreement, Cone, ContactLaw, Level, Measured, System};
use crate::problem::{ContactProblem, Solution};
use crate::solvers::{AlternatingDirections, ContactSolver};
use crate::tolerance::references as tolerance;
use crate::{Error, Result};
use serde_json::Value;

const HARD: [&str; 6] = [
    include_str!("../../references/pinocchio/box-stick.json"),
    include_str!("../../references/pinocchio/box-slide.json"),
    include_str!("../../references/pinocchio/ball-slide.json"),
    include_str!("../../references/pinocchio/tower.json"),
    include_str!("../../references/pinocchio/tower-heavy.json"),
    include_str!("../../references/pinocchio/scattered.json"),
];
const SOFT: [&str; 2] =
    [include_str!("../../references/pinocchio/box-soft.json"), include_str!("../../references/pinocchio/scattered-soft.json")];
const RELAXED: [&str; 3] = [
    include_str!("../../references/pinocchio/box-slide-associated.json"),
    include_str!("../../references/pinocchio/box-spin-associated.json"),
    include_str!("../../references/pinocchio/tower-associated.json"),
];

const ENGINE: &str = "Pinocchio 4.1.0, ADMM";

pub static SYSTEM: System = System {
    name: "Pinocchio, Simple",
    level: Level::Velocity,
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
            measure: || compare(&HARD, &AlternatingDirections::default()),
        },
        Agreement {
            against: ENGINE,
            quantity: "contact velocities of two compliant problems",
            unit: "m/s",
            measure: || compare(&SOFT, &AlternatingDirections::default()),
        },
        Agreement {
            against: "Pinocchio 4.1.0, ADMM with solve_ncp = false",
            quantity: "contact velocities of three relaxed problems",
            unit: "m/s",
            measure: || compare(&RELAXED, &AlternatingDirections::default()),
        },
    ],
};

/// The largest difference of the contact velocities from the stored ones, over the stored problems \[m/s\].
fn compare(stored: &[&str], solver: &dyn ContactSolver) -> Result<Measured> {
    let found = stored.iter().map(|text| {
        let document: Value =
            serde_json::from_str(text).map_err(|error| Error::invalid("reference", error.to_string(), "regenerate it"))?;
        let problem = ContactProblem::from_json(&document["problem"].to_string())?;
        let theirs = Solution::from_json(&document["answer"].to_string())?;
        Ok(Measured { difference: (solver.solve(&problem, None)?.velocity - &theirs.velocity).amax(), tolerance: tolerance::SAME_VELOCITY })
    });
    Measured::worst(found.collect::<Result<Vec<_>>>()?).ok_or_else(|| Error::Unsupported("no problem is stored".into()))
}

#[cfg(test)]
mod tests {
    use super::super::planted::caught;
    use super::*;
    use nalgebra::DVector;

    /// Our solver with μ a thousandth too large.
    struct Rougher;

    impl ContactSolver for Rougher {
        fn name(&self) -> &'static str {
            "rougher"
        }

        fn takes(&self, _law: crate::Law, _rows: usize, _symmetric: bool) -> bool {
            true
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let mut other = problem.clone();
            other.friction.iter_mut().for_each(|mu| *mu *= 1.001);
            AlternatingDirections::default().solve(&other, warm_start)
        }
    }

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        for stored in [&HARD[..], &SOFT, &RELAXED] {
            caught(compare(stored, &Rougher));
        }
    }
}
