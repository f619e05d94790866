//! Anitescu, the model of Chrono's NSC: the gap at the end of the step, linearised, in the convex cone complementarity problem.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + (φ/h) n ∈ K_μ*
//! ```

use super::{Agreement, Cone, ContactLaw, Level, Measured, System, on_a_ball, on_a_slope};
use crate::certificate::{natural_map, residuals};
use crate::problem::{ContactProblem, Solution};
use crate::scenes::named;
use crate::schemes::{Anitescu, Scheme, step};
use crate::solvers::{ClarabelPolished, ContactSolver, Reference, largest_eigenvalue_bound};
use crate::tolerance::{rounding, solvers};
use crate::{Error, Result};

pub static SYSTEM: System = System {
    name: "Anitescu",
    level: Level::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Associated,
    algorithm: "block projected Gauss–Seidel, accelerated; projected gradient; interior point",
    restitution: "none: plastic",
    position_update: "q + h v⁺",
    schemes: &["anitescu"],
    held_against: &[
        Agreement {
            against: "closed form",
            quantity: "gap of a sliding block, μ h v",
            unit: "m",
            measure: || on_a_slope::sliding_gap(&Anitescu),
        },
        Agreement {
            against: "closed form",
            quantity: "creep of a block that sticks",
            unit: "m/s",
            measure: || on_a_slope::creep(&Anitescu),
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a landing ball",
            unit: "m/s",
            measure: || on_a_ball::velocities(&Anitescu, |ball, now, h| ball.stewart_trinkle(now, h).motion),
        },
        Agreement {
            against: "Clarabel 0.11, polished",
            quantity: "contact velocities of each step of a stack of five boxes",
            unit: "m/s",
            measure: || stack_against_clarabel(&Anitescu, &Reference, 20),
        },
    ],
};

/// The first steps h = 1/100 s of the scene `box-stack`, each problem solved twice.
///
/// # Errors
/// Those of the scheme and the solver.
pub fn stack_against_clarabel(scheme: &dyn Scheme, solver: &dyn ContactSolver, steps: usize) -> Result<Measured> {
    let (mechanism, mut state) = named("box-stack")?.mechanism()?;
    let mut comparisons = Vec::new();
    for _ in 0..steps {
        let taken = step(scheme, solver, mechanism.as_ref(), &state, 0.01)?;
        if let (Some(problem), Some(answer)) = (&taken.assembled.problem, &taken.solution) {
            comparisons.push(apart(problem, answer, &ClarabelPolished.solve(problem, None)?)?);
        }
        state = taken.state;
    }
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no contact was active".into()))
}

/// How far two answers to a convex problem are apart in the contact velocity, and how far they may be by their residuals.
fn apart(problem: &ContactProblem, one: &Solution, other: &Solution) -> Result<Measured> {
    let residual = residuals(problem, one)?.natural_map + residuals(problem, other)?.natural_map;
    let impulses = (&one.impulse - &other.impulse).norm() + residual;
    let rho = natural_map::scales(problem).into_iter().fold(f64::INFINITY, f64::min);
    let norm = largest_eigenvalue_bound(&problem.law_delassus());
    let floor = rounding(problem.rows(), problem.delassus.norm() * one.impulse.norm());
    Ok(Measured {
        difference: (&one.velocity - &other.velocity).norm(),
        tolerance: solvers::agreement(norm, residual, impulses, rho) + floor,
    })
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;
    use nalgebra::DVector;

    /// The reference's answer to a problem with 10 % more shift.
    struct Shifted;

    impl ContactSolver for Shifted {
        fn name(&self) -> &'static str {
            "shifted"
        }

        fn takes(&self, _law: crate::Law, _rows: usize, _symmetric: bool) -> bool {
            true
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let mut wrong = problem.clone();
            wrong.free_velocity *= 1.1;
            let mut answer = Reference.solve(&wrong, warm_start)?;
            answer.velocity = problem.velocity(&answer.impulse);
            Ok(answer)
        }
    }

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        caught(on_a_slope::sliding_gap(&planted(Anitescu, Mistake::HalfFriction)));
        caught(on_a_slope::creep(&planted(Anitescu, Mistake::HalfFriction)));
        caught(on_a_ball::velocities(&planted(Anitescu, Mistake::Heavy), |ball, now, h| ball.stewart_trinkle(now, h).motion));
    }

    #[test]
    fn a_wrong_answer_is_apart_from_clarabels_by_more_than_a_right_one_may_be() {
        let (mechanism, state) = named("box-stack").and_then(|scene| scene.mechanism()).expect("built in");
        let problem = Anitescu.assemble(mechanism.as_ref(), &state, 0.01).expect("valid").problem.expect("it stands");
        let interior = ClarabelPolished.solve(&problem, None).expect("convex");
        let right = apart(&problem, &Reference.solve(&problem, None).expect("convex"), &interior).expect("two answers");
        let wrong = apart(&problem, &Shifted.solve(&problem, None).expect("convex"), &interior).expect("two answers");
        assert!(right.holds() && wrong.difference > right.tolerance, "{right:?} {wrong:?}");
    }
}
