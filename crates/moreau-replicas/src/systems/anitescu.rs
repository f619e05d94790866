//! Anitescu, the model of Chrono's NSC: the gap at the end of the step, linearised, in the convex cone complementarity problem.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + (φ/h) n ∈ K_μ*
//! ```

use super::planted::{Kind, half_friction, heavy, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball, on_a_slope};
use moreau_checks::defects::schemes::{HALF_FRICTION, HEAVY};
use moreau_contact::certificate::{natural_map, residuals};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ClarabelPolished, ContactSolver, largest_eigenvalue_bound};
use moreau_contact::tolerance::solvers;
use moreau_dynamics::scenes::named;
use moreau_dynamics::schemes::{Anitescu, Scheme, StepContext, Waist, step};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

pub static SYSTEM: System = System {
    name: "Anitescu",
    level: ConstraintLevel::Position,
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
            measure: |_| on_a_slope::sliding_gap(&Anitescu),
            planted: &[half_friction(|_| on_a_slope::sliding_gap(&HALF_FRICTION.subject.of(Anitescu)))],
        },
        Agreement {
            against: "closed form",
            quantity: "creep of a block that sticks",
            unit: "m/s",
            measure: |_| on_a_slope::creep(&Anitescu),
            planted: &[half_friction(|_| on_a_slope::creep(&HALF_FRICTION.subject.of(Anitescu)))],
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a landing ball",
            unit: "m/s",
            measure: |_| on_a_ball::velocities(&Anitescu, |ball, now, h| ball.stewart_trinkle(now, h).motion),
            planted: &[heavy(|_| on_a_ball::velocities(&HEAVY.subject.of(Anitescu), |ball, now, h| ball.stewart_trinkle(now, h).motion))],
        },
        Agreement {
            against: "Clarabel 0.11, polished",
            quantity: "contact velocities of each step of a stack of five boxes",
            unit: "m/s",
            measure: |_| stack_against_clarabel(&Anitescu, &Auto, 20),
            planted: &[
                mistake(Kind::Solver, "systems/another-problem", "the answer to a problem with 10 % more free velocity", |_| {
                    stack_answered_wrongly(&Anitescu, &Auto)
                }),
                mistake(Kind::Solver, "systems/velocities-before", "velocities before the impulses", |_| {
                    stack_against_clarabel(&Anitescu, &Untouched(Box::new(Auto)), 1)
                }),
            ],
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
    let norm = largest_eigenvalue_bound(&problem.law_delassus()?);
    let floor = rounding(problem.rows(), problem.dense().norm() * one.impulse.norm());
    Ok(Measured::within((&one.velocity - &other.velocity).norm(), solvers::agreement(norm, residual, impulses, rho) + floor))
}

/// The answer to the first step's problem with 10 % more free velocity, against Clarabel's to the right problem, under the tolerance of the
/// right answer: by its own residual a wrong one would be excused.
///
/// # Errors
/// Those of the scheme and the solver.
pub fn stack_answered_wrongly(scheme: &dyn Waist, solver: &dyn ContactSolver) -> Result<Measured> {
    let (mechanism, state) = named("box-stack")?.mechanism()?;
    let assembled = scheme.assemble(&StepContext::new(mechanism.as_ref(), &state, 0.01)?)?;
    let problem = assembled.problem.ok_or_else(|| Error::Unsupported("no contact was active".into()))?;
    let interior = ClarabelPolished.solve(&problem, None)?;
    let right = apart(&problem, &solver.solve(&problem, None)?, &interior)?;
    let other = problem.clone().into_builder().free_velocity(problem.free_velocity() * 1.1).build()?;
    let mut answer = solver.solve(&other, None)?;
    answer.velocity = problem.velocity(&answer.impulse);
    Ok(Measured { expectation: right.expectation, ..apart(&problem, &answer, &interior)? })
}

/// A mistake: a solver that tells the velocities before its impulses.
pub struct Untouched(pub Box<dyn ContactSolver>);

impl ContactSolver for Untouched {
    fn name(&self) -> &'static str {
        "untouched"
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let mut solution = self.0.solve(problem, warm_start)?;
        solution.velocity.clone_from(problem.free_velocity());
        Ok(solution)
    }
}
